"""The syntax tree of a .swarm file: one class for each rule of the grammar.

`parse` makes these nodes, `link` fills in what names refer to (`Ref.target`,
`TypeRef.type`), and from then on nothing changes them. Attributes are called as in
`grammar/*.tx`; a test holds the two against each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import Generic, Literal, TypeVar

from swarmdsl.ir.types import Named, Type
from swarmdsl.source import Span


class Word(str):
    """A piece of text with its place: a name as written, or the content of a quoted text."""

    __slots__ = ("span",)
    span: Span

    def __new__(cls, text: str, span: Span) -> Word:
        """Make the word `text` that stands at `span`."""
        word = super().__new__(cls, text)
        word.span = span
        return word


@dataclass(slots=True, eq=False)
class Node:
    """A piece of the model; `span` covers all of it, without its documentation."""

    span: Span


@dataclass(slots=True, eq=False)
class Documented(Node):
    """A node that a `///` comment before it documents."""

    doc: str = field(default="", init=False)


N = TypeVar("N", bound=Node)


@dataclass(slots=True, eq=False)
class Ref(Generic[N]):
    """A name that refers to a node of class `kind`; `target` is None until it is linked."""

    name: str
    kind: str
    span: Span
    target: N | None = None


@dataclass(slots=True, eq=False)
class TypeRef(Node):
    """A type by name; `type` is None until it is linked, and after, if there is none.

    `bound` (`<=10`) and `array` (`[]`, `[16]`, `[<=5]`) are as written, or empty.
    """

    name: str
    bound: str
    array: str
    type: Type | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Expression(Node):
    """An expression of the small language in expression.lark; `tree` is None if it is wrong."""

    tree: ExpressionTree | None = field(default=None, init=False)


# ---- expressions (made from the text of an Expression by `expressions.parse`)


@dataclass(slots=True, eq=False)
class Value(Node):
    """A number, text or truth value; `unit` as written, or empty."""

    value: bool | int | float | str
    unit: str = ""


@dataclass(slots=True, eq=False)
class NameUse(Node):
    """The name of a value, or of an enum before one of its; `event` is a name of its own."""

    name: str
    target: Variable | Param | Constant | EnumType | FitnessInput | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )


@dataclass(slots=True, eq=False)
class FieldUse(Node):
    """`base.name`."""

    base: ExpressionTree
    name: Word


@dataclass(slots=True, eq=False)
class Call(Node):
    """`function(arguments)`, the function a built-in one."""

    function: Word
    arguments: tuple[ExpressionTree, ...]


@dataclass(slots=True, eq=False)
class OperatorUse(Node):
    """An operator with one or two operands."""

    operator: Word
    operands: tuple[ExpressionTree, ...]


ExpressionTree = Value | NameUse | FieldUse | Call | OperatorUse


# ---- interfaces


@dataclass(slots=True, eq=False)
class Field(Documented):
    """A field of a message or struct."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class StructType(Documented):
    """`struct Pose2D { ... }`."""

    name: Word
    fields: list[Field]


@dataclass(slots=True, eq=False)
class EnumValue(Documented):
    """`NAME` or `NAME = 4`; `value` is as written, or empty."""

    name: Word
    value: str


@dataclass(slots=True, eq=False)
class EnumType(Documented):
    """`enum Mode : uint8 { ... }`; `type` is None until it is linked."""

    name: Word
    underlying: TypeRef | None
    values: list[EnumValue]
    type: Named | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Constant(Documented):
    """`const NAME : type = value`."""

    name: Word
    type: TypeRef
    value: Expression


