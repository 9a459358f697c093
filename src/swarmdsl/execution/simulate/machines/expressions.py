"""Compile expressions to functions; model text is never evaluated as code.

Values are those of Python: integers of any size, `/` as true division, `%` with the sign of the
divisor. Durations are in nanoseconds, messages are dictionaries.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.execution.engine import ExecutionError, appended, item, removed, replaced
from swarmdsl.ir import (
    Binary,
    Call,
    Construction,
    Elapsed,
    EnvelopeField,
    EventData,
    Expression,
    FieldAccess,
    InState,
    ItemRef,
    Literal,
    ParamRef,
    Query,
    SelfField,
    Unary,
    VariableRef,
)
from swarmdsl.ir.operations import OPERATIONS

PRESENT = "present()"
"""Key of a function in the data of a machine: the number of robots of a role that are there."""
NEIGHBORS = "neighbors()"
"""Key of a function in the data of a machine: the number of other robots within a distance."""
CHOICE = "choice()"
"""Key of a function in the data of a machine, for proofs: any number less than its argument."""
ONE_OF, ATTEMPT = "one of", "attempt"
"""Names of functions for proofs: one has any of its arguments as its value, the other may fail."""
SELF = "self"
"""Key of the identity of the robot in the data of a machine; no variable has this name."""

ACTIVE = "in"
"""Key of the test for active states in the data; no variable has this name."""

ELAPSED = "elapsed()"
"""Key of the function that gives the time in a state; no variable has this name."""

Value = Callable[[Mapping[str, Any], Any], Any]
"""Compiled expression; takes the data of the machine and the event."""


def function_of(expression: Expression) -> Value:
    """Compile an expression.

    The function raises ArithmeticError or ValueError if an operation has no result, and
    ExecutionError for a missing field of a message.
    """
    match expression:
        case Literal(value=literal):
            return lambda data, event: literal
        case VariableRef(name=name) | ParamRef(name=name):
            return lambda data, event: data[name]
        case EventData():
            return lambda data, event: event.data
        case EnvelopeField(field=field, header=header):
            if header is not None:
                return function_of(header)
            return lambda data, event: getattr(event.envelope, field)
        case SelfField(field=field):
            return lambda data, event: data[SELF][field]
        case FieldAccess(base=base, field=field):
            return _field(function_of(base), field)
        case Unary(operator="not", operand=operand):
            value = function_of(operand)
            return lambda data, event: not value(data, event)
        case Unary(operand=operand):
            value = function_of(operand)
            return _checked("-", lambda data, event: -value(data, event))
        case Binary(operator=symbol, left=left, right=right):
            return _binary(symbol, function_of(left), function_of(right))
        case Call(function="present", arguments=(Literal(value=role),)):
            return lambda data, event: _present(data, str(role))
        case Call(function="present"):
            return lambda data, event: _present(data, None)
        case Call(function="neighbors", arguments=(distance,)):
            reach = function_of(distance)
            return lambda data, event: _neighbors(data, reach(data, event))
        case Call(function=name, arguments=choices) if name == ONE_OF:
            values = [function_of(each) for each in choices]
            return lambda data, event: values[data[CHOICE](len(values))](data, event)
        case Call(function=name) if name == ATTEMPT:
            return lambda data, event: _attempt(data)
        case Call(function="empty"):
            return lambda data, event: []
        case Call(function=name, arguments=arguments):
            return applied(name, [function_of(each) for each in arguments])
        case ItemRef(name=name):
            key = _item_key(name)
            return lambda data, event: data[key]
        case Query():
            return _query(expression)
        case InState(state=state):
            return lambda data, event: data[ACTIVE](state)
        case Elapsed(state=state):
            return lambda data, event: data[ELAPSED](state)
        case Construction():
            raise AssertionError("a new message is only stored or sent")


def _present(data: Mapping[str, Any], role: str | None) -> Any:
    """Return the number of robots that are there; a machine alone is that of the only one."""
    if PRESENT in data:
        return data[PRESENT](role)
    return int(role in (None, data[SELF]["role"]))


def _neighbors(data: Mapping[str, Any], distance: float) -> int:
    """Return the number of robots within a distance, where robots have places."""
    found: int | None = data[NEIGHBORS](distance) if NEIGHBORS in data else None
    if found is None:
        raise ExecutionError("robots have no places here: `neighbors within` has no value")
    return found


def _attempt(data: Mapping[str, Any]) -> bool:
    if data[CHOICE](2):
        raise ExecutionError("a value that is not known may be none")
    return True


def applied(name: str, values: Sequence[Value]) -> Value:
    """Return the function that applies a built-in one to values."""
    function = _ARRAYS.get(name) or OPERATIONS[name]
    return _checked(name, lambda data, event: function(*[value(data, event) for value in values]))


_ARRAYS: Mapping[str, Callable[..., Any]] = {
    "item": item,
    "append": appended,
    "remove": removed,
    "replace": replaced,
}


def _item_key(name: str) -> str:
    """Return the key of an item of a query in the data; no variable has this name."""
    return f"{name} in"


_SUMMARIES: Mapping[str, Callable[..., Any]] = {"count": sum, "any": any, "all": all}


def _query(query: Query) -> Value:
    array, key = function_of(query.array), _item_key(query.item)
    holds = function_of(query.condition) if query.condition is not None else None
    compared = function_of(query.key) if query.key is not None else None

    def results(of: Value, data: Mapping[str, Any], event: Any) -> Iterator[tuple[Any, Any]]:
        """Yield each item with the value of a function of it."""
        for each in array(data, event):
            yield each, of({**data, key: each}, event)

    if query.function in ("count", "any", "all"):
        assert holds is not None
        summary: Callable[[Iterable[bool]], Any] = _SUMMARIES[query.function]
        condition = holds
        return _checked(
            query.function,
            lambda data, event: summary(bool(held) for _, held in results(condition, data, event)),
        )
    extreme = min if query.function == "min" else max

    def found(data: Mapping[str, Any], event: Any) -> Any:
        items = array(data, event)
        if holds is not None:
            items = [each for each, held in results(holds, data, event) if held]
        if compared is None:
            return extreme(items)
        return extreme(items, key=lambda each: compared({**data, key: each}, event))

    return _checked(query.function, found)


def _binary(symbol: str, left: Value, right: Value) -> Value:
    if symbol == "and":
        return lambda data, event: left(data, event) and right(data, event)
    if symbol == "or":
        return lambda data, event: left(data, event) or right(data, event)
    operation = OPERATIONS[symbol]
    return _checked(symbol, lambda data, event: operation(left(data, event), right(data, event)))


def _checked(symbol: str, operation: Value) -> Value:
    """Convert TypeErrors: fields of an unknown message type can have any value."""

    def value(data: Mapping[str, Any], event: Any) -> Any:
        try:
            return operation(data, event)
        except TypeError:
            raise ExecutionError(f"`{symbol}` is not defined for a value in the message") from None

    return value


def _field(base: Value, field: str) -> Value:
    def value(data: Mapping[str, Any], event: Any) -> Any:
        held = base(data, event)
        try:
            return held[field]
        except (KeyError, TypeError):
            raise ExecutionError(f"there is no field `{field}` in {held!r}") from None

    return value
