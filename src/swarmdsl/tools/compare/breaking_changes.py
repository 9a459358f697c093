"""Which differences break what others build on a model: robots in the field, code, other models."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.tools.compare.behaviour import TRANSITION, VERTEX
from swarmdsl.tools.compare.changes import Action, Change, called
from swarmdsl.tools.compare.elements import Element, Ref
from swarmdsl.tools.compare.matching import Matching, text

_INTERFACES = ("message", "service", "action")
_FIELDS = frozenset(
    ("field", *(f"{part} field" for part in ("request", "response", "goal", "result", "feedback")))
)
_GONE = (Action.REMOVED, Action.RENAMED)
# By the kind of what is different: the rule where it is gone, and those for what is said of it.
_GONE_RULES = {
    **dict.fromkeys(_INTERFACES, "INTERFACE_REMOVED"),
    **dict.fromkeys(_FIELDS, "FIELD_REMOVED"),
    "constant": "CONSTANT_REMOVED",
    "event": "EVENT_REMOVED",
    "function": "FUNCTION_REMOVED",
    "in port": "FUNCTION_PORT",
    "out port": "FUNCTION_PORT",
    "param": "PARAM_REMOVED",
    "port": "PORT_REMOVED",
    "role": "ROLE_REMOVED",
    **dict.fromkeys(("component", "member", "statemachine", "swarm"), "DECLARATION_REMOVED"),
}
_SAID_RULES = {
    **{(kind, "kind"): "INTERFACE_REMOVED" for kind in _INTERFACES},
    **{(kind, "type"): "FIELD_TYPE" for kind in _FIELDS},
    ("constant", "value"): "CONSTANT_VALUE",
    ("constant", "type"): "CONSTANT_VALUE",
    ("event", "type"): "EVENT_TYPE",
    ("event", "topic"): "EVENT_TOPIC",
    ("event", "reach"): "EVENT_REACH",
    ("function", "type"): "FUNCTION_TYPE",
    ("function", "paradigm"): "FUNCTION_TYPE",
    ("function", "server"): "FUNCTION_SERVER",
    ("in port", "type"): "FUNCTION_PORT",
    ("out port", "type"): "FUNCTION_PORT",
    ("param", "type"): "PARAM_TYPE",
    ("port", "type"): "PORT_TYPE",
    ("port", "direction"): "PORT_DIRECTION",
    ("port", "topic"): "PORT_TOPIC",
    ("role", "member"): "ROLE_MEMBER",
}


@dataclass(frozen=True)
class Breach:
    """Something that others build on and that is not as it was."""

    rule: str
    message: str
    change: Change | None
    origin: Span | None


def breaches(changes: Iterable[Change], matching: Matching) -> Iterator[Breach]:
    """What of the changes breaks something, and what state machines no longer do."""
    for change in changes:
        rule = _rule(change)
        if rule is not None:
            subject = change.subject or f"{change.kind} `{called(change.element)}`"
            within = "" if change.element is change.top else f"{_title(change.top)}: "
            message = f"{within}{subject} {_words(change)}"
            yield Breach(rule, message, change, change.element.origin)
    for old, new in matching.pairs.items():
        if old.kind == "statemachine":
            yield from _of_machine(old, new, matching)


def _words(change: Change) -> str:
    return "is gone" if change.action is Action.REMOVED else change.said


def _title(top: Element) -> str:
    return f"{top.kind} `{called(top)}`"


def _rule(change: Change) -> str | None:
    """The rule that a change breaks, if it does."""
    kind, element = change.kind, change.element
    values = dict(change.top.values)
    if change.top.kind in _INTERFACES and "described" in values:
        # It is defined elsewhere: the model only tells what it is like there.
        return None
    if change.action in _GONE:
        if kind == VERTEX and change.owner is change.top and _is_final(change.old):
            return "OUTCOME_LOST"
        return _GONE_RULES.get(kind)
    if change.action is Action.ADDED and element is not change.top:
        if kind == "param" and "default" not in dict(element.values):
            return "PARAM_REQUIRED"
        return "FIELD_ADDED" if kind in _FIELDS else None
    if change.action is Action.REORDERED:
        return "FIELD_ORDER" if change.word.removesuffix("s") in _FIELDS else None
    if change.action is not Action.CHANGED:
        return None
    if (kind, change.word) == ("param", "default"):
        return "PARAM_REQUIRED" if not change.after else None
    if (kind, change.word) == ("role", "number"):
        return "ROLE_NUMBER" if _narrower(change.before, change.after) else None
    if (kind, change.word) == ("component", "operations"):
        lost = set(change.before.split(", ")) - set(change.after.split(", "))
        return "OPERATION_REMOVED" if lost else None
    return _SAID_RULES.get((kind, change.word))


def _is_final(state: Element | None) -> bool:
    return state is not None and text(dict(state.values)["kind"]) == "final state"


def _narrower(before: str, after: str) -> bool:
    """Whether a number that was allowed is not any more."""
    (low, high), (least, most) = _bounds(before), _bounds(after)
    return least > low or most < high


def _bounds(multiplicity: str) -> tuple[float, float]:
    lower, dots, upper = multiplicity.partition("..")
    if multiplicity == "*":
        return 0, float("inf")
    most = upper if dots else lower
    return int(lower), float("inf") if most == "*" else int(most)


def _of_machine(old: Element, new: Element, matching: Matching) -> Iterator[Breach]:
    uses: tuple[tuple[str, str, Callable[[Element], set[Ref]]], ...] = (
        ("EVENT_UNHANDLED", "handles", _handled),
        ("EVENT_UNSENT", "sends", _sent),
    )
    for rule, verb, used in uses:
        before = {matching.names.get(ref, ref): ref for ref in used(old)}
        for event in sorted(before.keys() - used(new), key=lambda ref: ref.name):
            message = f"statemachine `{called(new)}` {verb} `{event.name}` no more"
            yield Breach(rule, message, None, new.origin)


def _handled(machine: Element) -> set[Ref]:
    return {
        piece
        for each in machine.walk()
        if each.kind == TRANSITION
        for piece in each.name
        if isinstance(piece, Ref) and piece.kind == "event"
    }


def _sent(machine: Element) -> set[Ref]:
    return {
        piece
        for each in machine.walk()
        for word, value in each.values
        if word in ("effect", "entry effect", "exit effect")
        for piece in value
        if isinstance(piece, Ref) and piece.kind == "event"
    }
