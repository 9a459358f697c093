"""Breakpoints on states and transitions."""

from __future__ import annotations

import operator
import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.ide.debugger.expressions import Evaluate, Expressions
from swarmdsl.ide.debugger.messages import Arguments, RequestError, optional, required
from swarmdsl.ide.debugger.points import Element
from swarmdsl.ide.server.positions import position
from swarmdsl.project.read_source import read_source
from swarmdsl.syntax.types import BOOL

_COUNT = re.compile(r"\s*(>=|<=|==|=|>|<|%)?\s*(\d{1,9})\s*")
_COMPARED: Mapping[str, Callable[[int, int], bool]] = {
    ">=": operator.ge,
    "<=": operator.le,
    ">": operator.gt,
    "<": operator.lt,
    "=": operator.eq,
    "==": operator.eq,
    "%": lambda hits, number: not hits % number,
}
_BRACES = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True)
class Place:
    """Place of a state or a transition; the path is the real one, lines and columns count from 1.

    Columns are units of UTF-16, as clients count them.
    """

    path: str
    line: int
    column: int


class Places:
    """Places of the states and transitions that machines of a run have."""

    def __init__(self, subject: Subject, machines: Iterable[Machine]) -> None:
        self._of: dict[int, Place] = {}
        self._starts: set[Place] = set()
        self._texts: dict[str, str] = {}
        self._owners: dict[tuple[str, int], set[tuple[str, str]]] = {}
        for machine in machines:
            for state in machine.states:
                elements: list[Element] = [state, *state.transitions]
                for element in elements:
                    span = subject.place(element.origin)
                    if span is None or span.absolute.source.path is None:
                        continue
                    at = span.absolute
                    path = os.path.realpath(at.source.path or "")
                    line, column = position(at.source, at.start)
                    place = Place(path, line + 1, column + 1)
                    self._starts.add(place)
                    self._of[id(element.origin)] = place
                    self._texts[path] = at.source.text
                    owners = self._owners.setdefault((path, place.line), set())
                    owners.add((machine.name, state.id))

    def of(self, element: Element) -> Place | None:
        """Return the place of a state or transition."""
        return self._of.get(id(element.origin))

    def begins(self, path: str, line: int, column: int) -> bool:
        """Return True if a state or transition begins at a place."""
        return Place(path, line, column) in self._starts

    def has_changed(self, path: str) -> bool:
        """Return True if a file is not any more what runs."""
        if path not in self._texts:
            return False
        source = read_source(Path(path), None, Diagnostics())
        return source is None or source.text != self._texts[path]

    def owners(self, path: str, line: int) -> list[tuple[str, str]]:
        """Return the machines and the states that have something at a line."""
        return sorted(self._owners[path, line])

    def lines(self, path: str, first: int, last: int | None = None) -> list[int]:
        """Return the lines of a file on which a run can stop, from the first to the last."""
        lines = (line for at, line in self._owners if at == path)
        return sorted(each for each in lines if each >= first and (last is None or each <= last))


class Breakpoint:
    """Breakpoint at a place, with conditions on when it counts.

    Without a column, it is on all that begins on the line. With a `message` it does not stop, but
    tells the message.
    """

    def __init__(self, line: int, column: int | None, asked: Arguments) -> None:
        self.line = line
        self.column = column
        self.condition = optional(asked, "condition", str) or ""
        self.message = optional(asked, "logMessage", str) or ""
        self._hits = 0
        self._count: Callable[[int], bool] = _always
        counted = optional(asked, "hitCondition", str)
        if counted and counted.strip():
            self._count = _counted(counted)

    def begin(self) -> None:
        """Count from 0, for a new run."""
        self._hits = 0

    def hits(self, member: int, evaluate: Evaluate) -> bool:
        """Return True if it counts for a member that is there; one more hit if so.

        A condition without a value does not hold.
        """
        if self.condition:
            try:
                if not evaluate(self.condition, member).value:
                    return False
            except RequestError:
                return False
        self._hits += 1
        return self._count(self._hits)

    def told(self, member: int, evaluate: Evaluate, shown: Callable[[Any], str]) -> str:
        """Return its message, with the values of the expressions in braces."""

        def value(found: re.Match[str]) -> str:
            try:
                return shown(evaluate(found[1], member).value)
            except RequestError as error:
                return f"{{{error}}}"

        return _BRACES.sub(value, self.message)


def _always(hits: int) -> bool:
    return True


def _counted(text: str) -> Callable[[int], bool]:
    found = _COUNT.fullmatch(text)
    if found is None or (found[1] == "%" and not int(found[2])):
        raise RequestError("write a number of hits, such as `3`, `>= 3` or `% 3`")
    compared, number = _COMPARED[found[1] or "="], int(found[2])
    return lambda hits: compared(hits, number)


class Breakpoints:
    """Breakpoints of a session, by file and line."""

    def __init__(self, places: Places, expressions: Expressions) -> None:
        self._places = places
        self._expressions = expressions
        self.asked: dict[str, list[Any]] = {}
        """Breakpoints as the client has asked for them, by file."""
        self._of: dict[str, list[Breakpoint]] = {}

    def replace(self, path: str, asked: list[Any]) -> list[dict[str, Any]]:
        """Replace those of a file; return where each is, or why it is nowhere."""
        real = os.path.realpath(path)
        kept: list[Breakpoint] = []
        answers: list[dict[str, Any]] = []
        for each in asked:
            try:
                made = self._made(real, each)
            except RequestError as error:
                answers.append({"verified": False, "message": str(error)})
            else:
                kept.append(made)
                answers.append({"verified": True, "line": made.line})
        self._of[real], self.asked[real] = kept, asked
        return answers

    def _made(self, path: str, asked: Any) -> Breakpoint:
        if not isinstance(asked, dict):
            raise RequestError("a breakpoint must be an object")
        line = next(iter(self._places.lines(path, required(asked, "line", int))), None)
        if line is None:
            raise RequestError("no state or transition of a machine that runs is here or below")
        column = optional(asked, "column", int)
        is_exact = column is not None and self._places.begins(path, line, column)
        made = Breakpoint(line, column if is_exact else None, asked)
        if made.condition:
            type_ = self._type(made.condition, path, line)
            if type_ not in (BOOL, None):
                raise RequestError(f"a condition is true or false, but this is a `{type_}`")
        for text in filter(None, _BRACES.findall(made.message)):
            self._type(text, path, line)
        return made

    def _type(self, text: str, path: str, line: int) -> ir.Type | None:
        """Return the type of an expression at a line, if it is known."""
        faults = []
        for machine, state in self._places.owners(path, line):
            try:
                return self._expressions.check(text, machine, state)
            except RequestError as error:
                faults.append(error)
        raise faults[0]

    def begin(self) -> None:
        """Count hits from 0, for a new run."""
        for each in (each for found in self._of.values() for each in found):
            each.begin()

    def at(self, element: Element) -> list[Breakpoint]:
        """Return those at a state or transition."""
        place = self._places.of(element) if self._of else None
        found = self._of.get(place.path, ()) if place is not None else ()
        return [
            each
            for each in found
            if place is not None and each.line == place.line and each.column in (None, place.column)
        ]
