"""SPIN, rumur and Storm on the models that targets `promela`, `murphi` and `jani` write."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from importlib.util import find_spec
from math import factorial
from pathlib import Path
from typing import NamedTuple

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.composition import subjects
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.search.explore import Graph, explore
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.ir import System

ROOT = Path(__file__).resolve().parents[2]
MOST = 20_000
"""Number of states, without symmetry, up to which a swarm is compared."""


class Found(NamedTuple):
    """Result of another checker: how many states it saw, and a violation."""

    states: int
    violated: bool


class Compared(NamedTuple):
    """Numbers of what was compared: swarms by their states, properties by their verdicts."""

    counts: int
    holds: int
    fails: int

    def __add__(self, other: object) -> Compared:
        assert isinstance(other, Compared)
        return Compared(*map(sum, zip(self, other, strict=True)))


def missing_for(*programs: str) -> str:
    """Return the programs that are not installed, as the reason for a skip, or ""."""
    missing = [each for each in programs if shutil.which(each) is None]
    return f"no {' and '.join(missing)}: `.ci/run` installs them" if missing else ""


def missing_storm() -> str:
    """Return the reason why Storm cannot run, or ""."""
    if sys.version_info < (3, 11):
        return "no stormpy: it needs Python 3.11"
    return "" if find_spec("stormpy") else "no stormpy: `make .venv/.storm` installs it"


def spin(model: Path, folder: Path) -> Found:
    """Look at all states of a file of target `promela`, breadth first and without reduction."""
    _run(["spin", "-a", str(model)], folder)
    # Most of the time of a small search is the compiler's; tcc takes a thirtieth of that of gcc.
    compiler = "tcc" if shutil.which("tcc") else "gcc"
    _run([compiler, "-w", "-DBFS", "-DNOREDUCE", "-DSAFETY", "-o", "pan", "pan.c"], folder)
    # Room for 65,536 states, and more if there are: to make it takes as long as a small search.
    told = _run(["./pan", "-w16"], folder)
    errors = _number(r"errors: (\d+)", told)
    assert errors or "Search not completed" not in told, told
    return Found(_number(r"(\d+) states, stored", told), errors > 0)


def rumur(model: Path, folder: Path) -> Found:
    """Look at all states of a file of target `murphi`, with all orders of equal robots as one."""
    options = ["--deadlock-detection", "off", "--symmetry-reduction", "exhaustive"]
    # Without the trace, there is less to compile.
    options += ["--counterexample-trace", "off", "--threads", "1"]
    _run(["rumur", *options, "--output", "rumur.c", str(model)], folder)
    build = ["gcc", "-std=c11", "-O0", "-w", "-mcx16", "-o", "rumur", "rumur.c", "-lpthread"]
    _run(build, folder)
    told = _run(["./rumur"], folder, fails=True)
    violated = "No error found" not in told
    assert not violated or "error(s) found" in told, told
    # Lines before the last one tell how many states there are so far.
    return Found(_number(r"(\d+) states, \d+ rules", told), violated)


def storm(models: Sequence[Path]) -> list[Found]:
    """Look at all states of files of target `jani`, in one process."""
    names = [str(model.resolve()) for model in models]
    lines = _run([sys.executable, "-m", "tests.agreement.storm", *names], ROOT).splitlines()
    return [Found(states, not holds) for states, holds in map(json.loads, lines)]


def check(target: str, models: Sequence[Path], folder: Path) -> list[Found]:
    """Look at all states of files of a target with its checker, in a folder to work in."""
    match target:
        case "promela":
            return [spin(model, folder) for model in models]
        case "murphi":
            return [rumur(model, folder) for model in models]
    return storm(models)


class Case(NamedTuple):
    """A model to compare, with numbers of members and conditions.

    Swarms are compared if they have fewer than `most` states, with equal robots told apart.
    """

    source: Path
    counts: Mapping[str, int] = {}
    options: Options = Options()
    most: int = MOST


def compare(cases: Sequence[Case], target: str, folder: Path) -> Compared:
    """Compare numbers of states and verdicts on models with those of the checker of a target.

    rumur counts states that differ in the order of equal robots once, SPIN and Storm each of them.
    All files of the target are checked together: to start Storm takes longer than to use it.
    """
    parts = [
        part for n, case in enumerate(cases) for part in _parts(case, target, folder / f"out{n}")
    ]
    every = [model for part in parts for model in part.models]
    found = dict(zip(every, check(target, every, folder), strict=True))
    return sum((part.compare(found) for part in parts), Compared(0, 0, 0))


@dataclass(frozen=True)
class _Part:
    """A swarm, or a machine alone, and the files that a target writes of it.

    The checker of the target must see so many `states` in the first file; `watching` are the files
    for each property.
    """

    model: Model
    states: int
    alone: Path
    watching: Mapping[str, Sequence[Path]]

    @property
    def models(self) -> list[Path]:
        """All files."""
        return [self.alone, *(file for made in self.watching.values() for file in made)]

    def compare(self, found: Mapping[Path, Found]) -> Compared:
        """Compare the states, and the verdicts on all properties."""
        subject = self.model.subject
        assert found[self.alone] == Found(self.states, violated=False), subject.name
        total = Compared(1, 0, 0)
        for property_ in watchable(subject):
            made = self.watching[property_.name]
            if made:
                violated = any(found[each].violated for each in made)
                total += _same(prove(property_, self.model, Budget(Limits())), violated)
        return total


def _parts(case: Case, target: str, out: Path) -> Iterator[_Part]:
    """Yield what can be compared of a model: what has not too many states."""
    files = _build(case, target, out)
    for subject in subjects(_system(case.source)):
        mine = {name: number for name, number in case.counts.items() if subject.swarm is not None}
        budget, report, options = Budget(Limits()), Diagnostics(), case.options
        model = Model(subject, mine, watchable(subject), options, budget, report)
        if report.has_errors or not model.complete:
            continue
        network = Network(
            model.groups(thorough=True), model.alphabet, options.capacity, lossy=options.lossy
        )
        graph = explore(network, Budget(Limits(states=case.most)))
        every = sum(_alike(graph)) if graph.complete else case.most
        if every >= case.most:
            continue
        suffix = next(iter(files)).suffix if files else ""
        yield _Part(
            model,
            len(graph.seen) if target == "murphi" else every,
            out / target / f"{subject.name}{suffix}",
            {
                each.name: [f for f in files if _is_of(f, f"{subject.name}_{each.name}")]
                for each in watchable(subject)
            },
        )


MISSING: Mapping[str, str] = {
    "promela": missing_for("spin", "gcc"),
    "murphi": missing_for("rumur", "gcc"),
    "jani": missing_storm(),
}
"""Targets, with the reasons why their checkers cannot run, or ""."""


def _same(verdict: Verdict, violated: bool) -> Compared:
    """Check that a verdict is that of another checker, which knows neither times nor orders."""
    match verdict.outcome:
        case "holds":
            assert not violated, verdict
        case "fails":
            assert violated, verdict
        case "unknown":
            assert violated or "is impossible" not in verdict.reason, verdict
    return Compared(0, verdict.outcome == "holds", verdict.outcome == "fails")


def _is_of(path: Path, name: str) -> bool:
    return re.fullmatch(rf"{name}(_\w+_\d+)?", path.stem) is not None


def _alike(graph: Graph) -> Iterator[int]:
    """Yield for each state how many there are that differ in the order of equal robots."""
    network = graph.network
    orders = 1
    for group in network.groups:
        orders *= factorial(len(group.robots))
    for state in graph.seen:
        alike = orders
        for _, count in network.present(state):
            alike //= factorial(count)
        yield alike


def _system(source: Path) -> System:
    checked = pipeline.check([source], find_settings([source], Diagnostics()))
    assert checked.system is not None, [each.message for each in checked.report]
    return checked.system


def _build(case: Case, target: str, out: Path) -> list[Path]:
    texts = {
        "size": ", ".join(f"{role}={number}" for role, number in case.counts.items()),
        "channel": str(case.options.capacity),
        "lossy": str(case.options.lossy).lower(),
    }
    pipeline.build([case.source], [Request(target, texts)], out)
    return sorted(path for path in (out / target).glob("*") if path.is_file())


def _run(command: list[str], folder: Path, *, fails: bool = False) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 or fails, done.stdout + done.stderr
    return done.stdout


def _number(pattern: str, text: str) -> int:
    found = re.search(pattern, text)
    assert found is not None, text
    return int(found[1])
