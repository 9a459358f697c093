"""Entries of functions, events, interfaces, enums, constants and aliases."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.event_topics import topic_of
from swarmdsl.analysis.types.enum_values import numbers, underlying
from swarmdsl.base.naming import incoming_topic
from swarmdsl.ir.function_models import MODELS
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    AliasType,
    Communication,
    Constant,
    EnumType,
    Event,
    Field,
    Function,
    FunctionPort,
    Interface,
    MessageType,
    ModelUse,
    OutcomeTrigger,
    Param,
    ServiceType,
    State,
    StructType,
    Transition,
    nodes_of,
)
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link, links
from swarmdsl.tools.document.page import Cell, Code, Entry, Inline, Prose, Row, Table
from swarmdsl.tools.document.traffic import States

_OUTCOMES = ("succeeded", "aborted", "preempted")


def function(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a function: its interface, topics, params and callers."""
    node = element.node
    assert isinstance(node, Function)
    call = next(item for item in node.items if isinstance(item, Communication))
    interface = builder.names.type(call.type.type)
    ports = tuple(
        Row(
            (
                (item.direction,),
                (Code(((str(item.topic), None),)),),
                builder.type(item.type, element),
                (Prose(item.doc),) if item.doc else (),
            )
        )
        for item in node.items
        if isinstance(item, FunctionPort)
    )
    facts: list[tuple[str, Cell]] = [
        ("category", (node.category,)),
        ("paradigm", (call.paradigm,)),
        (
            "server",
            (Code(((str(call.name), None),)), *((" ", Prose(call.doc)) if call.doc else ())),
        ),
        ("interface", builder.type(call.type, element)),
        *_model(element, node, builder),
    ]
    blocks = (
        *(_parts(interface, builder, linked=True) if interface is not None else ()),
        Table("Topics", ("direction", "topic", "type", "description"), ports),
        builder.params(element, (item for item in node.items if isinstance(item, Param))),
        _calls(element, builder),
    )
    return builder.entry(element, facts, blocks)


def _model(element: Element, node: Function, builder: EntryBuilder) -> Iterator[tuple[str, Cell]]:
    for use in nodes_of(node, ModelUse):
        known = MODELS.get(str(use.name))
        meaning = f" {known.doc}" if known is not None else ""
        doc = (" ", Prose(use.doc)) if use.doc else ()
        yield "in space", (*builder.code(use, element), meaning, *doc)


def functions_table(builder: EntryBuilder) -> Table:
    """Table of all functions and operations with their users."""
    rows = []
    for each in builder.system.functions:
        element = builder.elements.at(each.origin)
        if element is None:
            continue
        call = each.communication
        interface = builder.names.type(call.type)
        shown = link(interface, str(call.type)) if interface else Code(((str(call.type), None),))
        cells: tuple[Cell, ...] = (
            (link(element),),
            (each.category,),
            (call.paradigm,),
            (Code(((call.name, None),)),),
            (shown,),
            _states(builder.traffic.called.get(each.name, {})),
        )
        rows.append(Row(cells))
    columns = ("function", "category", "paradigm", "server", "interface", "used by")
    return Table("Function usage", columns, tuple(rows))


