"""Names of a model in its tests and scenarios, where these are read as such.

What means what there is known by whoever runs them. So a name is changed where, with the model
as it will be, the old one means nothing any more and the new one does: whatever else is called
the same keeps its name, and so do comments and texts.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.simulate.scenario_file import TABLES, read_scenario
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.testing.discovery import SUFFIX
from swarmdsl.execution.testing.models import Model, Models
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.ir import System

Reading = Callable[[Source], Diagnostics]
"""Reads a file as its tests or its scenario, and says what is wrong with it."""


def word(name: str) -> re.Pattern[str]:
    """What finds a name where it is a word of its own."""
    return re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])")


@dataclass(frozen=True)
class Mentions:
    """Where a file has a name: what is to change, and what means something else for sure."""

    changes: Sequence[Change] = ()
    others: frozenset[int] = frozenset()


def mentions(
    source: Source, old: str, new: str, files: Iterable[Path], before: System, after: System
) -> Mentions:
    """The names in a test file or scenario of a model of some files, before and after."""
    assert source.path is not None  # what has been read from a file
    if source.path.name.endswith(SUFFIX):
        paths = {path.resolve() for path in files}
        return _mentions(source, old, new, _tests(before, paths), _tests(after, paths))
    document = parse_toml(source, Diagnostics())
    if document is None or not document.values.keys() <= set(TABLES):
        return Mentions()
    pairs = zip(_subjects(before), _subjects(after), strict=True)
    found = [
        _mentions(source, old, new, reads, _scenario(will_be))
        for reads, will_be in ((_scenario(was), will_be) for was, will_be in pairs)
        if not reads(source).has_errors
    ]
    # Nothing says of which swarm or state machine it is.
    return found[0] if found and all(each == found[0] for each in found) else Mentions()


def _mentions(source: Source, old: str, new: str, reads: Reading, will_read: Reading) -> Mentions:
    places = [each.span() for each in word(old).finditer(source.text)]

    def wrong(chosen: set[int]) -> set[int]:
        text, now = _with(source.text, places, chosen, new)
        return _wrong(Source(source.name, text, source.path), now, will_read)

    already = _wrong(source, places, reads)
    chosen: set[int] = set()
    # What one mistake hides is seen when it is gone.
    while not (found := wrong(chosen) - already) <= chosen:
        chosen |= found
    chosen -= found
    others = wrong(set(range(len(places)))) - already - chosen
    changes = [(*places[each], new) for each in sorted(chosen)]
    return Mentions(changes, frozenset(places[each][0] for each in others))


def _wrong(source: Source, places: list[tuple[int, int]], read: Reading) -> set[int]:
    """Which of some places lie in what means nothing."""
    spans = [each.primary.span for each in read(source) if each.primary is not None]
    inside = [span for span in spans if span.source.path == source.path]
    return {
        number
        for number, (start, end) in enumerate(places)
        if any(span.start <= start and end <= span.end for span in inside if _is_short(span))
    }


def _is_short(span: Span) -> bool:
    """Whether it is that of a name, not of a whole table."""
    return "\n" not in span.text and "=" not in span.text


def _with(
    text: str, places: list[tuple[int, int]], chosen: set[int], new: str
) -> tuple[str, list[tuple[int, int]]]:
    """A text with another name at some places, and where all of them are then."""
    pieces: list[str] = []
    now = []
    done = length = 0
    for number, (start, end) in enumerate(places):
        name = new if number in chosen else text[start:end]
        pieces += (text[done:start], name)
        length += start - done + len(name)
        now.append((length - len(name), length))
        done = end
    return "".join((*pieces, text[done:])), now


def _tests(system: System, files: set[Path]) -> Reading:
    models = _Supposed(system, files)

    def read(source: Source) -> Diagnostics:
        report = Diagnostics()
        found = read_tests(source, models, report)
        for case in found.unread if found is not None else ():
            report.include(case.problems)
        return report

    return read


def _scenario(subject: Subject) -> Reading:
    def read(source: Source) -> Diagnostics:
        report = Diagnostics()
        document = parse_toml(source, report)
        if document is not None:
            read_scenario(document, subject, report)
        return report

    return read


def _subjects(system: System) -> list[Subject]:
    """All that a scenario can be about."""
    swarms = [Subject(each.name, system, swarm=each) for each in system.swarms]
    return swarms + [Subject(each.name, system, machine=each) for each in system.machines]


class _Supposed(Models):
    """Takes a system for that of some files; those of other models are read."""

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
        place = path.resolve()
        return place in self._files or any(place in each.parents for each in self._files)
