"""Fixes that replace the text of a diagnostic by what its help says."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.problem import CODE, Act, Problem, Rule, inserting, proposed, replacing

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
    called = CODE.findall(problem.found.message)
    for wrong in reversed(called):
        found = problem.inside(wrong) if not _NAME.fullmatch(text) else None
        if found is not None:
            return replacing(found, name, safe=safe)
    return replacing(span, name, safe=safe)


def _one_of(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Use the only one that there is: "the roles are `uav`"."""
    names = CODE.findall(match[0])
    if len(names) == 1:
        yield _renamed(problem, names[0])


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


def _bracketed(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Sizes of arrays and multiplicities, without the brackets that are there already."""
    text = problem.span.text
    for size in CODE.findall(match[0]):
        if text == "[":
            end = problem.text.find("]", problem.span.end) + 1
            yield replacing(problem.part(problem.span.start, max(end, problem.span.end)), size)
        elif "[" in text:
            yield replacing(problem.span, text[: text.index("[")] + size)
        elif problem.text[problem.span.start - 1] == "[":
            yield replacing(problem.span, size[1:-1])


def _number_with_unit(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    number = match[1].partition(" ")[0]
    found = re.search(rf"(?<![\w.]){re.escape(number)}(?![\w.])", problem.span.text)
    if found is not None:
        start = problem.span.start
        place = problem.part(start + found.start(), start + found.end())
        yield replacing(place, match[1])


def _last_robot(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Name the last robot, in a string or with an index."""
    text, (_, start, end) = problem.text, problem.span
    index = re.compile(r"\[\d+\]").match(text, end)
    if problem.span.text.startswith('"'):
        yield replacing(problem.span, f'"{match[1]}"')
    else:
        yield replacing(problem.part(start, index.end() if index is not None else end), match[1])


def _range(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Extend a range so that it includes a value."""
    lower, dots, upper = problem.span.text.partition(" .. ")
    numbers = [_NUMBER.fullmatch(each.strip()) for each in (lower, upper, match[1])]
    low, high, value = (float(each[1]) if each else None for each in numbers)
    if not dots or low is None or high is None or value is None:
        return
    wide = (match[1], upper) if value < low else (lower, match[1])
    yield replacing(problem.span, " .. ".join(wide))


def _timeout(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """`on Timeout` becomes a delay."""
    if problem.text.endswith("on ", 0, problem.span.start):
        place = problem.part(problem.span.start - 3, problem.span.end)
        yield replacing(place, match[1])


def _separator(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    start = problem.span.start
    end = len(problem.text[:start].rstrip())
    edit = (problem.part(end, start), f"{match[1]} ")
    yield Fix(f"Insert `{match[1]}`", (edit,), safe=True)


def _before(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    start = problem.span.start
    edit = (problem.part(start, start), f"{match[1]} ")
    yield Fix(f"Insert `{match[1]}`", (edit,), safe=True)


def _comment(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Make an ordinary comment of one that documents nothing."""
    if problem.span.text.startswith("///"):
        slash = problem.part(problem.span.start, problem.span.start + 3)
        yield Fix(f"Begin the comment with `{match[1]}`", ((slash, match[1]),), safe=True)


def _unreadable(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    """Remove a character that cannot be in a file, or its escape."""
    if problem.span.start < problem.span.end:
        yield Fix("Remove the character", ((problem.span, ""),), safe=True)


def _typed_name(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """`float64 x` becomes `x : float64`."""
    name, _, type_ = match[1].partition(" : ")
    found = re.compile(rf"{re.escape(type_)}\s+\Z").search(problem.text, 0, problem.span.start)
    if name == problem.span.text and found is not None:
        yield replacing(problem.part(found.start(), problem.span.end), match[1], safe=True)


def _statement(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Write an import anew: `import ros "folder"`."""
    start = problem.text.rfind("import", 0, problem.span.start)
    if start >= 0 and "\n" not in problem.text[start : problem.span.start]:
        whole = problem.part(start, problem.span.end)
        complete = not match[1].endswith(("import", "ros"))
        text = match[1] if complete else f"{match[1]} {problem.span.text}"
        yield replacing(whole, text, safe=complete)


def _joined_line(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Join a line with the one above."""
    before = len(problem.text[: problem.span.start].rstrip())
    yield Fix(f"Write `{match[1]}`", ((problem.part(before, problem.span.start), " "),))


def _probability(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    number = re.search(r"[\d.]+", problem.span.text)
    if number is not None:
        start = problem.span.start
        yield replacing(problem.part(start + number.start(), start + number.end()), match[1])


def _wall(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    yield inserting(problem.span, f" ->{match[1].partition('->')[2]}")


def _left_out(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Remove the number of targets behind their name."""
    at = problem.text.find(match[1], problem.span.start)
    if at >= 0:
        edit = (problem.part(at, at + len(match[1])), "")
        yield Fix(f"Remove `{match[1]}`", (edit,))


def _no_address(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    found = re.compile(r"\s*\bto\s+\Z").search(problem.text, 0, problem.span.start)
    if found is not None:
        edit = (problem.part(found.start(), problem.span.end), "")
        yield Fix("Remove the address", (edit,), safe=True)


def _state_around(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    for text in CODE.findall(match[0]):
        yield replacing(problem.span, text.removeprefix("elapsed(").removesuffix(")"))


def _condition(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    """Give a query a condition that all items meet."""
    if problem.span.text.endswith(")"):
        end = problem.span.end - 1
        yield Fix("Add `where true`", ((problem.part(end, end), " where true"),))


def _corners(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
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


def _escape(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    """Escape a backslash that begins no escape."""
    start = problem.span.start
    yield Fix("Write `\\\\`", ((problem.part(start, start), "\\"),), safe=True)


def _other_unit(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Give a number the expected unit; its value stays."""
    number = re.fullmatch(r"(-?[\d.]+) *[^\d\s.]\S*", problem.span.text)
    if number is not None:
        yield replacing(problem.span, f"{number[1]} {match[1]}")


def _closing_brace(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
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
    edit = (problem.part(end, end), f"{gap}{' ' * width}{match[1]}\n")
    yield Fix(f"Add `{match[1]}`", (edit,))


ACTS: dict[str, Act] = {"rename": _meant, "write": _written}
RULES: tuple[tuple[str, Rule], ...] = (
    (r"did you mean `([^`]+)`\?", lambda p, m: _meant(p, m[1])),
    (r"the (?:roles|params|settings|arguments) are .*", _one_of),
    (r"it has (`\w+`(?:, | and )?)+", _one_of),
    (r"begin it on a line of its own, or write `(.)` before it;.*", _separator),
    (r"write `(:)` before `[^`]+`", _before),
    (r".*or begin it with `(//)`", _comment),
    (r"remove it(?:: XML cannot contain it)?", _unreadable),
    (r"write the name first: `([^`]+)`", _typed_name),
    (r"write `(import ros \"[^`]+)`, with its folder", _statement),
    (r"write `(import)` without `ros`", _statement),
    (r"name a file in it, or write `(import ros)` if .*", _statement),
    (r"write `(import [^`]+)` for all that .*", _statement),
    (
        r"close the string with `(\")` on the same line",
        lambda p, m: iter([inserting(p.span, m[1])]),
    ),
    (r"write a delay without `on`: `(after 5 s)[^`]*`", _timeout),
    (r"write `([^`]+)` on one line to delay it;.*", _joined_line),
    (r"write `\[[^`]*`.*", _bracketed),
    (r"write `\\\\` for `\\`", _escape),
    (r"write `(\})` at the end of the block", _closing_brace),
    (r"write a number in `([^`]+)`", _other_unit),
    (r"write `(round\([^`]+)`, or .*", proposed),
    (r"give it a unit: `([^`]+)`", _number_with_unit),
    (r"let the range include ([^,]+), or change the default", _range),
    (r"write a number from 0 to 1, such as `([^`]+)`", _probability),
    (r"write where it ends: `([^`]+)`", _wall),
    (r"leave `([^`]+)` out: there is one at each place", _left_out),
    (r"an empty address is that of nobody: .*", _no_address),
    (r"write (`elapsed\([^`]*`(?:, | or )?)+", _state_around),
    (r"write `count\(x in \w+ where \.\.\.\)`", _condition),
    (r"write the lower left corner first, .*", _corners),
    (r"items are counted from 0: the last one is `\[(\d+)\]`", proposed),
    (r"the last one is `([^`]+)`", _last_robot),
    (r"this is a robot; its role is `([^`]+)`", lambda p, m: _meant(p, m[1])),
    (r"this is a role; its robots are `([^`]+)` and so on", lambda p, m: _meant(p, m[1])),
    (r"choose another name, for example `([^`]+)`", proposed),
    (r"the values of an enum are whole numbers: `([^`]+)` for instance", proposed),
    (r"write `([^`]+)` for a string of any length", proposed),
    (r"(?:name one of its values|compare it|name an item of an array): `([^`]+)`", proposed),
    (r"for the outcome of an activity, write `([^`]+)`", proposed),
    (
        r"(?:it is a function|paths leave out regions|.* is a string): write `([^`]+)`",
        lambda p, m: _written(p, *CODE.findall(m[0])),
    ),
    (r"leave it out, or write `([^`]+)`", proposed),
    (r"write `([^`]+)`, or (?!give the param|`|if it).*", proposed),
    (
        r"write (?:`[^`]+`(?:, | or )?)+(?: for an interface of ROS)?",
        lambda p, m: _written(p, *CODE.findall(m[0])),
    ),
)
"""The first pattern that matches the whole help of a diagnostic makes its fixes."""
