"""Fixes that remove what does nothing, or cannot be where it is."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.bodies import remove
from swarmdsl.driver.fixes.problem import Act, Problem, Rules, replacing
from swarmdsl.driver.workspace.references import owner_at
from swarmdsl.syntax.ast import (
    Branch,
    Connector,
    Defer,
    Event,
    Initial,
    Node,
    Transition,
    Word,
    walk,
)

_COMMA_BEFORE = re.compile(r",\s*\Z")
_COMMA_AFTER = re.compile(r"\s*,\s*")


def _around(*kinds: type[Node], what: str) -> Act:
    """Return the rule that removes the innermost statement of some kinds."""

    def rule(problem: Problem) -> Iterator[Fix]:
        node = problem.around(*kinds)
        if node is not None:
            yield remove(node.span, what)

    return rule


def _unused(problem: Problem) -> Iterator[Fix]:
    """Remove a declaration that nothing uses, top-level or in one."""
    owner = owner_at(problem.file, problem.span.start)
    for node in walk(owner) if owner is not None else ():
        name = getattr(node, "name", None)
        if isinstance(name, Word) and name.span.absolute == problem.span:
            yield remove(node.span, f"`{name}`")
            return


def _import(problem: Problem) -> Iterator[Fix]:
    start = problem.text.rfind("import", 0, problem.span.start)
    if start >= 0 and "\n" not in problem.text[start : problem.span.start]:
        yield remove(problem.part(start, problem.span.end), "this import")


def _guard(problem: Problem) -> Iterator[Fix]:
    """Remove a guard with its brackets."""
    edit = _brackets(problem)
    if edit is not None:
        yield Fix("Remove the guard", ((edit, ""),))


def _brackets(problem: Problem) -> Span | None:
    text, (_, start, end) = problem.text, problem.span
    before = text[:start].rstrip()
    after = re.compile(r"\s*\]").match(text, end)
    if not before.endswith("[") or after is None:
        return None
    opening = len(before) - 1
    gap = 1 if text[opening - 1 : opening] == " " and text[after.end() :][:1] in (" ", "\n") else 0
    return problem.part(opening - gap, after.end())


def _otherwise(problem: Problem) -> Iterator[Fix]:
    """`[guard]` of the last branch becomes `else`."""
    edit = _brackets(problem)
    if edit is not None:
        gap = " " if edit.text.startswith(" ") else ""
        yield Fix("Write `else` in its place", ((edit, f"{gap}else"),))


def _trigger(problem: Problem) -> Iterator[Fix]:
    """Remove a redundant trigger, or the transition if it has no other."""
    edit = _with_comma(problem, problem.span)
    node = problem.around(Transition)
    if edit != problem.span:
        yield Fix(f"Remove `{problem.span.text}`", ((edit, ""),), safe=True)
    elif node is not None:
        yield remove(node.span, "the transition")


def _setting(problem: Problem) -> Iterator[Fix]:
    """One of two settings of an event that exclude each other."""
    for label in (problem.found.primary, *problem.found.related):
        if label is not None:
            span = label.span.absolute
            yield Fix(f"Remove `{span.text}`", ((_with_comma(problem, span), ""),))


def _with_comma(problem: Problem, span: Span) -> Span:
    """Return the span of an item of a list with the comma before or after it."""
    text, (_, start, end) = problem.text, span
    if (before := _COMMA_BEFORE.search(text, 0, start)) is not None:
        return problem.part(before.start(), end)
    after = _COMMA_AFTER.match(text, end)
    return problem.part(start, after.end()) if after is not None else span


def _no_settings(problem: Problem) -> Iterator[Fix]:
    event = problem.around(Event)
    if event is not None:
        start = event.span.absolute.start
        yield replacing(problem.part(start, start), "swarm ", title="Declare it as `swarm event`")


def _document(problem: Problem) -> Iterator[Fix]:
    """Move a documentation comment from behind its subject to the line above."""
    text, (_, start, end) = problem.text, problem.span
    line = text.rfind("\n", 0, start) + 1
    indent = re.compile(r"[ \t]*").match(text, line)
    code_end = len(text[:start].rstrip())
    if indent is not None and code_end > line:
        moved = (problem.part(line, line), f"{indent[0]}{problem.span.text.rstrip()}\n")
        edits = (moved, (problem.part(code_end, end), ""))
        yield Fix("Move the comment to the line before", edits, safe=True)


def _at_once(problem: Problem, text: str) -> Iterator[Fix]:
    """Write a transition without its guard."""
    node = problem.around(Transition)
    if node is not None:
        yield replacing(node.span.absolute, text)


def _brace(problem: Problem) -> Iterator[Fix]:
    yield remove(problem.span, f"`{problem.span.text}`")


def _to_the_top(problem: Problem) -> Iterator[Fix]:
    """Move an import to the top of its file."""
    first = next(iter(problem.file.model.declarations), None)
    end = problem.text.find("\n", problem.span.start)
    line = problem.text[problem.span.start : end if end >= 0 else None]
    head = list(re.finditer(r"^(?:package|import)\b[^\n]*\n", problem.text, re.MULTILINE))
    above = [each for each in head if each.start() < problem.span.start]
    if first is None:
        return
    start = first.span.absolute.start
    at = max((each.end() for each in above if each.end() <= start), default=0)
    moved = remove(problem.part(problem.span.start, problem.span.start + len(line)), "")
    yield Fix("Move it to the top of the file", ((problem.part(at, at), f"{line}\n"), *moved.edits))


RULES: Rules = {
    "leave out one": _setting,
    "move comment": _document,
    "move to top": _to_the_top,
    "remove bracket": _brace,
    "remove connector": _around(Connector, what="the connector"),
    "remove declaration": _unused,
    "remove defer": _around(Defer, what="`defer`"),
    "remove guard": _guard,
    "remove import": _import,
    "remove initial": _around(Initial, what="this line"),
    "remove transition": _around(Transition, Branch, what="the transition"),
    "remove trigger": _trigger,
    "replace transition": _at_once,
    "swarm event": _no_settings,
    "write else": _otherwise,
}
