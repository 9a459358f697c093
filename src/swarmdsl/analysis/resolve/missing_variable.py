"""Hint for a missing variable: its declaration, with the type that its use requires.

The type is certain only if the name is a whole expression or compared with a value; several
types fit an operand of arithmetic.
"""

from __future__ import annotations

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    Assignment,
    Branch,
    Call,
    Communication,
    Element,
    EnumType,
    Expression,
    ExpressionTree,
    Field,
    Fitness,
    Function,
    NameUse,
    Operation,
    OperatorUse,
    Param,
    Parameter,
    Send,
    ServiceType,
    StateMachine,
    TimeTrigger,
    TopLevel,
    Transition,
    Value,
    Variable,
    nodes_of,
)
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    FLOATS,
    INTEGERS,
    STRING,
    Array,
    Named,
    Primitive,
    Type,
)

_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_LOGIC = ("and", "or", "not")


def suggest_variable(
    use: NameUse, within: Expression, owner: TopLevel, scope: FileScope
) -> str | None:
    """Return a hint that declares a name in an expression."""
    if not isinstance(owner, (StateMachine, Fitness)):
        return None
    of = next((v.type.type for v in nodes_of(owner, Variable) if v.initial is within), None)
    of = of or next((p.type.type for p in nodes_of(owner, Param) if p.default is within), None)
    if of is not None:
        # An initial value is a constant.
        type_ = _written(of, scope) if within.tree is use else None
        line = f"const {use.name} : {type_} = ..."
        if type_ is None:
            return None
        text = f"declare it above `{owner.name}`: `{line}`"
        return Advice(text, "declare constant", owner.name, line)
    if isinstance(owner, Fitness):
        return _declaration(owner, f"in {use.name} : float64")
    around = _around(within, use)
    if around is None:
        expected = _expected_type(within, owner, scope.interfaces)
    elif isinstance(around, OperatorUse) and around.operator in _LOGIC:
        expected = BOOL
    elif isinstance(around, OperatorUse) and around.operator in _COMPARISONS:
        (beside,) = (operand for operand in around.operands if operand is not use)
        expected = type_of(beside)
    else:
        expected = None
    written = _written(expected, scope) if expected is not None else None
    if expected is None or written is None:
        return f"declare it in `{owner.name}` with its type: `var {use.name} : ...`"
    return _declaration(owner, f"var {use.name} : {written}{_initial(expected)}")


def _declaration(owner: StateMachine | Fitness, line: str) -> Advice:
    return Advice(f"declare it in `{owner.name}`: `{line}`", "declare value", owner.name, line)


def _initial(type_: Type) -> str:
    """Return the initializer of a variable: the zero of its type, if there is one."""
    if isinstance(type_, Primitive) and type_.name in FLOATS:
        return " = 0.0"
    if isinstance(type_, Primitive) and type_.name in (*INTEGERS, "byte", "char"):
        return " = 0"
    if type_ == BOOL:
        return " = false"
    return ' = ""' if type_ == STRING else ""


def _written(type_: Type, scope: FileScope) -> str | None:
    """Return the name of a type in a file; None if the type is not visible there."""
    if isinstance(type_, Array):
        element = _written(type_.element, scope)
        return element and f"{element}{str(type_).removeprefix(str(type_.element))}"
    declared = scope.interfaces.declared.get(type_) if isinstance(type_, Named) else None
    if isinstance(type_, Primitive) or declared is None or "/" in declared.name:
        return str(type_)
    names = (type_.name, *(f"{package}.{type_.name}" for package in sorted(scope.packages)))
    return next((n for n in names if [node for _, node in scope.find(n)] == [declared]), None)


def _around(within: Expression, use: NameUse) -> OperatorUse | Call | None:
    """Return the operation with a name as operand; None for a name alone."""
    waiting = [within.tree]
    while waiting:
        match waiting.pop():
            case OperatorUse(operands=inside) | Call(arguments=inside) as node:
                if any(each is use for each in inside):
                    return node
                waiting.extend(inside)
    return None


def _expected_type(
    within: Expression, machine: StateMachine, interfaces: Interfaces
) -> Type | None:
    """Return the type that the context of an expression requires."""
    guarded: tuple[Transition | Branch, ...] = (
        *nodes_of(machine, Transition),
        *nodes_of(machine, Branch),
    )
    if any(node.guard is within for node in guarded):
        return BOOL
    waiting: tuple[TimeTrigger | Send, ...] = (
        *nodes_of(machine, TimeTrigger),
        *nodes_of(machine, Send),
    )
    if any(node.delay is within for node in waiting):
        return DURATION
    for assignment in nodes_of(machine, Assignment):
        if assignment.target is within:
            return type_of(assignment.value.tree)
        if assignment.value is within:
            return type_of(assignment.target.tree)
    for activity in nodes_of(machine, Activity):
        for argument in activity.arguments:
            if argument.value is within:
                return _fields(activity, interfaces)[0].get(str(argument.name))
        for result in activity.results:
            if result.target is within:
                return _fields(activity, interfaces)[1].get(str(result.field))
    return None


def type_of(tree: ExpressionTree | None) -> Type | None:
    """Return the type of a literal or a declared name; None for a number, which fits several."""
    match tree:
        case Value(unit=unit) if unit:
            return DURATION
        case Value(value=bool()):
            return BOOL
        case Value(value=str()):
            return STRING
        case NameUse(target=target) if target is not None and not isinstance(
            target, (EnumType, Element)
        ):
            return target.type.type
    return None


def _fields(activity: Activity, interfaces: Interfaces) -> tuple[dict[str, Type | None], ...]:
    """Return the types of the inputs and the results of an activity, by name."""
    taken: list[Field] | list[Parameter] = []
    given: list[Field] | list[Parameter] = []
    match activity.function.target:
        case Operation(parameters=parameters):
            taken = [each for each in parameters if each.direction != "out"]
            given = [each for each in parameters if each.direction == "out"]
        case Function(items=items):
            match next(
                (_interface(each, interfaces) for each in items if isinstance(each, Communication)),
                None,
            ):
                case ActionType(goal=goal, result=result):
                    taken, given = goal, result
                case ServiceType(request=request, response=response):
                    taken, given = request, response
    return tuple({str(f.name): f.type.type for f in fields} for fields in (taken, given))


def _interface(call: Communication, interfaces: Interfaces) -> object:
    kind = ActionType if call.paradigm == "action" else ServiceType
    type_ = call.type.type
    return interfaces.get(type_, kind) if isinstance(type_, Named) else None
