"""Checks of interfaces, events and functions."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.event_topics import received_topic, topic_of
from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.base.diagnostics.advice import Advice, behind, edits, meant
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.graphs import cycles
from swarmdsl.base.naming import snake_case
from swarmdsl.project.loader import Project
from swarmdsl.project.rosidl import standard
from swarmdsl.syntax.ast import (
    ActionType,
    Communication,
    Declaration,
    Event,
    Field,
    Function,
    FunctionPort,
    Interface,
    MessageType,
    MonitorTrigger,
    Param,
    Port,
    ServiceType,
    StateMachine,
    StructType,
    TypeRef,
    Variable,
    Word,
    by_class,
    nodes_of,
)
from swarmdsl.syntax.types import Array, Named

# Relative, absolute or private; each part starts with a letter (ROS 2: or `_`).
_GRAPH_NAME = re.compile(r"[~/]?/?[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*", re.ASCII)
# Nodes that hold a value.
_VALUES: tuple[type[Field | Param | Port | Variable], ...] = (Field, Param, Port, Variable)


def check_message_cycles(project: Project, context: Context) -> None:
    """Check that no message contains itself, directly, in an array or through others."""
    messages = {
        type_: node.fields
        for type_, node in context.interfaces.declared.items()
        if isinstance(node, (StructType, MessageType))
    }

    def inside(type_: Named) -> Iterator[tuple[Field, Named]]:
        for field in messages[type_]:
            element = field.type.type
            if isinstance(element, Array):
                element = element.element
            if isinstance(element, Named) and element in messages:
                yield field, element

    for type_, fields in cycles(messages, inside):
        *earlier, last = fields
        context.report.report(
            "type-cycle",
            last.type.span,
            name=type_.name,
            related=tuple(Label(field.type.span, "through this field") for field in earlier),
        )


def check_values(declaration: Declaration, context: Context) -> None:
    """Check that no value has the type of a service or an action."""
    found = by_class(declaration)
    for node in (node for kind in _VALUES for node in found.get(kind, ())):
        type_ = node.type.type
        element = type_.element if isinstance(type_, Array) else type_
        known = context.interfaces.get(element) if isinstance(element, Named) else None
        if isinstance(known, (ServiceType, ActionType)):
            context.check_kind(node.type, MessageType)


def check_known(declaration: Declaration, context: Context) -> None:
    """Check that interfaces of known packages exist and similar names are not misspelled.

    An interface without any description is a silent warning: it may be on the robot.
    """
    for node in nodes_of(declaration, TypeRef):
        element = node.type.element if isinstance(node.type, Array) else node.type
        if not isinstance(element, Named) or context.interfaces.get(element) is not None:
            continue
        similar = context.interfaces.similar(element)
        if similar is not None or context.interfaces.missing(element):
            help_ = meant(str(similar)) if similar is not None else None
            context.report.report("unknown-interface", node.span, name=element, help=help_)
        elif context.report.wants("undescribed-interface"):
            context.report.report(
                "undescribed-interface",
                node.span,
                name=element,
                notes=(f"the workspace must get package `{element.package}` from elsewhere",),
                help='declare it in the model, or `import ros "FOLDER"`, the folder of its package',
            )


def check_standard(declared: Interface, context: Context) -> None:
    """Check that a standard interface of ROS is declared as in ROS 1 or in ROS 2."""
    package, _, name = declared.name.rpartition("/")
    standard_one = context.interfaces.standard(Named(package, name), type(declared))
    if standard_one is None:
        return
    own = [_shape(field) for field in _fields(declared)]
    versions = [
        [field for field in _fields(standard_one) if standard.only_in(field) in (None, version)]
        for version in (1, 2)
    ]
    if any(own == [_shape(field) for field in fields] for fields in versions):
        return
    shown = listed([f"{field.name} : {field.type.type}" for field in versions[1]], "and")
    context.report.report(
        "other-than-standard",
        declared.name.span,
        name=declared.name,
        help=Advice(
            f"that has {shown or 'no field'}: leave this out, or give it another name",
            "remove declaration",
        ),
    )


def _fields(interface: Interface) -> list[Field]:
    match interface:
        case MessageType(fields=fields):
            return fields
        case ServiceType(request=request, response=response):
            return [*request, *response]
        case ActionType(goal=goal, result=result, feedback=feedback):
            return [*goal, *result, *feedback]
    return []


def _shape(field: Field) -> tuple[str, str]:
    """Name and type of a field; a time and a duration are messages in ROS 2."""
    written = str(field.type.type).replace("builtin_interfaces/", "").lower()
    return str(field.name), written


def check_event(event: Event, context: Context) -> None:
    """Check that an event has a message and a valid topic."""
    context.check_kind(event.type, MessageType)
    if event.topic is not None:
        check_graph_name(event.topic, "a topic", context)


def check_graph_name(name: Word, what: str, context: Context) -> None:
    """Check that a topic, an action or a service has a valid ROS name (REP 144)."""
    if not _GRAPH_NAME.fullmatch(name):
        context.report.report(
            "bad-topic",
            name.span,
            name=name,
            what=what,
            help=_valid(name),
        )


def _valid(name: str) -> str:
    """Return the help for an invalid name, with the next valid one."""
    text = "use letters, digits and `_`; parts are separated by `/` and start with a letter"
    parts = [re.sub(r"[^A-Za-z0-9_]", "_", each) for each in name.split("/") if each]
    new = "/".join(each if each[0].isalpha() else f"n{each}" for each in parts)
    return Advice(text, "propose", f'"{new}"') if new else text


def _other_topic(event: Event) -> str:
    """Return the help for an event on a topic of another type."""
    text, name = 'give one of the events another topic: `on "name"`', snake_case(event.name)
    new = f'"{name if name != topic_of(event) else name + "_2"}"'
    if event.topic is not None:
        return edits(text, f"Change to `{new}`", (event.topic.span, new))
    return edits(text, f"Add `on {new}`", behind(event.type.span, f" on {new}"))


def check_topics(project: Project, context: Context) -> None:
    """Check that all events on one topic, declared or monitored, have the same message type.

    The type in a library is right, and a declared event is right before a monitored topic: the
    other place can be changed.
    """
    pairs = sorted(context.used, key=lambda pair: not pair[0].library)
    sources: list[Event | MonitorTrigger] = [node for _, node in pairs if isinstance(node, Event)]
    for _, machine in pairs:
        if isinstance(machine, StateMachine):
            sources += nodes_of(machine, MonitorTrigger)
    first: dict[str, Event | MonitorTrigger] = {}
    for source in sources:
        known = first.setdefault(received_topic(source), source)
        if None in (known.type.type, source.type.type) or known.type.type == source.type.type:
            continue
        context.report.report(
            "topic-types",
            source.type.span,
            topic=topic_of(source) if isinstance(source, Event) else source.topic,
            first=known.type.type,
            second=source.type.type,
            related=(
                Label(
                    known.type.span,
                    "declared here" if isinstance(known, Event) else "monitored here",
                ),
            ),
            help=Advice(
                f"write `{known.type.type}`, or monitor another topic",
                "propose",
                str(known.type.type),
            )
            if isinstance(source, MonitorTrigger)
            else _other_topic(source),
        )


def check_function(function: Function, context: Context) -> None:
    """Check that a function has one kind of call, and messages at its ports."""
    calls = [item for item in function.items if isinstance(item, Communication)]
    if not calls:
        context.report.report(
            "unbound-function",
            function.name.span,
            name=function.name,
            help='say how it is called, `action "cmd/name" : package/Type` for instance',
        )
    context.check_single([call.span for call in calls], "how the function is called")
    for item in function.items:
        match item:
            case Communication():
                kind = ActionType if item.paradigm == "action" else ServiceType
                check_graph_name(item.name, kind_of(kind), context)
                context.check_kind(item.type, kind)
            case FunctionPort():
                check_graph_name(item.topic, "a topic", context)
                context.check_kind(item.type, MessageType)
            case Param():
                context.check_default(item, item.default)
