"""Components with ports, members built from them, and swarms of members."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.ir.derived import DERIVED
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.interfaces import Param
from swarmdsl.ir.space import (
    Area,
    Obstacle,
    Point,
    Rain,
    Sight,
    Targets,
    Values,
    Wall,
    Wind,
    Zone,
)
from swarmdsl.syntax.types import Type

Direction = Literal["in", "out", "inout"]


@dataclass(frozen=True, slots=True)
class Port:
    """Entry or exit of data; `topic` is the ROS topic behind the port."""

    name: str
    direction: Direction
    type: Type
    topic: str
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Component:
    """Sensor, actuator, controller or virtual component, with all that it inherits.

    `operations` are names of functions; `behavior` names a state machine. `sights` are what it
    finds in space.
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
    sights: tuple[Sight, ...] = ()


@dataclass(frozen=True, slots=True)
class CommunicationSettings:
    """Technology by which a member reaches the others, with its settings."""

    technology: str
    values: tuple[tuple[str, Expression], ...]
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Part:
    """Component in a member; `values` are the params set there.

    `operations` are names of functions: the component's, called on this part.
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
    """Port of a part, or of the member itself (`part` None)."""

    part: str | None
    port: str

    def __str__(self) -> str:
        return f"{self.part}.{self.port}" if self.part else self.port


@dataclass(frozen=True, slots=True)
class Connector:
    """Data flow from `source` to `target`."""

    source: PortRef
    target: PortRef
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class PortGroup:
    """Ports of a member that connectors join, in model order, and their ROS topic."""

    ports: tuple[PortRef, ...]
    topic: str


@dataclass(frozen=True, slots=True)
class Contract:
    """`on` events, with a guard on their message, a robot is in one of some states in time.

    With a `function`, nothing else is given: it is called where the node of the robot has died.
    """

    name: str
    events: tuple[str, ...] = ()
    guard: Expression | None = None
    within: Expression | None = None
    states: tuple[str, ...] = ()
    function: str | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Member:
    """Type of robot, with all that it inherits; `behavior` names its state machine.

    `port_groups` is derived from the connectors. `body`, `battery` and `radio` are what a space
    knows of the robot, empty if the model says nothing; the values may read params.
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
    body: Values = ()
    battery: Values = ()
    radio: Values = ()
    contracts: tuple[Contract, ...] = ()


@dataclass(frozen=True, slots=True)
class Multiplicity:
    """Number of members; `upper` None means any number."""

    lower: int
    upper: int | None

    def __str__(self) -> str:
        if self.upper == self.lower:
            return str(self.lower)
        if self.upper is None and self.lower == 0:
            return "*"
        return f"{self.lower}..{'*' if self.upper is None else self.upper}"


@dataclass(frozen=True, slots=True)
class RobotValues:
    """Params and start of the member with this index in a role."""

    index: int
    values: tuple[tuple[str, Expression], ...]
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    start: str | Point | None = None


@dataclass(frozen=True, slots=True)
class Role:
    """Members of one type in a swarm, with params of all of them and of single `robots`.

    They start at a point, or somewhere in the area of that name.
    """

    name: str
    member: str
    multiplicity: Multiplicity
    values: tuple[tuple[str, Expression], ...] = ()
    robots: tuple[RobotValues, ...] = ()
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    start: str | Point | None = None

    def configured(self, member: Member, index: int | None = None) -> Member:
        """Return the member with the values of the role, and of one of its robots, as defaults."""
        given = dict(self.values)
        for robot in self.robots:
            if robot.index == index:
                given.update(robot.values)
        if not given:
            return member
        params = (
            replace(param, default=given.get(param.name, param.default)) for param in member.params
        )
        return replace(member, params=tuple(params))


@dataclass(frozen=True, slots=True)
class Environment:
    """World of a swarm; `size` is width, depth and perhaps height in metres."""

    name: str
    world: str | None
    size: tuple[float, ...] | None
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    areas: tuple[Area, ...] = ()
    zones: tuple[Zone, ...] = ()
    walls: tuple[Wall, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    targets: tuple[Targets, ...] = ()
    winds: tuple[Wind, ...] = ()
    rains: tuple[Rain, ...] = ()


@dataclass(frozen=True, slots=True)
class Heartbeat:
    """Period at which a robot says that it is there, and the silence after which it is lost.

    Both times are in nanoseconds.
    """

    period: int
    timeout: int
    doc: str = ""
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
    heartbeat: Heartbeat | None = None
