"""Differences as text for a person, as Markdown for a review, and as JSON for programs."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.source import Span
from swarmdsl.tools.compare.breaking_changes import Breach
from swarmdsl.tools.compare.changes import Action, Change, called
from swarmdsl.tools.compare.elements import Element

Place = Callable[[Span], str]
"""How a place is written, `file:line`."""
_MARKS = {Action.ADDED: "+", Action.REMOVED: "-", Action.MOVED: ">"}


def differences(
    changes: Sequence[Change], breaches: Iterable[Breach], format_: str, place: Place
) -> Iterator[str]:
    """The lines of a report."""
    rules = {id(breach.change): breach.rule for breach in breaches if breach.change is not None}
    if format_ == "json":
        yield from (json.dumps(_as_json(each, rules, place)) for each in changes)
        return
    lines = _markdown if format_ == "markdown" else _text
    for top, inner in _by_declaration(changes).items():
        yield from lines(top, inner, rules, place)


def breaking(breaches: Iterable[Breach], format_: str, place: Place) -> Iterator[str]:
    """A line for each thing that breaks something."""
    for breach in breaches:
        at = place(breach.origin) if breach.origin is not None else ""
        if format_ == "json":
            found = {"rule": breach.rule, "message": breach.message, "place": at or None}
            yield json.dumps(found)
        elif format_ == "markdown":
            yield f"- **{breach.rule}** {breach.message}{f' ({at})' if at else ''}"
        else:
            yield f"{f'{at}: ' if at else ''}{printable(breach.message)} [{breach.rule}]"


def _by_declaration(changes: Iterable[Change]) -> dict[Element, list[Change]]:
    found: dict[Element, list[Change]] = {}
    for change in changes:
        found.setdefault(change.top, []).append(change)
    return found


def _title(top: Element, changes: list[Change]) -> tuple[str, list[Change]]:
    """The mark of a declaration, and what is left to say where that is not all."""
    whole = next((each for each in changes if each.element is top and not each.word), None)
    if whole is not None:
        return _MARKS[whole.action], []
    return "~", changes


def _text(
    top: Element, changes: list[Change], rules: Mapping[int, str], place: Place
) -> Iterator[str]:
    mark, inner = _title(top, changes)
    rule = _rule(changes[0], rules) if not inner else ""
    yield f"{mark} {top.kind} {printable(called(top))}{rule}{_at(top, place)}"
    for each in inner:
        sign = _MARKS.get(each.action, "~")
        subject = f"{each.subject}: " if each.subject else ""
        rest = "" if each.action in (Action.ADDED, Action.REMOVED) else f"{subject}{each.said}"
        line = rest or each.subject
        yield f"    {sign} {printable(line)}{_rule(each, rules)}{_at(each.element, place)}"


def _markdown(
    top: Element, changes: list[Change], rules: Mapping[int, str], place: Place
) -> Iterator[str]:
    _, inner = _title(top, changes)
    rule = _rule(changes[0], rules) if not inner else ""
    said = f" {changes[0].said}" if not inner else ""
    yield f"- **{top.kind} `{called(top)}`**{said}{rule}{_at(top, place)}"
    for each in inner:
        colon = "" if each.action in (Action.ADDED, Action.REMOVED) else ":"
        subject = f"{each.subject}{colon} " if each.subject else ""
        yield f"  - {subject}{each.said}{_rule(each, rules)}{_at(each.element, place)}"


def _rule(change: Change, rules: Mapping[int, str]) -> str:
    rule = rules.get(id(change))
    return f" [{rule}]" if rule is not None else ""


def _at(element: Element, place: Place) -> str:
    return f" ({place(element.origin)})" if element.origin is not None else ""


def _as_json(change: Change, rules: Mapping[int, str], place: Place) -> dict[str, object]:
    def at(element: Element | None) -> str | None:
        return place(element.origin) if element is not None and element.origin else None

    return {
        "change": change.action.value,
        "declaration": f"{change.top.kind} {called(change.top)}",
        "kind": change.kind,
        "name": called(change.element),
        "of": called(change.owner) if change.owner is not change.top else None,
        "what": change.word or None,
        "before": change.before or None,
        "after": change.after or None,
        "breaking": rules.get(id(change)),
        "place_before": at(change.old),
        "place_after": at(change.new),
    }
