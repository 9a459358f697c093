"""The line that declares a variable that is missing, of the type that its use asks for."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.inference.fitting import is_float, is_number
from swarmdsl.interfaces import Interfaces
from swarmdsl.ir.types import BOOL, DURATION, STRING, Named, Primitive, Type
from swarmdsl.load import Project
from swarmdsl.syntax import (
    ActionType,
    Activity,
    Assignment,
    Branch,
    Communication,
    EnumType,
    Expression,
    ExpressionTree,
    Field,
    Fitness,
    Function,
    NameUse,
    Operation,
    OperatorUse,
    Parameter,
    ServiceType,
    StateMachine,
    TimeTrigger,
    TopLevel,
    Transition,
    Value,
    nodes_of,
)

_UINT, _FLOAT = Primitive("uint32"), Primitive("float64")
_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_LOGIC = ("and", "or", "not")


def way_to_declare(use: NameUse, owner: TopLevel, project: Project) -> str | None:
    """What to write where, so that a name in an expression means something, in words."""
    if isinstance(owner, Fitness):
        return f"declare it in `{owner.name}`: `in {use.name} : {_FLOAT}`"
    if not isinstance(owner, StateMachine):
        return None
    type_ = next((t for t in _asked_for(use, owner, project) if t is not None), None)
    if type_ is None:
        return f"declare it in `{owner.name}`, of the type that it has: `var {use.name} : {_FLOAT}`"
    return f"declare it in `{owner.name}`: `var {use.name} : {type_}{_initial(type_)}`"


def _initial(type_: Type) -> str:
    """What a variable begins with, where the type has a value that stands for nothing."""
    if is_number(type_):
        return " = 0.0" if is_float(type_) else " = 0"
    if type_ == BOOL:
        return " = false"
    return ' = ""' if type_ == STRING else ""


def _asked_for(use: NameUse, machine: StateMachine, project: Project) -> Iterator[Type | None]:
    """What the expressions that a name stands in say of its type."""
    transitions, branches = nodes_of(machine, Transition), nodes_of(machine, Branch)
    for guard in (node.guard for nodes in (transitions, branches) for node in nodes):
        yield _in(guard, use, BOOL)
    for trigger in nodes_of(machine, TimeTrigger):
        yield _in(trigger.delay, use, DURATION)
    for assignment in nodes_of(machine, Assignment):
        target, value = assignment.target.tree, assignment.value.tree
        if target is use and value is not None:
            yield _type_of(value)
        elif target is not None:
            yield _in(assignment.value, use, _type_of(target))
    for activity in nodes_of(machine, Activity):
        taken, given = _fields(activity, project)
        for argument in activity.arguments:
            yield _in(argument.value, use, taken.get(str(argument.name)))
        for result in activity.results:
            yield _in(result.target, use, given.get(str(result.field)))


def _in(expression: Expression | None, use: NameUse, wanted: Type | None) -> Type | None:
    """What an expression, whose value is to be of the wanted type, says of a name in it."""
    tree = expression.tree if expression is not None else None
    return _below(tree, use, wanted) if tree is not None else None


def _below(tree: ExpressionTree, use: NameUse, wanted: Type | None) -> Type | None:
    if tree is use:
        return wanted
    if not isinstance(tree, OperatorUse):
        return None
    for operand in tree.operands:
        others = (_type_of(other) for other in tree.operands if other is not operand)
        beside = next((type_ for type_ in others if type_ is not None), None)
        if tree.operator in _LOGIC:
            inner: Type | None = BOOL
        else:
            inner = beside if tree.operator in _COMPARISONS else beside or wanted
        found = _below(operand, use, inner)
        if found is not None:
            return found
    return None


def _type_of(tree: ExpressionTree) -> Type | None:
    """The type of a value or of a name that is declared; numbers are as they are counted."""
    match tree:
        case Value(unit=unit) if unit:
            return DURATION
        case Value(value=bool()):
            return BOOL
        case Value(value=str()):
            return STRING
        case Value(value=int()):
            return _UINT
        case Value():
            return _FLOAT
        case NameUse(target=target) if target is not None and not isinstance(target, EnumType):
            return target.type.type
        case OperatorUse(operator=operator) if operator in (*_COMPARISONS, *_LOGIC):
            return BOOL
        case OperatorUse(operands=operands):
            return next((type_ for type_ in map(_type_of, operands) if type_ is not None), None)
    return None


def _fields(activity: Activity, project: Project) -> tuple[dict[str, Type | None], ...]:
    """The types of what an activity takes and of what it gives, by name."""
    taken: list[Field] | list[Parameter] = []
    given: list[Field] | list[Parameter] = []
    match activity.function.target:
        case Operation(parameters=parameters):
            taken = [each for each in parameters if each.direction != "out"]
            given = [each for each in parameters if each.direction == "out"]
        case Function(items=items):
            match next(
                (_interface(each, project) for each in items if isinstance(each, Communication)),
                None,
            ):
                case ActionType(goal=goal, result=result):
                    taken, given = goal, result
                case ServiceType(request=request, response=response):
                    taken, given = request, response
    return tuple({str(f.name): f.type.type for f in fields} for fields in (taken, given))


def _interface(call: Communication, project: Project) -> object:
    kind = ActionType if call.paradigm == "action" else ServiceType
    type_ = call.type.type
    interfaces = Interfaces(project.declarations())
    return interfaces.get(type_, kind) if isinstance(type_, Named) else None