@dataclass(slots=True, eq=False)
class AliasType(Documented):
    """`type Distance = float64`."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class MessageType(Documented):
    """`message Name { ... }`; a name with `/` describes a message of another package."""

    name: Word
    constants: list[Constant]
    fields: list[Field]


@dataclass(slots=True, eq=False)
class ServiceType(Documented):
    """`service Name { request { ... } response { ... } }`."""

    name: Word
    request: list[Field]
    response: list[Field]


@dataclass(slots=True, eq=False)
class ActionType(Documented):
    """`action Name { goal { ... } result { ... } feedback { ... } }`."""

    name: Word
    goal: list[Field]
    result: list[Field]
    feedback: list[Field]


@dataclass(slots=True, eq=False)
class Event(Documented):
    """`event Name : Type on "topic"`; `swarm` when it travels between members."""

    swarm: bool
    name: Word
    type: TypeRef
    topic: Word | None


@dataclass(slots=True, eq=False)
class Param(Documented):
    """`param name : Type = default`."""

    name: Word
    type: TypeRef
    default: Expression | None


@dataclass(slots=True, eq=False)
class Communication(Documented):
    """`action "name" : Type` or `service "name" : Type` of a function."""

    paradigm: Literal["action", "service"]
    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class FunctionPort(Documented):
    """`in "topic" : Type` of a function."""

    direction: Literal["in", "out"]
    topic: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Function(Documented):
    """`function name : abstraction { ... }`."""

    name: Word
    category: Literal["abstraction", "swarm"]
    items: list[Communication | FunctionPort | Param]


# ---- architecture


@dataclass(slots=True, eq=False)
class Port(Documented):
    """`out name : Type on "topic"`."""

    direction: Literal["in", "out", "inout"]
    name: Word
    type: TypeRef
    topic: Word | None


@dataclass(slots=True, eq=False)
class Component(Documented):
    """`sensor Name { ... }` and the other kinds."""

    kind: Literal["sensor", "actuator", "controller", "virtual"]
    name: Word
    base: Ref[Component] | None
    items: list[Port | Param | Operation | BehaviorUse]


@dataclass(slots=True, eq=False)
class Parameter(Documented):
    """`in name : Type` of an operation; `direction` is empty where none is written."""

    direction: Literal["in", "out", ""]
    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Operation(Documented):
    """`operation name(in x : Type, out y : Type)` of a component."""

    name: Word
    parameters: list[Parameter]


@dataclass(slots=True, eq=False)
class BehaviorUse(Node):
    """`behavior Machine`."""

    machine: Ref[StateMachine]


@dataclass(slots=True, eq=False)
class PartValue(Node):
    """`name = value` in a part."""

    name: Word
    value: Expression


@dataclass(slots=True, eq=False)
class CommunicationSettings(Node):
    """`communication zyre { ifname = "eth0" }`."""

    technology: Word
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class Part(Documented):
    """`name : Component { ... }`."""

    name: Word
    component: Ref[Component]
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class PortRef(Node):
    """`part.port`, or `port` of the member itself."""

    part: Ref[Part] | None
    port: Ref[Port]


@dataclass(slots=True, eq=False)
class Connector(Node):
    """`connect source -> target`."""

    source: PortRef
    target: PortRef


@dataclass(slots=True, eq=False)
class Member(Documented):
    """`member Name { ... }`."""

    name: Word
    base: Ref[Member] | None
    items: list[BehaviorUse | CommunicationSettings | Port | Param | Connector | Part]


# ---- behaviour


@dataclass(slots=True, eq=False)
class Variable(Documented):
    """`var name : Type = initial`."""

    name: Word
    type: TypeRef
    initial: Expression | None


@dataclass(slots=True, eq=False)
class Argument(Node):
    """`name = value` in a call or a send."""

    name: Word
    value: Expression


@dataclass(slots=True, eq=False)
class ResultMapping(Node):
    """`field => variable`."""

    field: Word
    target: Expression


@dataclass(slots=True, eq=False)
class Activity(Node):
    """`do function(...) gives (...)`."""

    function: Ref[Function | Operation]
    goal_callback: Word | None
    arguments: list[Argument]
    result_callback: Word | None
    results: list[ResultMapping]


@dataclass(slots=True, eq=False)
class OutcomeTrigger(Node):
    """`succeeded`, `aborted` or `preempted`."""

    outcome: str


@dataclass(slots=True, eq=False)
class DoneTrigger(Node):
    """`done`, `done.Final`, `Region.done` or `Region.done.Final`."""

    region: Ref[Region] | None
    final: Ref[FinalState] | None


@dataclass(slots=True, eq=False)
class EventTrigger(Node):
    """The name of an event."""

    event: Ref[Event]


@dataclass(slots=True, eq=False)
class TimeTrigger(Node):
    """`after delay`."""

    delay: Expression


@dataclass(slots=True, eq=False)
class MonitorTrigger(Node):
    """`monitor "topic" : Type`."""

    topic: Word
    type: TypeRef


Trigger = OutcomeTrigger | DoneTrigger | EventTrigger | TimeTrigger | MonitorTrigger


@dataclass(slots=True, eq=False)
class Send(Node):
    """`send Event(...)`."""

    event: Ref[Event]
    arguments: list[Argument]


@dataclass(slots=True, eq=False)
class Assignment(Node):
    """`target = value`."""

    target: Expression
    value: Expression


Effect = Send | Assignment


@dataclass(slots=True, eq=False)
class Transition(Node):
    """`on trigger [guard] / effects -> target`; what is not written is None or empty."""

    internal: bool
    triggers: list[Trigger]
    guard: Expression | None
    effects: list[Effect]
    target: Ref[Vertex] | None


@dataclass(slots=True, eq=False)
class Entry(Node):
    """`entry / effects`."""

    effects: list[Effect]


@dataclass(slots=True, eq=False)
class Exit(Node):
    """`exit / effects`."""

    effects: list[Effect]


@dataclass(slots=True, eq=False)
class Initial(Node):
    """`initial State`."""

    target: Ref[Vertex]


@dataclass(slots=True, eq=False)
class FinalState(Documented):
    """`final Name`."""

    name: Word


@dataclass(slots=True, eq=False)
class Branch(Node):
    """`[guard] / effects -> target` or `else ... -> target` in a choice.

    `otherwise` is the word `else`, or empty.
    """

    guard: Expression | None
    otherwise: str
    effects: list[Effect]
    target: Ref[Vertex]


@dataclass(slots=True, eq=False)
class Choice(Documented):
    """`choice Name { ... }`."""

    name: Word
    branches: list[Branch]


@dataclass(slots=True, eq=False)
class State(Documented):
    """`state Name { ... }` or `state Name = Machine(param = value) { ... }`."""

    name: Word
    machine: Ref[StateMachine] | None
    bindings: list[Argument]
    items: list[Activity | Entry | Exit | Transition | Initial | Vertex]


@dataclass(slots=True, eq=False)
class Region(Documented):
    """`region Name { ... }`."""

    name: Word
    items: list[Initial | Vertex]


@dataclass(slots=True, eq=False)
class Parallel(Documented):
    """`parallel state Name { ... }`."""

    name: Word
    items: list[Region | Entry | Exit | Transition]


@dataclass(slots=True, eq=False)
class StateMachine(Documented):
    """`statemachine Name { ... }`."""

    endless: bool
    name: Word
    items: list[Param | Variable | Initial | Vertex]


@dataclass(slots=True, eq=False)
class History(Documented):
    """`history Name -> target` or `deep history Name -> target`."""

    deep: bool
    name: Word
    target: Ref[Vertex]


Vertex = State | Parallel | Choice | History | FinalState
Container = StateMachine | State | Parallel | Region


# ---- composition


@dataclass(slots=True, eq=False)
class Multiplicity(Node):
    """`3`, `1..5`, `2..*` or `*`, the bounds as written."""

    lower: str
    upper: str


@dataclass(slots=True, eq=False)
class Role(Documented):
    """`name : Member[multiplicity]`."""

    name: Word
    member: Ref[Member]
    multiplicity: Multiplicity | None


@dataclass(slots=True, eq=False)
class EnvironmentUse(Node):
    """`environment Name` in a swarm."""

    environment: Ref[Environment]


@dataclass(slots=True, eq=False)
class Swarm(Documented):
    """`swarm Name { ... }`."""

    name: Word
    items: list[EnvironmentUse | FitnessUse | Role]


@dataclass(slots=True, eq=False)
class FitnessUse(Node):
    """`fitness Name` in a swarm."""

    fitness: Ref[Fitness]


@dataclass(slots=True, eq=False)
class FitnessInput(Documented):
    """`in name : Type`, measured in a run."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Objective(Node):
    """`maximize expression` or `minimize expression`."""

    goal: Literal["maximize", "minimize"]
    value: Expression


