"""Expressions of guards, effects and arguments, with their types."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.base.records import field as dataclass_field
from swarmdsl.base.source import Span
from swarmdsl.syntax.types import DURATION, Type


@dataclass(frozen=True, slots=True)
class Literal:
    """Value written in the model; durations are in nanoseconds (ROS's unit).

    `name` is what the model calls it, such as `Mode.AUTO`, if it is a value of an enum or a
    constant. The value counts, not its name.
    """

    value: bool | int | float | str
    type: Type
    name: str = dataclass_field(default="", compare=False, repr=False, kw_only=True)
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)

    @property
    def milliseconds(self) -> float:
        """Length of a duration literal."""
        assert self.type == DURATION
        assert isinstance(self.value, int)
        return self.value / 1_000_000


@dataclass(frozen=True, slots=True)
class VariableRef:
    """Value of a variable of the machine."""

    name: str
    type: Type
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ParamRef:
    """Value of a param of the machine, fixed when the robot starts."""

    name: str
    type: Type
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class EventData:
    """Message of the triggering event."""

    type: Type
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class SelfField:
    """`self.field`: a fact about the robot that runs the machine, fixed when it starts."""

    field: str
    type: Type
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class EnvelopeField:
    """`event.field` of a swarm event: a fact about the event, whatever its message.

    `header` is the field of the message in which robots carry it; None if its message has none.
    """

    field: str
    type: Type
    header: Expression | None = None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class FieldAccess:
    """`base.field`; `type` is None if the fields of the message are not known."""

    base: Expression
    field: str
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Unary:
    """`not x` or `-x`."""

    operator: str
    operand: Expression
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Binary:
    """`x operator y`, the operator as written in the model."""

    operator: str
    left: Expression
    right: Expression
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Call:
    """Built-in function of `operations.py`.

    The arguments of `distance` are the coordinates of one point, then those of the other.
    """

    function: str
    arguments: tuple[Expression, ...]
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


Expression = (
    Literal
    | VariableRef
    | ParamRef
    | EventData
    | EnvelopeField
    | SelfField
    | FieldAccess
    | Unary
    | Binary
    | Call
)


def subexpressions(expression: Expression) -> Iterator[Expression]:
    """Yield the expression and all inside it."""
    yield expression
    match expression:
        case EnvelopeField(header=header) if header is not None:
            yield from subexpressions(header)
        case FieldAccess(base=base):
            yield from subexpressions(base)
        case Unary(operand=operand):
            yield from subexpressions(operand)
        case Binary(left=left, right=right):
            yield from subexpressions(left)
            yield from subexpressions(right)
        case Call(arguments=arguments):
            for argument in arguments:
                yield from subexpressions(argument)


def reads(expression: Expression) -> set[str]:
    """Return the names of the variables that an expression reads."""
    return {part.name for part in subexpressions(expression) if isinstance(part, VariableRef)}
