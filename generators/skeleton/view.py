"""View of a node for the templates: names, types and values in one language.

Names are `TracedStr`: their lines are traced to the declarations in the model.
"""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import Span, TracedStr, dataclass
from swarmdsl.codegen.python import comment_lines, comments, file_name
from swarmdsl.codegen.ros import interface_parts, yaml_value
from swarmdsl.ir import DURATION, Action, Field, Service, System

from .languages import Language, reports_failure
from .nodes import Node, Server, Topic
from .settings import Setting


@dataclass(frozen=True)
class TopicView:
    """A topic; `literal` is its name as a string literal."""

    name: str
    topic: str
    literal: str
    type: str
    comments: tuple[str, ...]


@dataclass(frozen=True)
class ServerView:
    """A server: its types, and their fields, one on a line.

    `local` is its name without a leading `~`. `taken` and `given` are the goal and result of an
    action, or the request and response of a service.
    """

    method: str
    name: str
    literal: str
    local: str
    type: str
    taken_type: str
    given_type: str
    feedback_type: str
    taken: tuple[str, ...]
    given: tuple[str, ...]
    feedback: tuple[str, ...]
    refusal: tuple[str, ...]
    reports_failure: bool
    comments: tuple[str, ...]

    @property
    def own(self) -> bool:
        """True if its name is in the namespace of the node."""
        return self.name.startswith("~")

    @property
    def answers(self) -> bool:
        """True if a refusal sets a field of the response."""
        return any(line.startswith("response.") for line in self.refusal)

    @property
    def fields(self) -> tuple[str, ...]:
        """The fields of both, or a note that there are none."""
        return (*self.taken, *self.given, *self.feedback) or ("Nothing comes with it.",)


@dataclass(frozen=True)
class SettingView:
    """A ROS parameter; `type` is in the language, `default` is empty if there is none."""

    name: str
    key: str
    type: str
    default: str
    zero: str
    yaml: str
    said: str
    about: str
    about_literal: str
    declared: str
    example: str
    comments: tuple[str, ...]


@dataclass(frozen=True)
class NodeView:
    """The whole node."""

    model: str
    kind: str
    package: str
    cls: str
    header: str
    doc: tuple[str, ...]
    summary: str
    imports: tuple[str, ...]
    depends: tuple[str, ...]
    action: ServerView | None
    services: tuple[ServerView, ...]
    inputs: tuple[TopicView, ...]
    outputs: tuple[TopicView, ...]
    settings: tuple[SettingView, ...]

    @property
    def servers(self) -> tuple[ServerView, ...]:
        """The action and the services."""
        return (*((self.action,) if self.action else ()), *self.services)

    @property
    def silent(self) -> tuple[ServerView, ...]:
        """The services that cannot tell their clients that a request failed."""
        return tuple(service for service in self.services if not service.reports_failure)

    @property
    def required(self) -> tuple[SettingView, ...]:
        """The ROS parameters that require a value."""
        return tuple(setting for setting in self.settings if not setting.default)

    @property
    def tested(self) -> tuple[str, ...]:
        """Modules of the types in the hooks of the user's class."""
        taken = [service.taken_type for service in self.services]
        taken += (topic.type for topic in self.inputs)
        return tuple(
            sorted(
                {
                    module
                    for module in self.imports
                    if any(each.startswith(f"{module}.") for each in taken)
                }
            )
        )

    @property
    def standard(self) -> tuple[str, ...]:
        """Headers of the standard library that the class needs."""
        found = {"atomic", "memory", "string"} if self.action else set()
        found |= {"mutex", "vector"} if self.inputs else set()
        found |= {"string", "vector"} if self.settings else set()
        found |= {"vector"} if self.services else set()
        return tuple(sorted(found))

    @property
    def standard2(self) -> tuple[str, ...]:
        """Headers of the standard library for rclcpp, where a thread processes goals."""
        found = (
            {"condition_variable", "memory", "mutex", "string", "thread"} if self.action else set()
        )
        found |= {"mutex", "vector"} if self.inputs else set()
        found |= {"cstdint", "string", "vector"} if self.settings else set()
        found |= {"memory", "vector"} if self.services else set()
        return tuple(sorted(found))

    @property
    def relies(self) -> tuple[str, ...]:
        """Facts that the user's code relies on, one on a line."""
        found = [f"class {self.cls}"]
        for server in self.servers:
            found.append(f"{server.method}: {server.type}")
            for part, fields in (
                ("takes", server.taken),
                ("gives", server.given),
                ("feedback", server.feedback),
            ):
                # Comments on fields are for people.
                found += (f"{server.method} {part} {f.partition(' - ')[0]}" for f in fields)
        found += (f"input {topic.name}: {topic.type}" for topic in self.inputs)
        found += (f"output {topic.name}: {topic.type}" for topic in self.outputs)
        found += (f"parameter {setting.name}: {setting.type}" for setting in self.settings)
        return tuple(found)


