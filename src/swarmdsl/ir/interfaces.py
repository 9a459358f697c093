"""Messages, services, actions, events and the functions a robot offers."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.naming import incoming_topic
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.expressions import Expression
from swarmdsl.syntax.types import Named, Type


@dataclass(frozen=True, slots=True)
class Field:
    """A named piece of data of a message."""

    name: str
    type: Type
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Constant:
    """A named value: of a message, or of an enum (a message of nothing but constants)."""

    name: str
    type: Type
    value: Expression
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Message:
    """Fields of a ROS message, or of a struct of the model.

    `external` means the model only describes it: its package defines it.
    """

    type: Named
    fields: tuple[Field, ...]
    external: bool
    constants: tuple[Constant, ...] = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Service:
    """A ROS service interface."""

    type: Named
    request: tuple[Field, ...]
    response: tuple[Field, ...]
    external: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Action:
    """A ROS action interface."""

    type: Named
    goal: tuple[Field, ...]
    result: tuple[Field, ...]
    feedback: tuple[Field, ...]
    external: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


Interface = Message | Service | Action


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happens, known by a message on a topic.

    A swarm event (`swarm` true) is published on `topic` by its sender and arrives at the
    other members on `bridge/events/<topic>`, which the swarmros bridge provides.
    """

    name: str
    type: Type
    topic: str
    swarm: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)

    @property
    def incoming_topic(self) -> str:
        """The topic on which a member hears of it."""
        return incoming_topic(self.topic, self.swarm)


@dataclass(frozen=True, slots=True)
class Param:
    """A ROS parameter; `default` is None where a value must be given at start.

    That of a state machine is the value on which those agree who behave so; `declared` is the
    one that the machine says itself, for whoever gives it none.
    """

    name: str
    type: Type
    default: Expression | None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    declared: Expression | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class FunctionPort:
    """A topic that a function listens to (`in`) or publishes on (`out`)."""

    direction: Literal["in", "out"]
    topic: str
    type: Type
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Communication:
    """How a function is called: the ROS action or service `name` of interface `type`."""

    paradigm: Literal["action", "service"]
    name: str
    type: Named
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Function:
    """What a robot can do, as the abstraction or the swarm library offers it.

    One that is `in_library` comes with a library of models, so that somebody has written it.
    """

    name: str
    category: Literal["abstraction", "swarm"]
    communication: Communication
    ports: tuple[FunctionPort, ...]
    params: tuple[Param, ...]
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    in_library: bool = field(default=False, compare=False, repr=False)
