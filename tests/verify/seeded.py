"""Share of seeded mistakes that `swarmc verify` finds: `python -m tests.verify.seeded`.

Usage: `python -m tests.verify.seeded [WALKS] [EXAMPLE...]`

Random walks decide which mutants of an example do anything else than it does; of these, `swarmc
verify` shall report as many as it can. A walk knows how functions end, which nobody can see. So the
share is also shown of those mutants that an observer can convict: they have a run that the original
has not. The others only leave out some of its runs. Ctrl-C ends it with the figures so far.
"""

from __future__ import annotations

import io
import json
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Literal, NamedTuple, get_args

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.ir import Swarm, System

from .mutants import Mutant, mutants
from .observable import Views, does_more
from .walks import Surroundings, Walk, walk

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
_WALKS = 1_000
_MORE = 20
"""Number of walks that look for a violation, though the first one already is different."""
_LIMIT = "60k"
"""Limit of states for a mutant."""
_INTERRUPTED = 130

Report = tuple[str, str]
"""Code and message of a diagnostic."""
Fate = Literal["refused", "same", "checked", "verified", "missed"]


class Case(NamedTuple):
    """Fate of a mutant of a swarm, with the codes that are reported about it.

    It is `refused` by the compiler, does the `same` in all walks, or else a check before the search
    or the search finds it, or nothing. It is `wrong` if a walk violates a property of the model. It
    does `more` if it has runs that an observer can tell from all of the original.
    """

    mutant: Mutant
    fate: Fate
    codes: Sequence[str] = ()
    wrong: bool = False
    more: bool = False


class Original:
    """A swarm of an example, with its walks."""

    def __init__(self, folder: Path, swarm: str, number: int) -> None:
        self.folder = folder
        self.system = system_of(folder)
        self.swarm = _swarm(self.system, swarm)
        self.alarms = reports(folder, swarm)
        self._views = Views(self.system, self.swarm)
        self._around = Surroundings(self.system, self.swarm)
        self._walks = [walk(self.system, self.swarm, self._around, n) for n in range(number)]
        self._violated = frozenset[str]().union(*(each.violated for each in self._walks))

    def mutants(self) -> list[Mutant]:
        """Return the mutants of the machines of the swarm."""
        return [m for m in mutants(self.system, self.folder) if m.machine in self._machines()]

    def judge(self, mutant: Mutant, folder: Path) -> Case:
        """Let a mutant, written to a folder, walk, and verify it."""
        system = _checked(mutant.write(self.folder, folder))
        if system is None:
            return Case(mutant, "refused")
        different, wrong = self._tell_apart(system)
        if not different:
            return Case(mutant, "same")
        new = sorted({code for code, _ in reports(folder, self.swarm.name) - self.alarms})
        found = any(code.startswith("SW17") for code in new)
        fate: Fate = "verified" if found else "checked" if new else "missed"
        more = does_more(self._views, Views(system, _swarm(system, self.swarm.name)))
        return Case(mutant, fate, new, wrong, more)

    def _machines(self) -> set[str]:
        return {
            machine.name
            for robot in self._around.subject.create_robots({})
            for _, machine in self._around.subject.behaviours(robot)
        }

    def _tell_apart(self, system: System) -> tuple[bool, bool]:
        """Return if a walk differs, and if one violates a property as none of the original."""
        swarm = _swarm(system, self.swarm.name)
        different = False
        for seed, mine in enumerate(self._walks):
            other: Walk = walk(system, swarm, self._around, seed)
            different |= other.deeds != mine.deeds
            if other.violated - self._violated:
                return True, True
            if different and seed >= _MORE:
                break
        return different, False


def reports(folder: Path, swarm: str) -> set[Report]:
    """Return what `swarmc verify` reports on a swarm of a model."""
    printed = io.StringIO()
    with redirect_stdout(printed), redirect_stderr(io.StringIO()):
        words = ["verify", str(folder), "--swarm", swarm, "--limit", _LIMIT, "--format", "json"]
        if run(words) == _INTERRUPTED:
            raise KeyboardInterrupt
    lines = map(json.loads, printed.getvalue().splitlines())
    return {(each["code"], each["message"]) for each in lines if each["severity"] != "note"}


def system_of(folder: Path) -> System:
    """Compile a model."""
    system = _checked(folder)
    assert system is not None
    return system


def _checked(folder: Path) -> System | None:
    return pipeline.check([folder], find_settings([folder], Diagnostics())).system


def _swarm(system: System, name: str) -> Swarm:
    return next(each for each in system.swarms if each.name == name)


def main() -> None:
    """Judge the mutants of the examples, and print what was found."""
    words = sys.argv[1:]
    number = int(words.pop(0)) if words and words[0].isdigit() else _WALKS
    names = words or sorted(path.parent.name for path in EXAMPLES.glob("*/README.md"))
    total: Counter[str] = Counter()
    alarms = 0
    swarms = [(name, each.name) for name in names for each in system_of(EXAMPLES / name).swarms]
    for name, swarm in swarms:
        original = Original(EXAMPLES / name, swarm, number)
        alarms += len(original.alarms)
        for code, message in sorted(original.alarms):
            _say(f"{name} {swarm}: of the example itself, {code}: {message}")
        count = _judged(original, f"{name} {swarm}")
        total += count
        _say(f"{name} {swarm}: {_summary(count)}")
        if count["left"]:
            break
    _say(f"\nmutants that {number:,} random walks tell from the original: {_summary(total)}")
    _say(f"reported about the examples themselves: {alarms}")


def _judged(original: Original, about: str) -> Counter[str]:
    """Judge the mutants of a swarm, until it is interrupted; return how many are of each kind."""
    count: Counter[str] = Counter()
    every = original.mutants()
    try:
        with TemporaryDirectory() as temporary:
            for mutant in every:
                case = original.judge(mutant, Path(temporary) / "mutant")
                count[case.fate] += 1
                count["wrong"] += case.wrong
                count["wrong and found"] += case.wrong and case.fate != "missed"
                count["more"] += case.more
                count["more and found"] += case.more and case.fate != "missed"
                if case.fate == "missed":
                    wrong = ", though a walk violates a property" if case.wrong else ""
                    less = "" if case.more else " (only leaves out runs)"
                    _say(f"{about}: missed {mutant}{less}{wrong}")
    except KeyboardInterrupt:
        count["left"] = len(every) - sum(count[fate] for fate in get_args(Fate))
    return count


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def _summary(count: Counter[str]) -> str:
    found = count["verified"] + count["checked"]
    apart = found + count["missed"]
    return (
        f"{_share(found, apart)} found, {count['verified']} by the search and"
        f" {count['checked']} by checks before it; {_share(count['more and found'], count['more'])}"
        " of those with runs that an observer can tell from all of the original;"
        f" {count['wrong and found']} of {count['wrong']} whose walks violate a property;"
        f" {count['same']} do the same, {count['refused']} do not compile"
        + (f"; {count['left']} left when it was interrupted" if count["left"] else "")
    )


def _share(part: int, whole: int) -> str:
    return f"{part} of {whole}" + (f" ({part / whole:.1%})" if whole else "")


if __name__ == "__main__":
    main()
