"""References to model elements in test files and scenarios.

The readers of tests and scenarios decide which names refer to the model: a name is replaced if, in
the renamed model, the old name is an error there and the new one is not. Other elements with the
same name, comments and strings stay.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.inputs.scenario_keys import TABLES
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.testing.discovery import SUFFIX
from swarmdsl.execution.testing.models import Model, Models
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.ir import System

Check = Callable[[Source], Diagnostics]
"""Reads a file as tests or as a scenario and returns its diagnostics."""


def word_pattern(name: str) -> re.Pattern[str]:
    """Pattern that finds a name as a whole word."""
    return re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])")


@dataclass(frozen=True)
class References:
    """Uses of a name in a file: those to change, and the offsets of unrelated ones."""

    changes: Sequence[Change] = ()
    others: frozenset[int] = frozenset()


def find_references(
    source: Source, old: str, new: str, files: Iterable[Path], before: System, after: System
) -> References:
    """Find references in a test file or scenario with the model before and after."""
    assert source.path is not None  # it was read from a file
    if source.path.name.endswith(SUFFIX):
        paths = {Path(os.path.realpath(path)) for path in files}
        return _references_in(source, old, new, _tests(before, paths), _tests(after, paths))
    document = parse_toml(source, Diagnostics())
    if document is None or not document.values.keys() <= set(TABLES):
        return References()
    pairs = zip(_subjects(before), _subjects(after), strict=True)
    readings = [
        _references_in(source, old, new, check, _scenario(renamed))
        for check, renamed in ((_scenario(was), renamed) for was, renamed in pairs)
        if not check(source).has_errors
    ]
    # A scenario does not name its swarm or state machine: all candidates must agree.
    agree = all(each == readings[0] for each in readings)
    return readings[0] if readings and agree else References()


def _references_in(
    source: Source, old: str, new: str, check_before: Check, check_after: Check
) -> References:
    places = [each.span() for each in word_pattern(old).finditer(source.text)]

    def unresolved(chosen: set[int]) -> set[int]:
        text, now = _substitute(source.text, places, chosen, new)
        return _unresolved(Source(source.name, text, source.path), now, check_after)

    already = _unresolved(source, places, check_before)
    chosen: set[int] = set()
    # One error can hide another, so repeat until none is new.
    while not (found := unresolved(chosen) - already) <= chosen:
        chosen |= found
    chosen -= found
    others = unresolved(set(range(len(places)))) - already - chosen
    changes = [(*places[each], new) for each in sorted(chosen)]
    return References(changes, frozenset(places[each][0] for each in others))


def _unresolved(source: Source, places: list[tuple[int, int]], check: Check) -> set[int]:
    """Return the indices of the places inside diagnostics on unresolved names."""
    spans = [each.primary.span for each in check(source) if each.primary is not None]
    inside = [span for span in spans if span.source.path == source.path]
    return {
        number
        for number, (start, end) in enumerate(places)
        if any(span.start <= start and end <= span.end for span in inside if _is_name(span))
    }


def _is_name(span: Span) -> bool:
    """Return True for the span of a name, False for that of a whole table."""
    return "\n" not in span.text and "=" not in span.text


def _substitute(
    text: str, places: list[tuple[int, int]], chosen: set[int], new: str
) -> tuple[str, list[tuple[int, int]]]:
    """Replace the chosen places by `new`; return the text and the new places."""
    parts: list[str] = []
    offsets = []
    done = length = 0
    for number, (start, end) in enumerate(places):
        name = new if number in chosen else text[start:end]
        parts += (text[done:start], name)
        length += start - done + len(name)
        offsets.append((length - len(name), length))
        done = end
    return "".join((*parts, text[done:])), offsets


def _tests(system: System, files: set[Path]) -> Check:
    models = _ModelsWith(system, files)

    def read(source: Source) -> Diagnostics:
        report = Diagnostics()
        found = read_tests(source, models, report)
        for case in found.unread if found is not None else ():
            report.include(case.problems)
        return report

    return read


def _scenario(subject: Subject) -> Check:
    def read(source: Source) -> Diagnostics:
        report = Diagnostics()
        document = parse_toml(source, report)
        if document is not None:
            read_scenario(document, subject, report)
        return report

    return read


def _subjects(system: System) -> list[Subject]:
    """All possible subjects of a scenario."""
    swarms = [Subject(each.name, system, swarm=each) for each in system.swarms]
    return swarms + [Subject(each.name, system, machine=each) for each in system.machines]


class _ModelsWith(Models):
    """Models in which `system` replaces the model of some files."""

    def __init__(self, system: System, files: set[Path]) -> None:
        super().__init__()
        self._system = Model(system, {})
        self._files = files

    def of(
        self, named: list[tuple[Path, Span]], test_file: Path, report: Diagnostics
    ) -> Model | None:
        if all(self._is_ours(path) for path, _ in named):
            return self._system
        return super().of(named, test_file, report)

    def _is_ours(self, path: Path) -> bool:
        place = Path(os.path.realpath(path))
        return place in self._files or any(place in each.parents for each in self._files)
