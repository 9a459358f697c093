"""Read test files: subjects, scenarios and tests."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.toml import Document, Keys, Place, parse_toml
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.inputs.choose_space import Spaces, choose_space
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.testing.case import Case, End, InvalidTest, Step, TestFile, actions
from swarmdsl.execution.testing.claims import ClaimReader
from swarmdsl.execution.testing.keys import FILE, IMPOSSIBLE, MOST_SEEDS, TEST
from swarmdsl.execution.testing.measures import read_measures
from swarmdsl.execution.testing.models import Model, Models
from swarmdsl.execution.testing.names import Names
from swarmdsl.execution.testing.steps import StepReader
from swarmdsl.ir import Property
from swarmdsl.project.read_source import read_source

_NEVER = {"aborted": 0.0, "preempted": 0.0, "never": 1.0}


def read_tests(
    source: Source, models: Models, report: Diagnostics, *, runs: bool = True
) -> TestFile | None:
    """Read the tests of a file; None if it has errors, which are reported.

    Errors in a single test are kept with it, so that the others can run. Unless it `runs`, no space
    is prepared, for which Python of the project may be imported.
    """
    document = parse_toml(source, report)
    if document is None:
        return None
    assert source.path is not None  # paths in it are relative to the file
    cases = _Reader(document, source.path, models, report, runs).read()
    if not cases or report.has_errors:
        for case in cases:
            report.include(case.problems if isinstance(case, InvalidTest) else ())
        return None
    return TestFile(document.source, tuple(cases))


class _Reader:
    def __init__(
        self, document: Document, path: Path, models: Models, report: Diagnostics, runs: bool
    ) -> None:
        self._runs = runs
        self._path = path
        self._models = models
        self._report = report
        self._top = Table(document, (), report)

    def read(self) -> list[Case | InvalidTest]:
        """Return the tests; none if the model has errors."""
        self._top.check_keys(FILE, "a test file")
        if self._top.values.get("test", []) == []:
            help_ = "a test begins with `[[test]]`"
            self._report.report("no-tests", path=self._top.document.source.name, help=help_)
            return []
        named = list(self._paths(self._top, "model")) if "model" in self._top else []
        if "model" in self._top and not named:
            if not self._report.has_errors:
                self._top.wrong(("model",), "a path, or a list of some", [])
            return []
        model = self._models.of(named, self._path, self._report)
        if model is None:
            return []
        names: dict[str, Span] = {}
        tables = enumerate(self._top.items("test"))
        return [self._read(number, table.keys, names, model) for number, table in tables]

    def _read(
        self, number: int, keys: Keys, names: dict[str, Span], model: Model
    ) -> Case | InvalidTest:
        report = Diagnostics()
        table = Table(self._top.document, keys, report)
        table.check_keys(TEST, "a test")
        name = self._name(table, names)
        case = self._case(table, name or "", model)
        if case is None or report.has_errors:
            return InvalidTest(name or f"test {number + 1}", _place(table), tuple(report))
        self._report.include(report)
        return case

    def _name(self, table: Table, names: dict[str, Span]) -> str | None:
        if "name" not in table:
            table.report.report("missing-key", table.value_place(()), name="name")
            return None
        name, place = table.values["name"], table.value_place(("name",))
        if not isinstance(name, str) or not name.strip() or not name.isprintable():
            table.wrong(("name",), "a string without line breaks", name)
            return None
        if name in names:
            related = (Label(names[name], "the first one"),)
            table.report.report("duplicate-name", place, kind="test", name=name, related=related)
        names.setdefault(name, place)
        return name

    def _case(self, table: Table, name: str, model: Model) -> Case | None:
        subject = self._subject(table, model)
        scenario = self._scenario(table, subject) if subject is not None else None
        count = self._whole(table, "seeds")
        passing = self._holder(table, "passing")
        share = passing.share("passing") if "passing" in passing else 1.0
        if subject is None or scenario is None:
            return None
        cast = actors(
            subject, subject.create_robots(scenario.counts, scenario.alone), scenario, table.report
        )
        if not cast:
            return None
        names = Names(subject, cast, table.report)
        claims = ClaimReader(names, table.report)
        reader = StepReader(names, claims, table.report, skips=self._skips(table))
        steps = self._steps(table, reader)
        always = [claims.always(each) for each in table.items("always")]
        if share is None:
            return None
        played = _with_ends(scenario, steps, cast)
        spaces = Spaces()
        if self._runs:
            spaces = choose_space(scenario.world, subject, played, table.report)
        return Case(
            name,
            _place(table),
            subject,
            played,
            tuple(steps),
            tuple(claim for claim in always if claim is not None),
            tuple(range(scenario.seed, scenario.seed + count)),
            share,
            *self._properties(table, subject),
            read_measures(table, subject),
            self._skips(table),
            spaces,
        )

    def _properties(
        self, table: Table, subject: Subject
    ) -> tuple[tuple[tuple[Property, Span], ...], tuple[tuple[Property, Span], ...]]:
        """Read the properties that must hold, and those that must be violated.

        Of properties that the file names for all tests, a test has those about its subject.
        """
        known = {each.name: each for each in watchable(subject)}
        violated = _named_properties(table, "violates", known)
        holder = self._holder(table, "properties")
        if holder.values.get("properties") == "all":
            place = holder.value_place(("properties",))
            names = {each.name for each, _ in violated}
            return tuple(
                (each, place) for each in known.values() if each.name not in names
            ), violated
        system = subject.system
        if holder is self._top and system is not None:
            named = _named_properties(
                holder, "properties", {each.name: each for each in system.judged}
            )
            return tuple(each for each in named if each[0].name in known), violated
        return _named_properties(holder, "properties", known), violated

    def _steps(self, table: Table, reader: StepReader) -> list[Step]:
        if not table.values.get("steps", True) or "steps" not in table:
            table.report.report(
                "missing-key",
                table.value_place(("steps",) if "steps" in table else ()),
                name="steps",
                help='`steps = [{ pass = "1 min" }]` lets a minute pass',
            )
            return []
        found = [reader.step(each) for each in table.items("steps")]
        return [step for step in found if step is not None]

    def _subject(self, table: Table, model: Model) -> Subject | None:
        for holder in (table, self._top):
            given = [key for key in ("swarm", "machine") if key in holder]
            if len(given) > 1:
                reason = "`swarm` and `machine` cannot be combined"
                holder.report.report("impossible-step", holder.key_place("machine"), reason=reason)
                return None
            if given:
                return model.subject(holder, given[0], holder.report)
        return model.subject(table, None, table.report)

    def _scenario(self, table: Table, subject: Subject) -> Scenario | None:
        """Read the scenario of a test, from a file or a table."""
        holder = self._holder(table, "scenario")
        value: Any = holder.values.get("scenario", {})
        if "scenario" not in holder:
            return Scenario()
        if isinstance(value, dict):
            return read_scenario(_part(holder, "scenario"), subject, holder.report)
        if not isinstance(value, str):
            holder.wrong(("scenario",), "a file, or a table", value)
            return None
        for path, place in self._paths(holder, "scenario"):
            source = read_source(path, place, holder.report, "a scenario")
            document = parse_toml(source, holder.report) if source is not None else None
            if document is not None:
                return read_scenario(document, subject, holder.report)
        return None

    def _skips(self, table: Table) -> bool:
        holder = self._holder(table, "impossible")
        if "impossible" not in holder:
            return False
        return holder.name("impossible", IMPOSSIBLE, "way") == "skip"

    def _whole(self, table: Table, key: str) -> int:
        holder = self._holder(table, key)
        return (holder.whole(key, 1, MOST_SEEDS) or 1) if key in holder else 1

    def _holder(self, table: Table, key: str) -> Table:
        """Return the table with a key: the test, else the file."""
        return table if key in table else self._top

    def _paths(self, table: Table, key: str) -> Iterator[tuple[Path, Span]]:
        """Yield paths from a string or list, relative to the folder of the test file."""
        value = table.values[key]
        for number, each in enumerate(value if isinstance(value, list) else [value]):
            way = (key, number) if isinstance(value, list) else (key,)
            if not isinstance(each, str) or not each or "\0" in each:
                table.wrong(way, "a path", each)
            else:
                yield Path(os.path.normpath(self._path.parent / each)), table.value_place(way)


def _place(table: Table) -> Span:
    """Return the place of the name of a test, else that of the test."""
    return table.value_place(("name",) if "name" in table else ())


def _part(table: Table, key: str) -> Document:
    """Return a nested table as a separate document."""
    keys = (*table.keys, key)
    inside: dict[tuple[str | int, ...], Place] = {
        way[len(keys) :]: place
        for way, place in table.document.places.items()
        if way[: len(keys)] == keys
    }
    return Document(table.document.source, table.values[key], inside)


def _named_properties(
    table: Table, key: str, known: Mapping[str, Property]
) -> tuple[tuple[Property, Span], ...]:
    """Read names of properties, each with its place."""
    if key not in table:
        return ()
    names = table.names(key, known, "property")
    several = isinstance(table.values[key], list)
    return tuple(
        (
            known[name],
            table.value_place((key, table.values[key].index(name)) if several else (key,)),
        )
        for name in names
    )


def _with_ends(scenario: Scenario, steps: list[Step], cast: list[Actor]) -> Scenario:
    """Return a scenario in which functions ended by the test do not end on their own."""
    functions = {key: dict(said) for key, said in scenario.functions.items()}
    for action in (each for step in steps for each in actions(step)):
        if isinstance(action, End):
            for number in action.of:
                key = (action.function, cast[number].robot.name or "")
                functions[key] = {**functions.get(key, {}), **_NEVER}
    return replace(scenario, functions=functions)