@dataclass(slots=True, eq=False)
class Fitness(Documented):
    """`fitness Name { ... }`."""

    name: Word
    items: list[FitnessInput | Param | Objective]


@dataclass(slots=True, eq=False)
class Setting(Node):
    """`steps 1000`, `evaluations 50` or `seed 42`."""

    name: Literal["steps", "evaluations", "seed"]
    value: Expression


@dataclass(slots=True, eq=False)
class CountRange(Node):
    """`count of role in lower .. upper`."""

    role: Ref[Role]
    lower: Expression
    upper: Expression


@dataclass(slots=True, eq=False)
class ParamRange(Node):
    """`role.param in lower .. upper step step`."""

    role: Ref[Role]
    param: Ref[Param]
    lower: Expression
    upper: Expression
    step: Expression | None


@dataclass(slots=True, eq=False)
class Optimization(Documented):
    """`optimize Swarm { ... }`."""

    swarm: Ref[Swarm]
    items: list[Setting | CountRange | ParamRange]


@dataclass(slots=True, eq=False)
class World(Node):
    """`world "file"`."""

    file: Word


@dataclass(slots=True, eq=False)
class Size(Node):
    """`size 100 m x 100 m`, the lengths as written."""

    width: str
    depth: str
    height: str


_METRES = {"mm": 0.001, "cm": 0.01, "km": 1000.0, "m": 1.0}


