"""Format changes as text, Markdown or JSON."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.markdown import prose
from swarmdsl.base.source import Span
from swarmdsl.tools.compare.breaking_changes import BreakingChange
from swarmdsl.tools.compare.changes import Action, Change, display_name
from swarmdsl.tools.compare.elements import Element

FormatLocation = Callable[[Span], str]
"""Formats a location as `file:line`."""
_MARKS = {Action.ADDED: "+", Action.REMOVED: "-", Action.MOVED: ">"}


def format_changes(
    changes: Sequence[Change],
    breaking_changes: Iterable[BreakingChange],
    format_: str,
    location: FormatLocation,
) -> Iterator[str]:
    """Yield the lines of a report on all changes."""
    rules = {id(each.change): each.rule for each in breaking_changes if each.change is not None}
    if format_ == "json":
        yield from (json.dumps(_as_json(each, rules, location)) for each in changes)
        return
    lines = _markdown if format_ == "markdown" else _text
    for top, inner in _by_declaration(changes).items():
        yield from lines(top, inner, rules, location)


def format_breaking_changes(
    breaking_changes: Iterable[BreakingChange], format_: str, location: FormatLocation
) -> Iterator[str]:
    """Yield one line for each breaking change."""
    for each in breaking_changes:
        at = location(each.origin) if each.origin is not None else ""
        if format_ == "json":
            found = {"rule": each.rule, "message": each.message, "place": at or None}
            yield json.dumps(found)
        elif format_ == "markdown":
            line = _safe(f"{each.message}{f' ({at})' if at else ''}")
            yield f"- **{each.rule}** {line}"
        else:
            yield f"{f'{at}: ' if at else ''}{printable(each.message)} [{each.rule}]"


def _by_declaration(changes: Iterable[Change]) -> dict[Element, list[Change]]:
    found: dict[Element, list[Change]] = {}
    for change in changes:
        found.setdefault(change.top, []).append(change)
    return found


def _summarize(top: Element, changes: list[Change]) -> tuple[str, list[Change]]:
    """Mark of a declaration, and the changes to list below it."""
    whole = next((each for each in changes if each.element is top and not each.property_name), None)
    if whole is not None:
        return _MARKS[whole.action], []
    return "~", changes


def _text(
    top: Element, changes: list[Change], rules: Mapping[int, str], location: FormatLocation
) -> Iterator[str]:
    mark, inner = _summarize(top, changes)
    rule = _rule(changes[0], rules) if not inner else ""
    yield f"{mark} {top.kind} {printable(display_name(top))}{rule}{_at(top.origin, location)}"
    for each in inner:
        sign = _MARKS.get(each.action, "~")
        subject = f"{each.subject}: " if each.subject else ""
        rest = (
            "" if each.action in (Action.ADDED, Action.REMOVED) else f"{subject}{each.description}"
        )
        line = rest or each.subject
        yield f"    {sign} {printable(line)}{_rule(each, rules)}{_at(each.origin, location)}"


def _markdown(
    top: Element, changes: list[Change], rules: Mapping[int, str], location: FormatLocation
) -> Iterator[str]:
    _, inner = _summarize(top, changes)
    rule = _rule(changes[0], rules) if not inner else ""
    description = f" {changes[0].description}" if not inner else ""
    name = _safe(f"{top.kind} `{display_name(top)}`")
    yield f"- **{name}**{_safe(description)}{rule}{_safe(_at(top.origin, location))}"
    for each in inner:
        colon = "" if each.action in (Action.ADDED, Action.REMOVED) else ":"
        subject = f"{each.subject}{colon} " if each.subject else ""
        place = _safe(_at(each.origin, location))
        yield f"  - {_safe(f'{subject}{each.description}')}{_rule(each, rules)}{place}"


def _safe(text: str) -> str:
    return prose(printable(text))


def _rule(change: Change, rules: Mapping[int, str]) -> str:
    rule = rules.get(id(change))
    return f" [{rule}]" if rule is not None else ""


def _at(place: Span | None, location: FormatLocation) -> str:
    return f" ({location(place)})" if place is not None else ""


def _as_json(
    change: Change, rules: Mapping[int, str], location: FormatLocation
) -> dict[str, object]:
    def at(element: Element | None) -> str | None:
        place = element.place(change.property_name) if element is not None else None
        return location(place) if place is not None else None

    return {
        "change": change.action.value,
        "declaration": f"{change.top.kind} {display_name(change.top)}",
        "kind": change.kind,
        "name": display_name(change.element),
        "of": display_name(change.owner) if change.owner is not change.top else None,
        "what": change.property_name or None,
        "before": change.before or None,
        "after": change.after or None,
        "strength": change.strength,
        "breaking": rules.get(id(change)),
        "place_before": at(change.old),
        "place_after": at(change.new),
    }