def node_view(node: Node, system: System, language: Language) -> NodeView:
    """Return the view of a node."""
    servers = [_server(server, node, system, language) for server in node.servers]
    action = node.action
    return NodeView(
        model=node.model,
        kind=node.kind,
        package=node.package,
        cls=node.class_name,
        header=f"Generated by swarmc from {_file(node.origin, system)}; do not edit.",
        doc=tuple(comment_lines(node.doc)) or (f"{node.kind.capitalize()} {node.model}.",),
        summary=" ".join(node.doc.split()) or f"{node.kind.capitalize()} {node.model}.",
        imports=_imports(node, language),
        depends=tuple(sorted({type_.package for type_, _ in node.types} - {node.package})),
        action=servers[node.servers.index(action)] if action is not None else None,
        services=tuple(
            view
            for view, server in zip(servers, node.servers, strict=True)
            if server.paradigm == "service"
        ),
        inputs=tuple(_topic(topic, language) for topic in node.inputs),
        outputs=tuple(_topic(topic, language) for topic in node.outputs),
        settings=tuple(_setting(setting, language) for setting in node.settings),
    )


def _imports(node: Node, language: Language) -> tuple[str, ...]:
    """Return the modules or headers, each with the first place in the model that needs it."""
    found: dict[str, TracedStr] = {}
    for type_, kind, origin in node.uses:
        module = language.imported(type_, kind)
        found.setdefault(module, TracedStr(module, origin))
    return tuple(sorted(found.values()))


def _file(origin: Span | None, system: System) -> str:
    return file_name(origin) if origin is not None else system.name


def _topic(topic: Topic, language: Language) -> TopicView:
    return TopicView(
        TracedStr(topic.name, topic.origin),
        topic.topic,
        language.literal(topic.topic),
        TracedStr(language.named(topic.type, "msg"), topic.origin),
        comments(topic.origin, topic.doc),
    )


def _server(server: Server, node: Node, system: System, language: Language) -> ServerView:
    kind = "action" if server.paradigm == "action" else "srv"
    interface = system.interface(server.type)
    fields = (
        interface_parts(interface) if isinstance(interface, (Action, Service)) else ((), (), ())
    )
    words = ("goal", "result", "feedback") if kind == "action" else ("request", "response", "")
    taken, given, feedback = (
        tuple(_field(field, word, language) for field in part)
        for word, part in zip(words, (*fields, ())[:3], strict=True)
    )
    method = "execute" if server.method == "execute" else f"handle_{server.method}"
    types = language.server_types(server.type, kind)
    what = node.model if server.method == "execute" else f"{node.model}.{server.method}"
    return ServerView(
        method=TracedStr(method, server.origin),
        name=server.name,
        literal=language.literal(
            server.name.replace("~", "~/") if language.ros == 2 else server.name
        ),
        local=language.literal(server.name.removeprefix("~")),
        type=TracedStr(types[0], server.origin),
        taken_type=TracedStr(types[1], server.origin),
        given_type=TracedStr(types[2], server.origin),
        feedback_type=TracedStr(types[3], server.origin),
        taken=taken,
        given=given,
        feedback=feedback,
        refusal=language.refusal(f"{what} is not implemented", _plain(fields[1])),
        reports_failure=reports_failure(_plain(fields[1]), language.ros),
        comments=comments(server.origin, server.doc),
    )


def _plain(fields: Iterable[Field]) -> dict[str, str]:
    return {field.name: str(field.type) for field in fields}


def _field(field: Field, word: str, language: Language) -> str:
    said = " ".join(field.doc.split())
    text = f"{word}.{language.field(field.name)} : {field.type}"
    return f"{text} - {said}" if said else text


def _setting(setting: Setting, language: Language) -> SettingView:
    type_ = setting.type
    unit = " in seconds" if type_ == DURATION else ""
    about = " ".join((setting.doc or setting.key).split())
    value = setting.default
    return SettingView(
        name=TracedStr(setting.name, setting.origin),
        key=setting.key,
        type=language.setting_type(type_),
        default="" if value is None else language.value(value, type_),
        zero=language.zero(type_),
        yaml="" if value is None else yaml_value(value),
        said=f"{type_}{unit}",
        about=about,
        about_literal=language.literal(about),
        declared=language.declared(type_),
        example=language.example(type_),
        comments=(*comments(setting.origin, setting.doc), *(("In seconds.",) if unit else ())),
    )
