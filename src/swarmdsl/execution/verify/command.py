"""`swarmc verify`: look at all states of a swarm, prove its properties, and print the results."""

from __future__ import annotations

import gc
import signal
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TextIO

from swarmdsl import ir
from swarmdsl.base import interrupts
from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.naming import fresh
from swarmdsl.base.records import dataclass
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.inputs.choose_space import has_places
from swarmdsl.execution.simulate.inputs.load_scenario import load_scenario
from swarmdsl.execution.simulate.machines.subject import Subject, choose
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.verify.any_size.prove import enough, prove_any
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.finding import Finding, Survey
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import Verdict, at_limit, worst
from swarmdsl.execution.verify.properties.sentence import is_about_ends
from swarmdsl.execution.verify.report import diagnostics
from swarmdsl.execution.verify.report.progress import Progress
from swarmdsl.execution.verify.report.results import Results, as_document, junit
from swarmdsl.execution.verify.report.run_text import Fields
from swarmdsl.execution.verify.report.shown import (
    Shown,
    Unshown,
    shown_by_finding,
    shown_by_verdict,
)
from swarmdsl.execution.verify.report.summary import Search, summary
from swarmdsl.execution.verify.report.test_file import TestFile
from swarmdsl.execution.verify.robot.environment import Options, check_silent
from swarmdsl.execution.verify.search.run import Run, written
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.sizes import Size, bounds, shown, sizes, whole


@dataclass(frozen=True)
class Request:
    """Arguments of the command; `output` is the folder for runs, the last ones are files."""

    paths: tuple[Path, ...]
    machine: str | None = None
    swarm: str | None = None
    properties: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = ()
    capacity: int = 2
    lossy: bool = False
    exact: bool = False
    faults: int | None = None
    silent: tuple[str, ...] = ()
    scenario: Path | None = None
    limits: Limits = Limits()
    format: str = "text"
    output: Path | None = None
    results: Path | None = None
    junit: Path | None = None
    saved_test: Path | None = None
    show: Callable[[str, str], object] | None = None
    """Gets the name and the trace of each run that shows what is wrong."""


def verify(request: Request, stdout: TextIO, stderr: TextIO) -> bool | None:
    """Verify a swarm; return True without errors, None if interrupted."""
    # The compiler disables garbage collection, but a search may be long.
    gc.enable()
    report = Diagnostics()
    session = _Session(request, report, stdout, stderr)
    subject = session.subject()
    # Everything asks the budget: what was found is told, and files are whole.
    with interrupts.first_one(signal.SIGINT, session.interrupt):
        if subject is not None:
            session.run(subject)
        session.write_files()
        stdout.flush()
        render(report, request.format, stdout)
        stdout.flush()
    return None if session.interrupted else not report.has_errors


