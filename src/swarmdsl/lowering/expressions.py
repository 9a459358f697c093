"""Lower expressions, with their types filled in."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.analysis.types import QUERIES
from swarmdsl.analysis.types.unit_rules import (
    NUMBER_OF_SECONDS,
    has_dimension,
    literal_type,
    takes_seconds,
)
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.ir.expressions import Conversion
from swarmdsl.ir.operations import SECOND
from swarmdsl.lowering.context import Context
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Append,
    Argument,
    Assignment,
    Call,
    Constant,
    Construction,
    Elapsed,
    Element,
    EnumType,
    Expression,
    ExpressionTree,
    Field,
    FieldUse,
    FitnessInput,
    IndexUse,
    InState,
    NameUse,
    OperatorUse,
    Param,
    Parameter,
    PartValue,
    Query,
    Remove,
    RoleUse,
    Store,
    Value,
    Variable,
)
from swarmdsl.syntax.parser.literals import nanoseconds
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    ENVELOPE_FIELDS,
    FLOAT,
    INT,
    INTEGERS,
    SELF_FIELDS,
    STRING,
    unit_of,
    with_unit,
)
from swarmdsl.syntax.units import DURATIONS, UNITS, in_unit_of_ros

_TYPES = {bool: BOOL, int: INT, float: FLOAT, str: STRING}


_CARRIERS = {
    "sender": (ir.Named("swarmros", "EventHeader"), "node"),
    "sent": (ir.Named("std_msgs", "Header"), "stamp"),
}
"""Types of headers that carry facts about an event, and their fields."""


def lower_optional(
    expression: Expression | None, context: Context, expected: ir.Type | None = None
) -> ir.Expression | None:
    """Lower an expression, or return None if there is none."""
    return None if expression is None else lower_expression(expression, context, expected)


def lower_expression(
    expression: Expression, context: Context, expected: ir.Type | None = None
) -> ir.Expression:
    """Lower an expression that was parsed and checked.

    A duration becomes a number in seconds where a value of type `expected` has a unit.
    """
    assert expression.tree is not None
    return _lower_as(expression.tree, context, expected)


def lower_fields(
    given: Iterable[Argument | PartValue],
    fields: Iterable[Field | Parameter | Param] | None,
    context: Context,
) -> tuple[tuple[str, ir.Expression], ...]:
    """Lower the values of fields or params, which have types where they are known."""
    types = {str(field.name): field.type.type for field in fields or ()}
    return tuple(
        (str(each.name), lower_expression(each.value, context, types.get(str(each.name))))
        for each in given
    )


def _lower_as(tree: ExpressionTree, context: Context, expected: ir.Type | None) -> ir.Expression:
    found = lower_tree(tree, context)
    if not has_dimension(unit_of(expected)):
        return found
    whole = isinstance(expected, ir.Primitive) and expected.name in INTEGERS
    if whole and found.type == DURATION:
        value = context.typing.folding.value(tree)
        assert isinstance(value, int)
        type_ = with_unit(INT, unit_of(NUMBER_OF_SECONDS))
        return ir.Literal(value // SECOND, type_, found.origin)
    return _seconds(found)


def lower_path(expression: Expression, context: Context) -> tuple[str, tuple[str, ...]]:
    """Return the assigned variable and the fields below it."""
    assert expression.tree is not None
    return _path(expression.tree, context)


def _path(tree: ExpressionTree, context: Context) -> tuple[str, tuple[str, ...]]:
    path: list[str] = []
    while isinstance(tree, FieldUse):
        path.insert(0, str(tree.name))
        tree = tree.base
    assert isinstance(tree, NameUse)
    assert isinstance(tree.target, Variable)
    return context.variables.get(tree.target, tree.name), tuple(path)


def lower_tree(tree: ExpressionTree, context: Context) -> ir.Expression:
    """Lower an expression; params may have values here, so types are computed anew."""
    match tree:
        case Value():
            return _literal(tree)
        case NameUse(target=Param() as param) if param in context.values:
            return context.values[param]
        case NameUse(target=Constant() as constant):
            return _constant(constant, tree.span, context)
        case NameUse():
            return _name(tree, context)
        case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
            number = context.typing.folding.numbers(enum)[str(name)]
            return ir.Literal(number, INT, tree.span, name=f"{context.declared(enum)}.{name}")
        case FieldUse(base=NameUse(name="self"), name=name):
            return ir.SelfField(str(name), SELF_FIELDS[name], tree.span)
        case FieldUse(base=NameUse(name="event") as event, name=name) if context.typing.is_envelope(
            name
        ):
            header = None
            if context.typing.has_event:
                message = ir.EventData(_type_of(event, context), event.span)
                header = _header(message, str(name), tree.span, context)
            return ir.EnvelopeField(str(name), ENVELOPE_FIELDS[name], header, tree.span)
        case FieldUse(base=base, name=name):
            return _field(lower_tree(base, context), str(name), tree.span, context)
        case Call(function="distance", arguments=points):
            return _distance(tree, [lower_tree(point, context) for point in points], context)
        case RoleUse(name=name):
            return ir.Literal(name, STRING, tree.span)
        case Call(function="seconds", arguments=(argument,)):
            return _seconds(lower_tree(argument, context), tree.span)
        case Call(function=function, arguments=(distance,)) if function == NEIGHBORS:
            reach = lower_tree(distance, context)
            return ir.Call("neighbors", (reach,), _result(tree, (reach,), context), tree.span)
        case Call(function=function, arguments=arguments):
            values = _operands(str(function), arguments, context)
            return ir.Call(str(function), values, _result(tree, values, context), tree.span)
        case IndexUse(base=base, index=index):
            array = lower_tree(base, context)
            type_ = _item_type(array)
            return ir.Call("item", (array, lower_tree(index, context)), type_, tree.span)
        case Query():
            return _query(tree, context)
        case InState(state=state):
            assert state.target is not None
            return ir.InState(context.states[state.target], origin=tree.span)
        case Elapsed(owner=owner):
            return ir.Elapsed(context.states[owner], origin=tree.span)
        case Construction(type=of, values=given):
            made = context.type_of(of)
            assert isinstance(made, ir.Named)
            known = context.typing.interfaces.fields(made) or ()
            types = {str(each.name): each.type.type for each in known}
            fields = tuple(
                (str(each.name), _lower_as(each.value, context, types.get(str(each.name))))
                for each in given
            )
            return ir.Construction(made, fields, tree.span)
        case OperatorUse(operator=operator, operands=operands):
            values = _operands(str(operator), operands, context)
            type_ = _result(tree, values, context)
            if len(values) == 1:
                return _unary(str(operator), values[0], type_, tree.span)
            return ir.Binary(str(operator), values[0], values[1], type_, tree.span)
    raise AssertionError(tree)


def _item_type(array: ir.Expression) -> ir.Type | None:
    return array.type.element if isinstance(array.type, ir.Array) else None


def _query(query: Query, context: Context) -> ir.Query:
    array = lower_tree(query.element.array, context)
    found = QUERIES[str(query.function)].result
    return ir.Query(
        str(query.function),
        str(query.element.name),
        array,
        lower_tree(query.condition, context) if query.condition is not None else None,
        lower_tree(query.key, context) if query.key is not None else None,
        found if found is not None else _item_type(array),
        query.span,
    )


def lower_store(effect: Store, context: Context) -> ir.Assignment:
    """Lower an effect that changes a variable; one on an array assigns the changed array."""
    tree = effect.target.tree
    assert tree is not None
    stored = tree.base if isinstance(tree, IndexUse) else tree
    variable, path = _path(stored, context)
    array = lower_tree(stored, context)
    value: ir.Expression
    match effect, tree:
        case Assignment(value=given), IndexUse(index=index):
            item = lower_expression(given, context, _item_type(array))
            parts = (array, lower_tree(index, context), item)
            value = ir.Call("replace", parts, array.type, effect.span)
        case Assignment(value=given), _:
            value = lower_expression(given, context, context.typing.infer(tree))
        case Append(value=given), _:
            assert isinstance(array.type, ir.Array)
            assert array.type.size is not None
            item = lower_expression(given, context, array.type.element)
            parts = (array, item, ir.Literal(array.type.size, INT))
            value = ir.Call("append", parts, array.type, effect.span)
        case Remove(), IndexUse(index=index):
            value = ir.Call("remove", (array, lower_tree(index, context)), array.type, effect.span)
        case _:
            value = ir.Call("empty", (), array.type, effect.span)
    return ir.Assignment(variable, path, value, effect.span)


def _operands(
    word: str, operands: tuple[ExpressionTree, ...], context: Context
) -> tuple[ir.Expression, ...]:
    """Lower operands, durations to numbers where the operation takes them so."""
    values = tuple(lower_tree(operand, context) for operand in operands)
    return tuple(map(_seconds, values)) if takes_seconds(word, [v.type for v in values]) else values


def _seconds(value: ir.Expression, at: Span | None = None) -> ir.Expression:
    """Return a duration as a number in seconds; other values as they are."""
    if value.type != DURATION:
        return value
    origin = at or value.origin
    if isinstance(value, ir.Literal) and isinstance(value.value, int) and not value.name:
        return ir.Literal(value.value / SECOND, NUMBER_OF_SECONDS, origin)
    second = ir.Literal(SECOND, DURATION, origin)
    how: Conversion = "implied" if at is None else "seconds"
    return ir.Binary("/", value, second, NUMBER_OF_SECONDS, origin, how)


def _distance(tree: Call, points: list[ir.Expression], context: Context) -> ir.Call:
    """Return the distance of two positions as a function of their coordinates.

    A message that is not described has the coordinates of the other one.
    """
    found = [context.typing.position(point.type) for point in points]
    known = [place.coordinates for place in found if place is not None and place.coordinates]
    coordinates = known[0] if known else ("x", "y", "z")
    values = []
    for message, place in zip(points, found, strict=True):
        point = message
        for name in place.path if place is not None else ():
            point = _field(point, name, tree.span, context)
        values += [_field(point, name, tree.span, context) for name in coordinates]
    return ir.Call("distance", tuple(values), _result(tree, tuple(points), context), tree.span)


def _field(owner: ir.Expression, name: str, at: Span, context: Context) -> ir.FieldAccess:
    type_ = context.typing.field(owner.type, name, at)
    return ir.FieldAccess(owner, name, context.plain(type_) if type_ is not None else None, at)


def _header(message: ir.EventData, fact: str, at: Span, context: Context) -> ir.FieldAccess | None:
    """Return the field of a message in which robots carry a fact about the event."""
    type_, name = _CARRIERS[fact]
    of = message.type
    known = context.typing.interfaces.fields(of) if isinstance(of, ir.Named) else None
    for field in known or ():
        if field.type.type == type_:
            return _field(_field(message, str(field.name), at, context), name, at, context)
    return None


def _constant(constant: Constant, at: Span, context: Context) -> ir.Literal:
    """Return the value of a constant as a literal, not its expression."""
    value = context.typing.folding.constant(constant)
    assert value is not None
    name = context.declared(constant)
    if constant.type.type == DURATION:
        assert not isinstance(value, str)
        return ir.Literal(round(value), DURATION, at, name=name)
    type_ = with_unit(_TYPES[type(value)], unit_of(constant.type.type))
    return ir.Literal(value, type_, at, name=name)


def _type_of(use: NameUse, context: Context) -> ir.Type:
    type_ = context.typing.infer(use)
    assert type_ is not None
    return context.plain(type_)


def _name(use: NameUse, context: Context) -> ir.Expression:
    type_ = _type_of(use, context)
    match use.target:
        case Param():
            return ir.ParamRef(use.name, type_, use.span)
        case Variable() as variable:
            return ir.VariableRef(context.variables.get(variable, use.name), type_, use.span)
        case FitnessInput() | Field():
            return ir.VariableRef(use.name, type_, use.span)
        case Element():
            return ir.ItemRef(use.name, type_, use.span)
    assert use.name == "event"
    return ir.EventData(type_, use.span)


def _result(
    tree: Call | OperatorUse, operands: tuple[ir.Expression, ...], context: Context
) -> ir.Type | None:
    return context.typing.result(tree, [operand.type for operand in operands])


def _unary(operator: str, operand: ir.Expression, type_: ir.Type | None, at: Span) -> ir.Expression:
    """Lower a prefix operator; a sign before a number gives a literal."""
    if operator == "-" and isinstance(operand, ir.Literal) and not isinstance(operand.value, str):
        return replace(operand, value=-operand.value, origin=at, name="")
    return ir.Unary(operator, operand, type_, at)


def _literal(value: Value) -> ir.Literal:
    match value.value:
        case bool():
            return ir.Literal(value.value, BOOL, value.span)
        case int() | float() if value.unit in DURATIONS:
            return ir.Literal(nanoseconds(value.span.text, value.unit), DURATION, value.span)
        case int() | float() if value.unit:
            digits = value.span.text.removesuffix(value.unit).rstrip()
            number = in_unit_of_ros(digits, UNITS[value.unit])
            return ir.Literal(number, literal_type(value.value, value.unit), value.span)
        case int():
            return ir.Literal(value.value, INT, value.span)
        case float():
            return ir.Literal(value.value, FLOAT, value.span)
    return ir.Literal(value.value, STRING, value.span)
