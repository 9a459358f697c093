"""Share of seeded mistakes that `swarmc verify` finds: `python -m tests.verify.seeded`.

Usage: `python -m tests.verify.seeded [WALKS] [EXAMPLE...]`

Random walks decide which mutants of an example do anything else than it does; of these, `swarmc
verify` shall report as many as it can, without options or with the scenarios that the page of the
example verifies it with. A walk knows how functions end, which nobody can see. So the
share is also shown of those mutants that an observer can convict: they have a run that the original
has not. The others only leave out some of its runs. All processors judge mutants. Ctrl-C ends it
with the figures so far.
"""

from __future__ import annotations

import io
import json
import multiprocessing
import os
import re
import signal
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from contextlib import redirect_stderr, redirect_stdout
from functools import lru_cache, partial
from multiprocessing.pool import Pool
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic
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
_NAME = re.compile(r"`\w+`")
"""Name of the property in a message that it does not hold."""
_COMMAND = re.compile(
    r"^\$ swarmc verify .*--scenario (?P<scenario>\S+)(?P<more>.*)$", re.MULTILINE
)
"""A command of a page, with what follows its scenario."""
_LIMIT = "60k"
"""Limit of states for a mutant."""

Report = tuple[str, str]
"""Code and message of a diagnostic."""
Options = tuple[str, ...]
"""More words for `swarmc verify`."""
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


class Known(NamedTuple):
    """Behaviour of an original in its walks, and what `swarmc verify` reports with each options."""

    walks: Sequence[Walk]
    alarms: Mapping[Options, AbstractSet[Report]]


class Original:
    """A swarm of an example, whose mutants are judged."""

    def __init__(self, folder: Path, swarm: str) -> None:
        self.folder = folder
        self.system = system_of(folder)
        self.swarm = _swarm(self.system, swarm)
        self._views = Views(self.system, self.swarm)
        self._around = Surroundings(self.system, self.swarm)

    def mutants(self) -> list[Mutant]:
        """Return the mutants of the machines of the swarm."""
        return [m for m in mutants(self.system, self.folder) if m.machine in self._machines()]

    def walk(self, seed: int) -> Walk:
        """Let the swarm walk."""
        return walk(self.system, self.swarm, self._around, seed)

    def judge(self, mutant: Mutant, folder: Path, known: Known) -> Case:
        """Let a mutant, written to a folder, walk, and verify it."""
        system = _checked(mutant.write(self.folder, folder))
        if system is None:
            return Case(mutant, "refused")
        different, wrong = self._tell_apart(system, known.walks)
        if not different:
            return Case(mutant, "same")
        new: list[str] = []
        for options, alarms in known.alarms.items():
            found_now = reports(folder, self.swarm.name, options)
            new = sorted({code for code, _ in found_now - alarms})
            if new:
                break
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

    def _tell_apart(self, system: System, walks: Sequence[Walk]) -> tuple[bool, bool]:
        """Return if a walk differs, and if one violates a property as none of the original."""
        swarm = _swarm(system, self.swarm.name)
        violated = frozenset[str]().union(*(each.violated for each in walks))
        different = False
        for seed, mine in enumerate(walks):
            other: Walk = walk(system, swarm, self._around, seed)
            different |= other.deeds != mine.deeds
            if other.violated - violated:
                return True, True
            if different and seed >= _MORE:
                break
        return different, False


def options_of(folder: Path) -> list[Options]:
    """Return no options, and those with scenarios that the page of an example verifies it with."""
    page = (folder / "README.md").read_text(encoding="utf-8")
    found: dict[Options, None] = {(): None}
    for command in _COMMAND.finditer(page):
        scenario = str(folder / Path(command["scenario"]).name)
        options = ("--scenario", scenario, *command["more"].split())
        found[options] = None
    return list(found)