class _Session:
    def __init__(
        self, request: Request, report: Diagnostics, stdout: TextIO, stderr: TextIO
    ) -> None:
        self._request = request
        self._report = report
        self._results = stdout if request.format == "text" else stderr
        self._progress = Progress(stderr)
        self._budget = Budget(request.limits, self._progress.tell)
        self._models: list[Path] = []
        self._written: dict[str, Path] = {}
        self._findings: dict[str, Finding] = {}
        """Findings by the names of their runs, each of the smallest swarm that has it."""
        self._worst_at: dict[str, dict[str, int]] = {}
        self._found: Results | None = None
        self._tests: TestFile | None = None
        self._scenario: Scenario | None = None

    def interrupt(self) -> None:
        """Tell what was found, and end."""
        self._budget.interrupt()

    @property
    def interrupted(self) -> bool:
        """True if not all may have been looked at."""
        return self._budget.interrupted

    def run(self, subject: Subject) -> None:
        """Verify a subject, and tell what was found."""
        properties = self._properties(subject)
        self._scenario = self._scenario_of(subject)
        known = self._scenario.counts if self._scenario is not None else {}
        every = sizes(subject, self._request.sizes, self._report, known)
        assert subject.system is not None
        check_silent(self._request.silent, subject.system, self._report)
        if self._report.has_errors:
            return
        asked = self._request
        if asked.saved_test is not None:
            self._tests = TestFile(
                subject, self._models, asked.saved_test, asked.scenario, self._budget
            )
        surveys: list[Survey] = []
        verdicts: dict[str, Verdict] = {}
        full: set[str] = set()
        looked: list[dict[str, int]] = []
        for counts in every:
            model = self._model(subject, counts, properties)
            if model is None:
                return
            looked.append(counts)
            self._size(model, whole(subject, counts), properties, verdicts, surveys)
            if not self._budget.allows(0):
                break
        self._progress.clear()
        assert model is not None, "there is a size to look at"
        for verdict in verdicts.values():
            full.update(verdict.full)
        for found in surveys:
            full.update(found.full)
        left = len(every) - len(looked)
        fair = any(is_about_ends(each.property) for each in verdicts.values())
        told = tuple(diagnostics.conditions(model, sorted(full), fair=fair))
        self._found = Results(
            subject.name,
            tuple(whole(subject, counts) for counts in looked),
            told,
            tuple(verdicts.values()),
            self._findings,
            self._written,
            tuple(bounds(subject, self._request.sizes)),
            model.environment.faults,
            tuple(diagnostics.open_findings(surveys, model.environment.faults)),
            self._worst_at if len(looked) > 1 and not bounds(subject, self._request.sizes) else {},
        )
        scenario = self._scenario or Scenario()
        search = Search(
            tuple(surveys),
            left,
            has_places=has_places(scenario.world, subject, scenario),
            interrupted=self._budget.interrupted,
        )
        for line in summary(subject, self._found, search):
            self._say(line)
        self._write_tests()

    def _size(
        self,
        model: Model,
        counts: dict[str, int],
        properties: Sequence[ir.Property],
        verdicts: dict[str, Verdict],
        surveys: list[Survey],
    ) -> None:
        """Look at a swarm with given numbers of members."""
        size = shown(model.subject, [counts])
        fields = model.demands.fields
        prove_it = self._prover(model, counts, properties)
        if not self._request.properties:
            found = survey(model, self._budget)
            surveys.append(found)
            for finding in found.findings:
                if all(each.about != finding.about for each in self._findings.values()):
                    self._tell(finding, model, counts, size, fields)
        for property_ in properties:
            known = verdicts.get(property_.name)
            if known is not None and known.outcome == "fails":
                continue
            if self._budget.is_over():
                verdict = Verdict(property_, "unknown", reason=at_limit(self._budget))
            else:
                verdict = prove_it(property_)
            if known is None or worst((verdict, known)) is verdict:
                verdicts[property_.name] = verdict
                self._worst_at[property_.name] = whole(model.subject, counts)
            self._write(property_.name, verdict.run)
            of = {**counts, **(verdict.size or {})}
            if verdict.outcome == "fails" and verdict.run is not None:
                self._save(shown_by_verdict(verdict, verdict.run, of), model)
            diagnostics.report_verdict(verdict, shown(model.subject, [of]), fields, self._report)

    def _tell(
        self, finding: Finding, model: Model, counts: Mapping[str, int], size: str, fields: Fields
    ) -> None:
        name = fresh(finding.title, self._findings, gap="-")
        self._findings[name] = finding
        self._write(name, finding.run)
        if finding.run is not None:
            self._save(shown_by_finding(finding, finding.run, counts), model)
        diagnostics.report_finding(finding, size, fields, self._report)

    def _prover(
        self, model: Model, counts: Mapping[str, int], properties: Sequence[ir.Property]
    ) -> Callable[[ir.Property], Verdict]:
        """Return what proves a property, for every number of members of some roles if asked for."""
        free = bounds(model.subject, self._request.sizes)
        if not free:
            return lambda property_: prove(property_, model, self._budget)
        models = {_key(counts): model}

        def sized(wanted: Mapping[str, int]) -> Model:
            key = _key(wanted)
            if key not in models:
                made = self._model(model.subject, wanted, properties)
                assert made is not None, "params have values whatever the number of robots"
                models[key] = made
            return models[key]

        large = {**counts, **enough(free, self._request.faults or 0)}
        return lambda property_: prove_any(
            property_,
            sized(large),
            free,
            self._budget,
            lambda wanted: prove(property_, sized({**counts, **wanted}), self._budget),
        )

    # ---- before

    def _model(
        self, subject: Subject, counts: Mapping[str, int], properties: Sequence[ir.Property]
    ) -> Model | None:
        """Return the automata of a swarm; None if that is reported to be impossible."""
        asked = self._request
        options = Options(
            asked.capacity,
            asked.lossy,
            asked.faults,
            asked.silent,
            self._scenario,
            exact=asked.exact,
        )
        report = Diagnostics()
        made = Model(subject, counts, properties, options, self._budget, report)
        self._report.include(report)
        return None if report.has_errors else made

    def subject(self) -> Subject | None:
        """Compile the model, and choose what to verify."""
        models = list(self._request.paths)
        settings = find_settings(models, self._report)
        if self._report.has_errors:
            return None
        self._models = models or list(settings.sources)
        checked = pipeline.check(self._models, settings)
        self._report.include(checked.report)
        if self._report.has_errors or checked.system is None:
            return None
        asked = self._request
        return choose(
            checked.system, [], asked.machine, asked.swarm, self._report, asked.properties
        )

    def _scenario_of(self, subject: Subject) -> Scenario | None:
        path = self._request.scenario
        return None if path is None else load_scenario(path, subject, self._report)

    def _properties(self, subject: Subject) -> list[ir.Property]:
        """Return the properties to prove."""
        chosen = self._request.properties
        return [each for each in watchable(subject) if not chosen or each.name in chosen]

    # ---- after

    def _say(self, text: str) -> None:
        self._results.write(f"{text}\n")

    def _write(self, name: str, run: Run | None) -> None:
        """Write a run as a trace."""
        folder, show = self._request.output, self._request.show
        text = "".join(f"{line}\n" for line in written(run)) if run is not None else ""
        if text and show is not None:
            show(name, text)
        if text and folder is not None and self._write_file(folder / f"{name}.jsonl", text):
            self._written[name] = folder / f"{name}.jsonl"

    def _save(self, found: Shown | Unshown, model: Model) -> None:
        """Keep what is wrong as a behaviour test."""
        if self._tests is not None:
            self._tests.add(found, model.silent)

    def _write_tests(self) -> None:
        path = self._request.saved_test
        if path is None or self._tests is None:
            return
        text = self._tests.text()
        if text and self._write_file(path, text):
            self._say(f"written: {printable(path.as_posix())}")
        for line in self._tests.left_out():
            self._say(printable(line))

    def write_files(self) -> None:
        """Write the results for programs, where they are asked for."""
        if self._request.results is not None and self._found is not None:
            self._write_file(self._request.results, as_document(self._found))
        if self._request.junit is not None:
            self._write_file(self._request.junit, junit(self._found, self._report))

    def _write_file(self, path: Path, text: str) -> bool:
        """Write a file; return False and report if that fails."""
        try:
            if path.parent != self._request.output:
                path.parent.stat()  # only the folder of the runs is made
            with Staging() as staging:
                staging.add(path, text.encode("utf-8"))
                for _ in staging.move_in_place():
                    pass
        except OSError as error:
            reason = str(error.strerror)
            self._report.report("cannot-write", path=path, reason=reason[:1].lower() + reason[1:])
            return False
        return True


def _key(counts: Mapping[str, int]) -> tuple[tuple[str, int], ...]:
    return tuple(sorted(counts.items()))
