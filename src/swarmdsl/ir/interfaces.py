"""Messages, services, actions, events and functions of robots."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.naming import incoming_topic
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.space import ModelUse
from swarmdsl.syntax.types import Named, Type


@dataclass(frozen=True, slots=True)
class Field:
    """Named field of a message."""

    name: str
    type: Type
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Constant:
    """Named value of a message, or of an enum (a message of constants only)."""

    name: str
    type: Type
    value: Expression
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Message:
    """ROS message, or struct of the model.

    `external` means that the model only describes it: its package defines it.
    """

    type: Named
    fields: tuple[Field, ...]
    external: bool
    constants: tuple[Constant, ...] = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Service:
    """ROS service."""

    type: Named
    request: tuple[Field, ...]
    response: tuple[Field, ...]
    external: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Action:
    """ROS action."""

    type: Named
    goal: tuple[Field, ...]
    result: tuple[Field, ...]
    feedback: tuple[Field, ...]
    external: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


Interface = Message | Service | Action


@dataclass(frozen=True, slots=True)
class Delivery:
    """Delivery of a swarm event; times are in nanoseconds, None stands for what is not given.

    `reliable` is False for best effort. `latest` is True if who comes later gets the last event,
    `keep` the number of events that wait for a receiver, `lifespan` the age at which an event is
    dropped, `deadline` the longest time between two events of a sender.
    """

    reliable: bool | None = None
    latest: bool = False
    keep: int | None = None
    lifespan: int | None = None
    deadline: int | None = None
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Event:
    """Event, known by a message on a topic.

    A swarm event (`swarm` true) is published on `topic` by its sender and arrives at the
    other members on `bridge/events/<topic>`, which the swarmros bridge provides. Heartbeats raise
    a `predefined` one, which has no topic. A person may send an `operator` event at any time.
    """

    name: str
    type: Type
    topic: str
    swarm: bool
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    delivery: Delivery | None = None
    predefined: bool = False
    operator: bool = False

    @property
    def incoming_topic(self) -> str:
        """Topic on which a member receives the event."""
        return incoming_topic(self.topic, self.swarm)


@dataclass(frozen=True, slots=True)
class Param:
    """ROS parameter; `default` is None if a value is required at start.

    The default of a state machine's param is the value on which all users of the machine agree;
    `declared` is the machine's own default, used by those that set none.
    """

    name: str
    type: Type
    default: Expression | None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    declared: Expression | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class FunctionPort:
    """Topic that a function subscribes to (`in`) or publishes on (`out`)."""

    direction: Literal["in", "out"]
    topic: str
    type: Type
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Communication:
    """ROS action or service `name` of interface `type` that calls a function."""

    paradigm: Literal["action", "service"]
    name: str
    type: Named
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Function:
    """Capability of a robot, from the abstraction or the swarm library.

    If it is `in_library`, it comes with a library of models, so an implementation exists. Its
    `model` says what it does in space.
    """

    name: str
    category: Literal["abstraction", "swarm"]
    communication: Communication
    ports: tuple[FunctionPort, ...]
    params: tuple[Param, ...]
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    in_library: bool = field(default=False, compare=False, repr=False)
    model: ModelUse | None = None
