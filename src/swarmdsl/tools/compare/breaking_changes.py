"""Find changes that break robots in the field, code or other models."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.tools.compare.behaviour import TRANSITION_KIND, VERTEX_KIND
from swarmdsl.tools.compare.changes import Action, Change, display_name
from swarmdsl.tools.compare.elements import Element, Ref
from swarmdsl.tools.compare.matching import Matching, value_text

_INTERFACES = ("message", "service", "action")
_FIELDS = frozenset(
    ("field", *(f"{part} field" for part in ("request", "response", "goal", "result", "feedback")))
)
_REMOVALS = (Action.REMOVED, Action.RENAMED)
# Rules for removed elements by kind, and for changed properties by kind and property.
_REMOVAL_RULES = {
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
    "area": "AREA_REMOVED",
    "target": "TARGET_REMOVED",
    **dict.fromkeys(("component", "member", "statemachine", "swarm"), "DECLARATION_REMOVED"),
}
_PROPERTY_RULES = {
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
class BreakingChange:
    """Breaking change; `change` is None if a machine no longer uses an event."""

    rule: str
    message: str
    change: Change | None
    origin: Span | None


def find_breaking_changes(
    changes: Iterable[Change], matching: Matching, lessened: Container[str] = ()
) -> Iterator[BreakingChange]:
    """Yield the breaking changes.

    `lessened` are the events that are delivered with less than before. An event that a state
    machine no longer handles or sends is a breaking change as well.
    """
    for change in changes:
        rule = _rule(change, lessened)
        if rule is not None:
            subject = change.subject or f"{change.kind} `{display_name(change.element)}`"
            within = "" if change.element is change.top else f"{_title(change.top)}: "
            message = f"{within}{subject} {_describe(change)}"
            yield BreakingChange(rule, message, change, change.origin)
    for old, new in matching.pairs.items():
        if old.kind == "statemachine":
            yield from _dropped_events(old, new, matching)


def _describe(change: Change) -> str:
    return "is removed" if change.action is Action.REMOVED else change.description


def _title(top: Element) -> str:
    return f"{top.kind} `{display_name(top)}`"


def _rule(change: Change, lessened: Container[str]) -> str | None:
    """Rule that a change breaks, if any."""
    kind, element = change.kind, change.element
    values = dict(change.top.values)
    if change.top.kind in _INTERFACES and "described" in values:
        # The interface is defined in another package; the model only describes it.
        return None
    if change.action in _REMOVALS:
        if kind == VERTEX_KIND and change.owner is change.top and _is_final(change.old):
            return "OUTCOME_LOST"
        return _REMOVAL_RULES.get(kind)
    if change.action is Action.ADDED and element is not change.top:
        if kind == "param" and "default" not in dict(element.values):
            return "PARAM_REQUIRED"
        return "FIELD_ADDED" if kind in _FIELDS else None
    if change.action is Action.REORDERED:
        return "FIELD_ORDER" if change.property_name.removesuffix("s") in _FIELDS else None
    if change.action is not Action.CHANGED:
        return None
    if (kind, change.property_name) == ("param", "default"):
        return "PARAM_REQUIRED" if not change.after else None
    if (kind, change.property_name) == ("event", "delivery"):
        return "EVENT_DELIVERY" if display_name(element) in lessened else None
    if (kind, change.property_name) == ("event", "operator"):
        return "EVENT_OPERATOR" if not change.after else None
    if (kind, change.property_name) == ("role", "number"):
        return "ROLE_NUMBER" if _is_narrower(change.before, change.after) else None
    if (kind, change.property_name) == ("component", "operations"):
        lost = set(change.before.split(", ")) - set(change.after.split(", "))
        return "OPERATION_REMOVED" if lost else None
    return _PROPERTY_RULES.get((kind, change.property_name))


def _is_final(state: Element | None) -> bool:
    return state is not None and value_text(dict(state.values)["kind"]) == "final state"


def _is_narrower(before: str, after: str) -> bool:
    """Return True if `after` excludes a number that `before` allowed."""
    (low, high), (least, most) = _bounds(before), _bounds(after)
    return least > low or most < high


def _bounds(multiplicity: str) -> tuple[float, float]:
    lower, dots, upper = multiplicity.partition("..")
    if multiplicity == "*":
        return 0, float("inf")
    most = upper if dots else lower
    return int(lower), float("inf") if most == "*" else int(most)


def _dropped_events(old: Element, new: Element, matching: Matching) -> Iterator[BreakingChange]:
    uses: tuple[tuple[str, str, Callable[[Element], set[Ref]]], ...] = (
        ("EVENT_UNHANDLED", "handles", _handled_events),
        ("EVENT_UNSENT", "sends", _sent_events),
    )
    for rule, verb, used in uses:
        before = {matching.new_names.get(ref, ref): ref for ref in used(old)}
        for event in sorted(before.keys() - used(new), key=lambda ref: ref.name):
            message = f"statemachine `{display_name(new)}` no longer {verb} `{event.name}`"
            yield BreakingChange(rule, message, None, new.origin)


def _handled_events(machine: Element) -> set[Ref]:
    return {
        part
        for each in machine.walk()
        if each.kind == TRANSITION_KIND
        for part in each.name
        if isinstance(part, Ref) and part.kind == "event"
    }


def _sent_events(machine: Element) -> set[Ref]:
    return {
        part
        for each in machine.walk()
        for name, value in each.values
        if name in ("effect", "entry effect", "exit effect")
        for part in value
        if isinstance(part, Ref) and part.kind == "event"
    }
