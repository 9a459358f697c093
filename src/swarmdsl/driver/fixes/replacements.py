"""Fixes that replace the text of a diagnostic."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.driver.fixes.problem import Problem, Rules, inserting, proposed, replacing

_NAME = re.compile(r"[\w./]+")
_NUMBER = re.compile(r"(-?[\d.]+(?:e[+-]?\d+)?) *([^\d\s.].*)?")


def _meant(problem: Problem, name: str) -> Iterator[Fix]:
    """`did you mean`: the similar name, in quotes where the wrong one is."""
    yield _renamed(problem, name)


def _renamed(problem: Problem, name: str, *, safe: bool = False) -> Fix:
    span = problem.span
    text = span.text
    if text.startswith('"') and text.endswith('"'):
        return replacing(span, f'"{name}"', safe=safe)
    if text.endswith(".*"):
        return replacing(span, f"{name}.*", safe=safe)
    if "." in text and "." not in name and _NAME.fullmatch(text):
        place = problem.part(span.end - len(text.rpartition(".")[2]), span.end)
        return replacing(place, name, safe=safe)
    if not _NAME.fullmatch(text):
        wrong = closest(name, re.findall(r"[\w./]+", text))
        found = problem.inside(wrong) if wrong is not None else None
        if found is not None:
            return replacing(found, name, safe=safe)
    return replacing(span, name, safe=safe)


def _written(problem: Problem, *written: str) -> Iterator[Fix]:
    """Yield what is to stand at the place: one text is the only reading, several are proposals."""
    texts = [each for each in written if "..." not in each]
    # A number can be meant in more than one way, but not if only the name of its unit is wrong.
    unclear = problem.span.text[:1].isdigit() and not _renames_unit(problem.span.text, texts)
    safe = len(texts) == 1 and not unclear
    for text in texts:
        yield replacing(_with_repeated(problem, text), text, safe=safe)


def _with_repeated(problem: Problem, text: str) -> Span:
    """Return the place with what a text repeats around it: `lost after 5 s` for `5` in `lost 5 s`.

    Words around the place count as repeated if the text has them around what is there.
    """
    span, source = problem.span, problem.text
    found = re.search(rf"(?<!\w){re.escape(span.text)}(?!\w)", text) if span.text else None
    if found is None:
        return span
    start, end = span.start, span.end
    words = [text[: each.end()] for each in re.finditer(r"\w+", text[: found.start()])]
    line = source[source.rfind("\n", 0, start) + 1 : start].rstrip()
    for each in words:
        if re.search(rf"(?<!\w){re.escape(each)}\Z", line):
            start -= len(source[:start]) - len(source[:start].rstrip()) + len(each)
            break
    if found.end() < len(text) and source.startswith(text[found.end() :], end):
        end += len(text) - found.end()
    return problem.part(start, end)


def _renames_unit(text: str, texts: list[str]) -> bool:
    """Return True if each text has the same number with another name of a unit."""
    number, _, unit = text.partition(" ")
    return bool(unit) and all(each.startswith(f"{number} ") for each in texts)


def _bracketed(problem: Problem, *sizes: str) -> Iterator[Fix]:
    """Sizes of arrays and multiplicities, without the brackets that are there already."""
    text = problem.span.text
    for size in sizes:
        if text == "[":
            end = problem.text.find("]", problem.span.end) + 1
            yield replacing(problem.part(problem.span.start, max(end, problem.span.end)), size)
        elif "[" in text:
            yield replacing(problem.span, text[: text.index("[")] + size)
        elif problem.text[problem.span.start - 1] == "[":
            yield replacing(problem.span, size[1:-1])


def _number_with_unit(problem: Problem, text: str) -> Iterator[Fix]:
    number = text.partition(" ")[0]
    found = re.search(rf"(?<![\w.]){re.escape(number)}(?![\w.])", problem.span.text)
    if found is not None:
        start = problem.span.start
        place = problem.part(start + found.start(), start + found.end())
        yield replacing(place, text)


def _last_robot(problem: Problem, text: str) -> Iterator[Fix]:
    """Name the last robot, in a string or with an index."""
    _, start, end = problem.span
    index = re.compile(r"\[\d+\]").match(problem.text, end)
    if problem.span.text.startswith('"'):
        yield replacing(problem.span, f'"{text}"')
    else:
        yield replacing(problem.part(start, index.end() if index is not None else end), text)


def _timeout(problem: Problem, text: str) -> Iterator[Fix]:
    """`on Timeout` becomes a delay."""
    if problem.text.endswith("on ", 0, problem.span.start):
        place = problem.part(problem.span.start - 3, problem.span.end)
        yield replacing(place, text)


def _separator(problem: Problem, text: str) -> Iterator[Fix]:
    start = problem.span.start
    end = len(problem.text[:start].rstrip())
    edit = (problem.part(end, start), f"{text} ")
    yield Fix(f"Insert `{text}`", (edit,), safe=True)


def _before(problem: Problem, text: str) -> Iterator[Fix]:
    start = problem.span.start
    edit = (problem.part(start, start), f"{text} ")
    yield Fix(f"Insert `{text}`", (edit,), safe=True)


def _comment(problem: Problem, text: str) -> Iterator[Fix]:
    """Make an ordinary comment of one that documents nothing."""
    if problem.span.text.startswith("///"):
        slash = problem.part(problem.span.start, problem.span.start + 3)
        yield Fix(f"Begin the comment with `{text}`", ((slash, text),), safe=True)


def _unreadable(problem: Problem) -> Iterator[Fix]:
    """Remove a character that cannot be in a file, or its escape."""
    if problem.span.start < problem.span.end:
        yield Fix("Remove the character", ((problem.span, ""),), safe=True)


def _typed_name(problem: Problem, text: str) -> Iterator[Fix]:
    """`float64 x` becomes `x : float64`."""
    name, _, type_ = text.partition(" : ")
    found = re.compile(rf"{re.escape(type_)}\s+\Z").search(problem.text, 0, problem.span.start)
    if name == problem.span.text and found is not None:
        yield replacing(problem.part(found.start(), problem.span.end), text, safe=True)


def _statement(problem: Problem, text: str) -> Iterator[Fix]:
    """Write an import anew: `import ros "folder"`."""
    start = problem.text.rfind("import", 0, problem.span.start)
    if start >= 0 and "\n" not in problem.text[start : problem.span.start]:
        whole = problem.part(start, problem.span.end)
        complete = not text.endswith(("import", "ros"))
        text = text if complete else f"{text} {problem.span.text}"
        yield replacing(whole, text, safe=complete)


def _joined_line(problem: Problem, text: str) -> Iterator[Fix]:
    """Join a line with the one above."""
    before = len(problem.text[: problem.span.start].rstrip())
    yield Fix(f"Write `{text}`", ((problem.part(before, problem.span.start), " "),))


def _probability(problem: Problem, text: str) -> Iterator[Fix]:
    number = re.search(r"[\d.]+", problem.span.text)
    if number is not None:
        start = problem.span.start
        yield replacing(problem.part(start + number.start(), start + number.end()), text)


def _appended(problem: Problem, *texts: str) -> Iterator[Fix]:
    for text in texts:
        yield inserting(problem.span, text)


def _left_out(problem: Problem, text: str) -> Iterator[Fix]:
    """Remove the number of targets behind their name."""
    at = problem.text.find(text, problem.span.start)
    if at >= 0:
        edit = (problem.part(at, at + len(text)), "")
        yield Fix(f"Remove `{text}`", (edit,))


def _instead(problem: Problem, text: str, new: str) -> Iterator[Fix]:
    """Replace a text behind the place."""
    at = problem.text.find(text, problem.span.start)
    if at >= 0:
        yield replacing(problem.part(at, at + len(text)), new)


def _no_address(problem: Problem) -> Iterator[Fix]:
    found = re.compile(r"\s*\bto\s+\Z").search(problem.text, 0, problem.span.start)
    if found is not None:
        edit = (problem.part(found.start(), problem.span.end), "")
        yield Fix("Remove the address", (edit,), safe=True)


def _states_around(problem: Problem, *names: str) -> Iterator[Fix]:
    for name in names:
        yield replacing(problem.span, name)


def _condition(problem: Problem) -> Iterator[Fix]:
    """Give a query a condition that all items meet."""
    if problem.span.text.endswith(")"):
        end = problem.span.end - 1
        yield Fix("Add `where true`", ((problem.part(end, end), " where true"),))


def _corners(problem: Problem) -> Iterator[Fix]:
    """Put the lower left corner of a box first."""
    point = r"\(([^,()]+), ([^,()]+)\)"
    found = re.search(rf"{point} \.\. {point}", problem.span.text)
    pairs = [(found[1], found[3]), (found[2], found[4])] if found is not None else []
    sorted_ = []
    for pair in pairs:
        numbers = [_NUMBER.fullmatch(each.strip()) for each in pair]
        if any(each is None for each in numbers):
            return
        sorted_.append(sorted(pair, key=_length))
    if found is not None:
        (left, right), (low, high) = sorted_
        start = problem.span.start
        place = problem.part(start + found.start(), start + found.end())
        yield replacing(place, f"({left}, {low}) .. ({right}, {high})")


def _length(text: str) -> float:
    found = _NUMBER.fullmatch(text.strip())
    return float(found[1]) if found is not None else 0.0


def _escape(problem: Problem) -> Iterator[Fix]:
    """Escape a backslash that begins no escape."""
    start = problem.span.start
    yield Fix("Write `\\\\`", ((problem.part(start, start), "\\"),), safe=True)


def _other_unit(problem: Problem, text: str) -> Iterator[Fix]:
    """Give a number the expected unit; its value stays."""
    number = re.fullmatch(r"(-?[\d.]+) *[^\d\s.]\S*", problem.span.text)
    if number is not None:
        yield replacing(problem.span, f"{number[1]} {text}")


def _closing_brace(problem: Problem, brace: str) -> Iterator[Fix]:
    """Close a block before the next line that is not indented more than its first one."""
    text, start = problem.text, problem.span.start
    first = text.rfind("\n", 0, start) + 1
    indent = re.compile(r"[ \t]*").match(text, first)
    width = len(indent[0]) if indent is not None else 0
    at = text.find("\n", start) + 1
    while 0 < at < len(text):
        line = text[at : (text.find("\n", at) + 1) or None]
        if line.strip() and len(line) - len(line.lstrip()) <= width:
            break
        at += len(line)
    end = at if at > 0 else len(text)
    while text[:end].endswith("\n\n"):
        end -= 1
    gap = "" if text[:end].endswith("\n") else "\n"
    edit = (problem.part(end, end), f"{gap}{' ' * width}{brace}\n")
    yield Fix(f"Add `{brace}`", (edit,))


RULES: Rules = {
    "add condition": _condition,
    "add unit": _number_with_unit,
    "append": _appended,
    "begin comment": _comment,
    "close block": _closing_brace,
    "delay": _timeout,
    "escape": _escape,
    "join lines": _joined_line,
    "last robot": _last_robot,
    "leave out": _left_out,
    "name first": _typed_name,
    "number": _probability,
    "other unit": _other_unit,
    "prefix": _before,
    "propose": proposed,
    "remove address": _no_address,
    "remove character": _unreadable,
    "rename": _meant,
    "separate": _separator,
    "size": _bracketed,
    "sort corners": _corners,
    "state around": _states_around,
    "write": _written,
    "write instead": _instead,
    "write import": _statement,
}
