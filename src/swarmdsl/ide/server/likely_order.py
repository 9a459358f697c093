"""Order of names and keywords: those that the text around the cursor lacks come first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from swarmdsl.ide.server.candidates import containers
from swarmdsl.ide.server.completion_entry import BEST, KEYWORD, UNLIKELY
from swarmdsl.syntax.ast import (
    Activity,
    Container,
    EventTrigger,
    FinalState,
    Initial,
    Node,
    Parallel,
    Ref,
    State,
    StateMachine,
    TopLevel,
    Transition,
    name_of,
    references,
)

# Keywords that begin a declaration or an item, the usual ones first.
_USUAL = (
    *("package", "import", "initial", "on", "do", "state", "after", "final", "entry", "behavior"),
    *("param", "var", "event", "function", "statemachine", "swarm", "member", "in", "out"),
    *("connect", "action", "service", "environment", "and", "or"),
)


def by_use(
    nodes: Iterable[Node], holder: Node, ref: Ref[Node], owner: TopLevel, around: TopLevel, at: int
) -> list[Node]:
    """Return the candidates of a reference, those that nothing names yet first.

    Of events to send, those between robots come first.
    """
    found = list(nodes)
    machine = around if isinstance(around, StateMachine) else None
    if isinstance(holder, EventTrigger) and machine is not None:
        inside = containers(machine, at)[-1]
        used = Counter(
            trigger.event.name
            for item in inside.items
            if isinstance(item, Transition) and item.guard is None and not _is_at(item, at)
            for trigger in item.triggers
            if isinstance(trigger, EventTrigger)
        )
    elif ref.kind == "Event":
        return sorted(found, key=lambda node: not getattr(node, "swarm", False))
    else:
        used = Counter(each.name for _, each in references(owner) if each.kind == ref.kind)
    inner = containers(machine, at)[-1] if machine is not None else None
    own = getattr(inner, "name", None) if isinstance(inner, (State, Parallel)) else None

    def order(node: Node) -> tuple[bool, bool]:
        name = str(name_of(node))
        return ref.kind == "Vertex" and name == own, used[name] > 0

    return sorted(found, key=order)


def keyword_rank(word: str, owner: TopLevel | None, at: int, unhandled: Sequence[str]) -> int:
    """Return the rank of a keyword."""
    if word in unhandled and word != "preempted":
        return BEST
    machine = owner if isinstance(owner, StateMachine) else None
    around = containers(machine, at) if machine is not None else []
    inner = around[-1] if around else None
    if word == "done" and inner is not None:
        return BEST if _can_be_done(inner) else UNLIKELY
    if inner is not None and _is_given(word, inner):
        return UNLIKELY
    return KEYWORD


def usual(word: str) -> int:
    """Return the place of a keyword among those that begin a statement."""
    return _USUAL.index(word) if word in _USUAL else len(_USUAL)


def _can_be_done(inner: Container) -> bool:
    if isinstance(inner, State):
        return inner.machine is not None or any(isinstance(x, FinalState) for x in inner.items)
    return isinstance(inner, Parallel)


def _is_given(word: str, inner: Container) -> bool:
    """Return True if an item is there once at most, and is there."""
    if word == "initial":
        simple = isinstance(inner, State) and not any(
            isinstance(each, State) for each in inner.items
        )
        return simple or any(isinstance(each, Initial) for each in inner.items)
    return word == "do" and any(isinstance(each, Activity) for each in inner.items)


def _is_at(node: Node, offset: int) -> bool:
    _, start, end = node.span.absolute
    return start <= offset <= end
