"""Expressions of guards, effects and arguments, with their types."""

from __future__ import annotations

import typing
from collections.abc import Callable, Iterator

from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.records import field as dataclass_field
from swarmdsl.base.source import Span
from swarmdsl.syntax.types import BOOL, DURATION, Named, Type

Conversion = typing.Literal["", "implied", "seconds"]


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
    """`x operator y`, the operator as written in the model.

    `conversion` tells how the model writes a division by `1 s` that makes a duration a number:
    `implied` where it has the duration alone, `seconds` where it calls that function.
    """

    operator: str
    left: Expression
    right: Expression
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)
    conversion: Conversion = dataclass_field(default="", compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Call:
    """Built-in function of `operations.py`.

    The arguments of `distance` are the coordinates of one point, then those of the other. `item`
    is `a[i]`. An effect on an array assigns the changed array: `append` has the array, the value
    and the greatest length as arguments, `remove` the array and a number, `replace` the array, a
    number and the value, and `empty` none.
    """

    function: str
    arguments: tuple[Expression, ...]
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ItemRef:
    """Item that a query looks at."""

    name: str
    type: Type
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Query:
    """`function(item in array where condition by key)`.

    `count`, `any` and `all` have a condition and no key. `min` and `max` are the first item with
    the least or greatest key, the items themselves without one.
    """

    function: str
    item: str
    array: Expression
    condition: Expression | None
    key: Expression | None
    type: Type | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class InState:
    """`in(state)`: true while the state with the id `state` is active."""

    state: str
    type: Type = BOOL
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Elapsed:
    """`elapsed(state)`: for how long the state with the id `state` has been active."""

    state: str
    type: Type = DURATION
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Construction:
    """New message with values in some fields; the others have their defaults."""

    type: Named
    values: tuple[tuple[str, Expression], ...]
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
    | ItemRef
    | Query
    | InState
    | Elapsed
    | Construction
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
        case Query(array=array, condition=condition, key=key):
            for part in (array, condition, key):
                if part is not None:
                    yield from subexpressions(part)
        case Construction(values=values):
            for _, value in values:
                yield from subexpressions(value)


def reads_values(expression: Expression) -> bool:
    """Return True if an expression reads variables or params of a robot."""
    return any(isinstance(part, (VariableRef, ParamRef)) for part in subexpressions(expression))


def mapped(expression: Expression, change: Callable[[Expression], Expression]) -> Expression:
    """Return an expression with each of its direct parts changed."""
    match expression:
        case EnvelopeField(header=header) if header is not None:
            return replace(expression, header=change(header))
        case FieldAccess(base=base):
            return replace(expression, base=change(base))
        case Unary(operand=operand):
            return replace(expression, operand=change(operand))
        case Binary(left=left, right=right):
            return replace(expression, left=change(left), right=change(right))
        case Call(arguments=arguments):
            return replace(expression, arguments=tuple(map(change, arguments)))
        case Query(array=array, condition=condition, key=key):
            return replace(
                expression,
                array=change(array),
                condition=change(condition) if condition is not None else None,
                key=change(key) if key is not None else None,
            )
        case Construction(values=values):
            changed = tuple((name, change(value)) for name, value in values)
            return replace(expression, values=changed)
    return expression


def reads(expression: Expression) -> set[str]:
    """Return the names of the variables that an expression reads."""
    return {part.name for part in subexpressions(expression) if isinstance(part, VariableRef)}
