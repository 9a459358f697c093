"""Give the numbers of imported expressions the units that the model expects.

Documents have plain numbers in the units of ROS. With `altitude` in metres, `altitude > 15`
becomes `altitude > 15 m`, and `sin(x)` becomes `sin(x * 1 rad)`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar, cast

from swarmdsl.analysis.types.unit_rules import (
    NUMBER_OF_SECONDS,
    has_root,
    must_be_alike,
    result_unit,
    taken_unit,
    units_fit,
)
from swarmdsl.base.records import fields_of, replace
from swarmdsl.base.source import Span
from swarmdsl.ir import (
    Action,
    Activity,
    Array,
    Assignment,
    Binary,
    Call,
    Construction,
    Expression,
    Field,
    FieldAccess,
    Interface,
    Literal,
    Message,
    Named,
    Param,
    ParamRef,
    Primitive,
    Query,
    Send,
    Service,
    StateMachine,
    System,
    Type,
    Unary,
    Variable,
    VariableRef,
)
from swarmdsl.ir.operations import SECOND
from swarmdsl.syntax.types import DURATION, FLOAT, INT, unit_of, with_unit
from swarmdsl.syntax.units import ANY, PERCENT, PLAIN, UNITS, Unit, unit_of_ros

T = TypeVar("T")

_EXPRESSIONS = (
    Literal,
    VariableRef,
    ParamRef,
    FieldAccess,
    Unary,
    Binary,
    Call,
    Query,
    Construction,
)


def give_units(system: System) -> System:
    """Return the system with units in the expressions of its machines."""
    fields = {
        (known.type, field.name): field.type
        for known in system.interfaces
        for field in _fields_of(known)
    }
    taken = {each.name: each.communication.type for each in system.functions}
    sent = {each.name: each.type for each in system.events}
    return replace(
        system,
        machines=tuple(_Units(each, fields, sent, taken).node(each) for each in system.machines),
    )


def _fields_of(known: Interface) -> Iterable[Field]:
    match known:
        case Message(fields=fields):
            return fields
        case Service(request=request, response=response):
            return (*response, *request)  # of one name, that of what is sent
        case Action(goal=goal, result=result, feedback=feedback):
            return (*feedback, *result, *goal)
    return ()


class _Units:
    """Units of one machine: its variables and params, and the fields of messages.

    `sent` and `taken` are the types of events and of functions by name.
    """

    def __init__(
        self,
        machine: StateMachine,
        fields: Mapping[tuple[Named, str], Type],
        sent: Mapping[str, Type | None],
        taken: Mapping[str, Type | None],
    ) -> None:
        self._sent = sent
        self._taken = taken
        self._types = {each.name: each.type for each in machine.variables}
        self._types.update({each.name: each.type for each in machine.params})
        self._fields = fields

    def node(self, node: T) -> T:
        """Return a node of the IR with units in its expressions."""
        if isinstance(node, tuple):
            return cast("T", tuple(map(self.node, node)))
        if isinstance(node, (Primitive, Named, Array, Span)) or "__parts__" not in vars(type(node)):
            return node
        if isinstance(node, _EXPRESSIONS):
            return cast("T", self.expression(node)[0])
        if isinstance(node, Assignment):
            type_ = self._at(node.variable, node.path)
            return cast("T", replace(node, value=self.stored(node.value, type_)))
        if isinstance(node, Variable) and node.initial is not None:
            return cast("T", replace(node, initial=self.stored(node.initial, node.type)))
        if isinstance(node, Param) and node.default is not None:
            return cast("T", replace(node, default=self.stored(node.default, node.type)))
        parts = {name: getattr(node, name) for name in fields_of(type(node))}
        changed = {}
        if isinstance(node, Send):
            changed["arguments"] = self._given(parts.pop("arguments"), self._sent.get(node.event))
        elif isinstance(node, Activity):
            type_ = self._taken.get(node.function)
            changed["arguments"] = self._given(parts.pop("arguments"), type_)
        changed.update((name, self.node(part)) for name, part in parts.items())
        return cast("T", replace(cast("Any", node), **changed))

    def _given(
        self, arguments: tuple[tuple[str, Expression], ...], of: Type | None
    ) -> tuple[tuple[str, Expression], ...]:
        """Return values of fields in their units; a field without one takes a number of any."""
        types = (
            {name: self._fields.get((of, name)) for name, _ in arguments}
            if isinstance(of, Named)
            else {}
        )
        measured = {name: each for name, each in types.items() if unit_of(each) is not None}
        return tuple((name, self.stored(value, measured.get(name))) for name, value in arguments)

    def stored(self, value: Expression, type_: Type | None) -> Expression:
        """Return a value in the unit of the place where it is stored."""
        made, unit = self.expression(value)
        return _converted(made, unit, unit_of(type_) if type_ is not None else ANY)

    def expression(self, tree: Expression) -> tuple[Expression, Unit | None]:
        """Return an expression with units, and the unit of its value."""
        match tree:
            case VariableRef(name=name) | ParamRef(name=name):
                return tree, unit_of(self._types.get(name, tree.type))
            case FieldAccess(base=base, field=field):
                return tree, unit_of(self._in(base, field) or tree.type) or ANY
            case Unary(operator=operator, operand=operand):
                made, unit = self.expression(operand)
                return replace(tree, operand=made), unit if operator == "-" else None
            case Binary(operator=word, left=left, right=right):
                (first, second), unit = self._operation(word, (left, right))
                return replace(tree, left=first, right=second), unit
            case Query(array=array, condition=condition, key=key):
                found = replace(
                    tree,
                    array=self.expression(array)[0],
                    condition=self.expression(condition)[0] if condition is not None else None,
                    key=self.expression(key)[0] if key is not None else None,
                )
                return found, unit_of(tree.type) if tree.type is not None else None
            case Construction(type=of, values=values):
                given = (
                    (name, self.stored(value, self._fields.get((of, name))))
                    for name, value in values
                )
                return replace(tree, values=tuple(given)), None
            case Call(function="append" | "replace" | "contains" as word, arguments=(array, *rest)):
                changed = self.expression(array)[0]
                element = array.type.element if isinstance(array.type, Array) else None
                at = 0 if word != "replace" else 1
                stored = (
                    self.stored(each, element) if number == at else self.expression(each)[0]
                    for number, each in enumerate(rest)
                )
                unit = unit_of(tree.type) if tree.type is not None else None
                return replace(tree, arguments=(changed, *stored)), unit
            case Call(function="item" | "remove", arguments=arguments):
                items = tuple(self.expression(each)[0] for each in arguments)
                unit = unit_of(tree.type) if tree.type is not None else None
                return replace(tree, arguments=items), unit
            case Call(function="distance", arguments=coordinates):
                return tree, self.expression(coordinates[0])[1]
            case Call(function=word, arguments=arguments):
                made_, unit = self._operation(word, arguments)
                return replace(tree, arguments=made_), unit
        return tree, unit_of(getattr(tree, "type", None))

    def _operation(
        self, word: str, operands: tuple[Expression, ...]
    ) -> tuple[tuple[Expression, ...], Unit | None]:
        pairs = [self.expression(each) for each in operands]
        expected = taken_unit(word)
        if expected is None and must_be_alike(word):
            known = (unit for _, unit in pairs if unit is not None and unit.dimension != PLAIN)
            expected = next(known, None)
        alike = expected is not None
        if word == "sqrt" and not has_root(pairs[0][1]):
            alike = True
        if alike:
            pairs = [
                (_converted(made, unit, expected), expected) if _is_number(made) else (made, unit)
                for made, unit in pairs
            ]
        units = [with_unit(FLOAT, unit) for _, unit in pairs]
        return tuple(made for made, _ in pairs), result_unit(word, units)

    def _at(self, variable: str, path: tuple[str, ...]) -> Type | None:
        """Return the type of a variable, or of a field below it; None if it may have any unit."""
        type_ = self._types.get(variable)
        for name in path:
            type_ = self._fields.get((type_, name)) if isinstance(type_, Named) else None
        return type_ if not path or unit_of(type_) is not None else None

    def _in(self, base: Expression, field: str) -> Type | None:
        of = self._types.get(base.name) if isinstance(base, VariableRef) else base.type
        return self._fields.get((of, field)) if isinstance(of, Named) else None


def _is_number(tree: Expression) -> bool:
    type_ = getattr(tree, "type", None)
    return type_ is None or unit_of(with_unit(type_, ANY)) is not None


def _converted(tree: Expression, found: Unit | None, expected: Unit | None) -> Expression:
    """Return a number in another unit, which its literal has if there is one."""
    if isinstance(tree, Binary) and _is_seconds(tree, expected):
        return replace(tree, type=NUMBER_OF_SECONDS, conversion="implied")
    if not _is_number(tree):
        return tree
    if isinstance(tree, Literal):
        fits = found is not None or expected is None or expected.is_any
        return tree if fits else replace(tree, type=with_unit(tree.type, expected))
    if isinstance(tree, Unary) and isinstance(tree.operand, Literal):
        return replace(tree, operand=_converted(tree.operand, found, expected))
    if units_fit(found, expected) or expected is PERCENT:
        return tree
    if isinstance(tree, Call) and tree.function in ("int", "round", "floor", "ceil"):
        # An integer divided by a unit is none.
        inner = _converted(tree.arguments[0], found, expected)
        return replace(tree, arguments=(inner,))
    if isinstance(tree, Binary) and tree.operator in ("*", "/"):
        factor = _quotient(expected, found) if tree.operator == "*" else _quotient(found, expected)
        if isinstance(tree.right, Literal) and factor is not None:
            literal = replace(tree.right, type=with_unit(tree.right.type, factor))
            if unit_of(tree.right.type) is None:
                return replace(tree, right=literal)
    made = tree
    if found is not None:
        made = Binary("/", made, _one(found), FLOAT)
    if expected is not None:
        made = Binary("*", made, _one(expected), FLOAT)
    return made


def _is_seconds(division: Binary, expected: Unit | None) -> bool:
    """Return True for a duration divided by a second where a number in seconds is expected."""
    return (
        expected is not None
        and expected.dimension == UNITS["s"].dimension
        and division.operator == "/"
        and getattr(division.left, "type", None) == DURATION
        and division.right == Literal(SECOND, DURATION)
    )


def _quotient(one: Unit | None, other: Unit | None) -> Unit | None:
    """Return the unit with a name by which one unit is divided by another."""
    unit = result_unit("/", [with_unit(FLOAT, one), with_unit(FLOAT, other)])
    return unit if unit is not None and unit.name in UNITS else None


def _one(unit: Unit) -> Literal:
    return Literal(1, with_unit(INT, unit_of_ros(unit.dimension)))