def reports(folder: Path, swarm: str, options: Options = ()) -> frozenset[Report]:
    """Return what `swarmc verify` reports on a swarm of a model."""
    printed = io.StringIO()
    with redirect_stdout(printed), redirect_stderr(io.StringIO()):
        words = ["verify", str(folder), "--swarm", swarm, "--limit", _LIMIT, "--format", "json"]
        run([*words, *options])
    lines = map(json.loads, printed.getvalue().splitlines())
    return frozenset(
        (each["code"], each["message"]) for each in lines if each["severity"] != "note"
    )


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
    # A process of its own for each, not a copy: threads of this one could hold locks.
    processes = multiprocessing.get_context("spawn").Pool(_processors(), _leave_interrupts)
    with processes as pool:
        for name in names:
            for swarm in system_of(EXAMPLES / name).swarms:
                total += _judged(pool, name, swarm.name, number)
                if total["left"]:
                    break
            if total["left"]:
                break
    _say(f"\nmutants that {number:,} random walks tell from the original: {_summary(total)}")
    _say(
        f"reported about the examples themselves: {total['alarms']},"
        f" {total['named alarms']} of them explained in their READMEs"
    )


def _judged(pool: Pool, example: str, swarm: str, number: int) -> Counter[str]:
    """Judge the mutants of a swarm, until it is interrupted; return how many are of each kind."""
    begun = monotonic()
    folder, about = EXAMPLES / example, f"{example} {swarm}"
    count: Counter[str] = Counter()
    original = Original(folder, swarm)
    every = original.mutants()
    try:
        alarms = {
            options: pool.apply_async(reports, (folder, swarm, options))
            for options in options_of(folder)
        }
        walks = tuple(pool.imap(partial(_walk, folder, swarm), range(number), chunksize=20))
        known = Known(walks, {options: each.get() for options, each in alarms.items()})
        _tell_alarms(count, frozenset().union(*known.alarms.values()), folder, about)
        judge = partial(_judge, folder, swarm, known)
        for mutant, case in zip(every, pool.imap(judge, range(len(every))), strict=True):
            _count(count, case)
            if case.fate == "missed":
                wrong = ", though a walk violates a property" if case.wrong else ""
                less = "" if case.more else " (only leaves out runs)"
                _say(f"{about}: missed {mutant}{less}{wrong}")
    except KeyboardInterrupt:
        count["left"] = len(every) - sum(count[fate] for fate in get_args(Fate))
    _say(f"{about}: {_summary(count)}; in {monotonic() - begun:.0f} s")
    return count


def _tell_alarms(
    count: Counter[str], alarms: AbstractSet[Report], folder: Path, about: str
) -> None:
    """Print what is reported of an example, and if its page names the property that fails."""
    page = (folder / "README.md").read_text(encoding="utf-8")
    for code, message in sorted(alarms):
        name = _NAME.search(message)
        is_named = name is not None and name[0] in page
        count["alarms"] += 1
        count["named alarms"] += is_named
        named = ", as its README says" if is_named else ""
        _say(f"{about}: of the example itself, {code}: {message}{named}")


def _count(count: Counter[str], case: Case) -> None:
    found = case.fate != "missed"
    count[case.fate] += 1
    count["wrong"] += case.wrong
    count["wrong and found"] += case.wrong and found
    count["more"] += case.more
    count["more and found"] += case.more and found


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _leave_interrupts() -> None:
    """Leave Ctrl-C to the process that prints the figures."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@lru_cache(maxsize=1)
def _original(folder: Path, swarm: str) -> Original:
    return Original(folder, swarm)


def _walk(folder: Path, swarm: str, seed: int) -> Walk:
    return _original(folder, swarm).walk(seed)


def _judge(folder: Path, swarm: str, known: Known, number: int) -> Case:
    original = _original(folder, swarm)
    with TemporaryDirectory() as temporary:
        return original.judge(original.mutants()[number], Path(temporary) / "mutant", known)


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
