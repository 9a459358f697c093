"""Components with ports, members built from them, and swarms of members."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.derived import DERIVED
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.interfaces import Param
from swarmdsl.syntax.types import Type

Direction = Literal["in", "out", "inout"]


@dataclass(frozen=True, slots=True)
class Port:
    """Where data flows in or out; `topic` is the ROS topic behind it."""

    name: str
    direction: Direction
    type: Type
    topic: str
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Component:
    """A sensor, actuator, controller or virtual component, with all that it inherits.

    `operations` are names of functions; `behavior` names a state machine.
    """

    name: str
    kind: Literal["sensor", "actuator", "controller", "virtual"]
    ports: tuple[Port, ...]
    params: tuple[Param, ...]
    operations: tuple[str, ...] = ()
    behavior: str | None = None
    base: str | None = None
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class CommunicationSettings:
    """How a member reaches the others: the technology and its settings."""

    technology: str
    values: tuple[tuple[str, Expression], ...]
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Part:
    """A component in its place in a member; `values` are the params set there.

    `operations` are names of functions: those of the component, asked of this part.
    """

    name: str
    component: str
    values: tuple[tuple[str, Expression], ...]
    operations: tuple[str, ...] = ()
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class PortRef:
    """A port of a part, or of the member itself (`part` None)."""

    part: str | None
    port: str

    def __str__(self) -> str:
        return f"{self.part}.{self.port}" if self.part else self.port


@dataclass(frozen=True, slots=True)
class Connector:
    """Data flows from `source` to `target`."""

    source: PortRef
    target: PortRef
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class PortGroup:
    """Ports of a member that connectors join, in the order of the model, and their ROS topic."""

    ports: tuple[PortRef, ...]
    topic: str


@dataclass(frozen=True, slots=True)
class Member:
    """A type of robot, with all that it inherits; `behavior` names its state machine.

    `port_groups` is derived from the connectors.
    """

    name: str
    behavior: str | None
    ports: tuple[Port, ...]
    params: tuple[Param, ...]
    parts: tuple[Part, ...]
    connectors: tuple[Connector, ...]
    communication: CommunicationSettings | None = None
    base: str | None = None
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    port_groups: tuple[PortGroup, ...] = field(default=(), compare=False, metadata=DERIVED)


@dataclass(frozen=True, slots=True)
class Multiplicity:
    """How many; `upper` None means any number."""

    lower: int
    upper: int | None

    def __str__(self) -> str:
        if self.upper == self.lower:
            return str(self.lower)
        if self.upper is None and self.lower == 0:
            return "*"
        return f"{self.lower}..{'*' if self.upper is None else self.upper}"


@dataclass(frozen=True, slots=True)
class Role:
    """Members of one type in a swarm."""

    name: str
    member: str
    multiplicity: Multiplicity
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Environment:
    """The world a swarm lives in; `size` is width, depth and perhaps height in metres."""

    name: str
    world: str | None
    size: tuple[float, ...] | None
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Swarm:
    """Members that work together."""

    name: str
    roles: tuple[Role, ...]
    environment: str | None
    fitness: str | None = None
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