def event(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of an event: its message, topics, senders and handlers."""
    node = element.node
    assert isinstance(node, Event)
    topic = topic_of(node)
    (name,) = {each.name for each in builder.events[element]}
    message = builder.names.type(node.type.type)
    incoming = incoming_topic(topic, node.swarm)
    facts: list[tuple[str, Cell]] = [
        ("message", builder.type(node.type, element)),
        ("sent on", (Code(((topic, None),)),)),
        ("received on", (Code(((incoming, None),)),) if incoming != topic else ()),
        ("delivery", ", ".join(" ".join(each.span.text.split()) for each in node.delivery)),
        ("sent by", _states(builder.traffic.sent.get(name, {})) or ("no state machine",)),
        ("handled by", _states(builder.traffic.handled.get(name, {})) or ("no state machine",)),
    ]
    tables = _parts(message, builder, linked=True) if message is not None else ()
    return builder.entry(element, facts, tables)


def interface(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a struct, message, service or action: its fields."""
    return builder.entry(element, [("used by", builder.used_by(element))], _parts(element, builder))


def enum(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of an enum: its values and their numbers."""
    node = element.node
    assert isinstance(node, EnumType)
    known = numbers(node)
    rows = [
        builder.row(inner, ((Code(((str(known[inner.name]), None),)),), builder.used_by(inner)))
        for inner in element.children
    ]
    facts: list[tuple[str, Cell]] = [
        ("underlying type", (Code(((str(underlying(node)), None),)),)),
        ("used by", builder.used_by(element)),
    ]
    columns = ("value", "number", "used by", "description")
    return builder.entry(element, facts, (Table("Values", columns, tuple(rows)),))


def constant(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a constant: its type and value."""
    node = element.node
    assert isinstance(node, Constant)
    facts = [
        ("type", builder.type(node.type, element)),
        ("value", builder.code(node.value, element)),
        ("used by", builder.used_by(element)),
    ]
    return builder.entry(element, facts)


def alias(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a type alias."""
    node = element.node
    assert isinstance(node, AliasType)
    aliased: Cell = (Code(((str(node.type.type), None),)),)
    facts = [("alias of", aliased), ("used by", builder.used_by(element))]
    return builder.entry(element, facts)


def _parts(element: Element, builder: EntryBuilder, linked: bool = False) -> tuple[Table, ...]:
    """Tables of the fields of an interface.

    With `linked`, the names of fields link to the entry of the interface.
    """
    node = element.node
    assert isinstance(node, Interface)

    def fields(title: str, nodes: Iterable[Field]) -> Table:
        rows = []
        for each in nodes:
            inner = builder.elements.of(each)
            if inner is not None:
                row = builder.row(inner, (builder.type(each.type, inner),))
                name: Cell = (link(inner, inner.name),)
                rows.append(Row((name, *row.cells[1:])) if linked else row)
        return Table(title, ("field", "type", "description"), tuple(rows))

    match node:
        case StructType():
            return (fields("Fields", node.fields),)
        case MessageType():
            return (fields("Fields", node.fields), _constants(node, builder, linked))
        case ServiceType():
            return (fields("Request", node.request), fields("Response", node.response))
        case ActionType():
            titles = {"Goal": node.goal, "Result": node.result, "Feedback": node.feedback}
            return tuple(fields(title, nodes) for title, nodes in titles.items())
    return ()


def _constants(node: MessageType, builder: EntryBuilder, linked: bool) -> Table:
    rows = []
    for each in node.constants:
        inner = builder.elements.of(each)
        if inner is not None and not linked:
            cells = (builder.type(each.type, inner), builder.code(each.value, inner))
            rows.append(builder.row(inner, cells))
    return Table("Constants", ("name", "type", "value", "description"), tuple(rows))


def _calls(element: Element, builder: EntryBuilder) -> Table:
    """Table of the states that call a function, with the targets for each outcome."""
    rows = []
    for state in builder.names.users(element):
        node = state.node
        activity = None
        if isinstance(node, State):
            activity = next((item for item in node.items if isinstance(item, Activity)), None)
        if activity is None or not isinstance(node, State):
            continue
        outcomes: dict[str, list[Inline]] = {outcome: [] for outcome in _OUTCOMES}
        for item in node.items:
            if not isinstance(item, Transition):
                continue
            for trigger in item.triggers:
                if isinstance(trigger, OutcomeTrigger):
                    targets = outcomes[trigger.outcome]
                    targets += [", "] if targets else []
                    if item.target is not None:
                        targets.append(builder.names.code(item.target.span, state))
                    else:
                        targets.append("stays")
                    if item.guard is not None:
                        targets += [" if ", *builder.code(item.guard, state)]
        rows.append(
            Row(((link(state),), builder.code(activity, state), *map(tuple, outcomes.values())))
        )
    return Table("Used by", ("state", "call", *_OUTCOMES), tuple(rows))


def _states(by_machine: dict[Element, States]) -> Cell:
    """Links to states, without duplicates."""
    return links(list(dict.fromkeys(state for found in by_machine.values() for state in found)))
