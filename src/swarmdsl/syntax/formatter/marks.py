"""Marks of tokens that only the syntax tree tells."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    ActionType,
    Activity,
    Branch,
    Call,
    Construction,
    Documented,
    Elapsed,
    EnumValue,
    Fact,
    IndexUse,
    InState,
    Measure,
    MessageType,
    Model,
    ModelUse,
    Multiplicity,
    Node,
    Operation,
    OperatorUse,
    Parameter,
    Query,
    RobotValues,
    Send,
    ServiceType,
    SpaceMeasure,
    State,
    Targets,
    Transition,
    TypeRef,
    Value,
    Who,
    walk,
)
from swarmdsl.syntax.formatter.tokens import Tokens, tokenize


@dataclass(frozen=True)
class Marks:
    """Tokens by their offsets: starts of items, and tokens with special spacing.

    There is no space before a `tight` token; lines break before a `clause` first. A separator was
    before a `separated` token, perhaps a comment.
    """

    items: dict[int, Node] = field(default_factory=dict)
    tight: set[int] = field(default_factory=set)
    clauses: set[int] = field(default_factory=set)
    separated: set[int] = field(default_factory=set)


def find_marks(model: Model, tokens: Tokens) -> Marks:
    """Find the marks of a file by its syntax tree."""
    marks = Marks()
    for node in walk(model):
        start = node.span.start
        if isinstance(node, Documented) and not isinstance(node, Parameter):
            marks.items[start] = node
        match node:
            case TypeRef():
                _join(marks, tokens, start, f"{node.name}{node.bound}{node.array}")
                if node.unit is not None:
                    _join(marks, tokens, node.unit.span.start, node.unit)
            case Value(unit=unit) if "/" in unit:
                _join(marks, tokens, node.span.end - len(unit), unit)
            case MessageType() | ServiceType() | ActionType():
                _join(marks, tokens, node.name.span.start, node.name)
            case EnumValue(value=str(value)):
                equals = tokens.code(node.name.span.end)[0]
                _join(marks, tokens, equals.start + 1, value)
            case Multiplicity():
                opener = tokens.before(start)
                upper = f"..{node.upper}" if node.upper else ""
                _join(marks, tokens, opener.start, f"[{node.lower}{upper}]")
                marks.tight.add(opener.start)
            case Targets(count=str(count)) if count:
                opener = tokens.code(node.name.span.end)[0]
                _join(marks, tokens, opener.start, f"[{count}]")
                marks.tight.add(opener.start)
            case ModelUse():
                _mark_list(marks, tokens, node.name.span.start, node.name)
            case RobotValues():
                _join(marks, tokens, start, f"{node.role.name}[{node.index}]")
            case OperatorUse(operands=(_,)) if node.operator == "-":
                marks.tight.add(tokens.code(start, 2)[1].start)
            case Call(function=function) if function == NEIGHBORS:
                pass  # no parenthesis follows
            case Call() | Query() | Operation():
                name = node.name if isinstance(node, Operation) else node.function
                marks.tight.add(tokens.code(name.span.end)[0].start)
            case Elapsed(function=function, state=state):
                marks.tight.add(tokens.code(function.span.end)[0].start)
                if state is not None:
                    _join(marks, tokens, state.span.start, state.name)
            case InState(state=state):
                _mark_list(marks, tokens, start, "in")
                _join(marks, tokens, state.span.start, state.name)
            case Construction():
                marks.tight.add(tokens.code(node.type.span.end)[0].start)
            case Activity():
                _mark_list(marks, tokens, node.function.span.start, node.function.name)
                result = node.results[0].span if node.results else None
                if node.result_callback is not None:
                    result = node.result_callback.span
                if result is not None:
                    opener = tokens.before(result.start)  # `(` or `by`
                    marks.clauses.add(tokens.before(opener.start).start)
            case Send():
                _mark_list(marks, tokens, node.event.span.start, node.event.name)
            case Who(lower=str(lower)) if lower:
                _join(marks, tokens, start, f"{lower}..{node.upper}" if node.upper else lower)
            case Who(index=str(index)) if index:
                _join(marks, tokens, start, f"{node.role.name}[{index}]")
            case Fact(counted=counted) if counted is not None:
                marks.tight.add(tokens.before(counted.span.start).start)
            case IndexUse(base=base):
                marks.tight.add(tokens.code(base.span.end)[0].start)
            case SpaceMeasure():
                _mark_list(marks, tokens, start, node.quantity)
            case Measure(until=""):
                marks.tight.add(tokens.before(node.claim.span.start).start)
            case State(machine=machine) if machine is not None:
                _mark_list(marks, tokens, machine.span.start, machine.name)
            case Transition(effects=[effect, *_]) | Branch(effects=[effect, *_]):
                marks.clauses.add(tokens.before(effect.span.start).start)
    return marks


def _join(marks: Marks, tokens: Tokens, start: int, text: str) -> None:
    """Mark the tokens of a text from an offset on as tight."""
    parts = tokens.code(start, len(tokenize(text)))
    marks.tight.update(part.start for part in parts[1:])


def _mark_list(marks: Marks, tokens: Tokens, start: int, name: str) -> None:
    """Mark the `(` after a name as tight, if there is one."""
    trailing = tokens.code(start, len(tokenize(name)) + 1)[-1]
    if trailing.text == "(":
        marks.tight.add(trailing.start)