def in_metres(length: str) -> float:
    """A length as written, `10 m` for instance, in metres."""
    unit = next(unit for unit in _METRES if length.endswith(unit))
    return float(length.removesuffix(unit)) * _METRES[unit]


@dataclass(slots=True, eq=False)
class Environment(Documented):
    """`environment Name { ... }`."""

    name: Word
    items: list[World | Size]


# ---- the file


@dataclass(slots=True, eq=False)
class Package(Documented):
    """`package name`."""

    name: Word


@dataclass(slots=True, eq=False)
class ImportFile(Node):
    """`import "file"`."""

    path: Word


@dataclass(slots=True, eq=False)
class ImportRos(Node):
    """`import ros "folder"`."""

    path: Word


@dataclass(slots=True, eq=False)
class ImportLibrary(Node):
    """`import package.Name` or `import package.*`."""

    name: str


Import = ImportFile | ImportRos | ImportLibrary
Interface = StructType | EnumType | AliasType | MessageType | ServiceType | ActionType
Declaration = (
    Interface
    | Constant
    | Event
    | Function
    | Component
    | Member
    | StateMachine
    | Swarm
    | Environment
    | Fitness
)


@dataclass(slots=True, eq=False)
class Model(Node):
    """A whole file."""

    package: Package | None
    imports: list[Import]
    declarations: list[Declaration]
    optimizations: list[Optimization]


NODES: dict[str, type[Node]] = {
    cls.__name__: cls
    for cls in list(globals().values())
    if isinstance(cls, type) and issubclass(cls, Node)
}
# Where the parts of a node are; a node that it only refers to is no part of it.
_ATTRIBUTES = {
    cls: [part.name for part in fields(cls) if "elsewhere" not in part.metadata]
    for cls in NODES.values()
}


def children(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in document order."""
    for attribute in _ATTRIBUTES[type(node)]:
        value = getattr(node, attribute)
        if isinstance(value, Node):
            yield value
        elif isinstance(value, (list, tuple)):
            yield from (item for item in value if isinstance(item, Node))


def walk(node: Node) -> Iterator[Node]:
    """A node and all inside it, in document order."""
    yield node
    for child in children(node):
        yield from walk(child)
