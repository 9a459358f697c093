"""Measure processes and functions in turns; format results as Markdown tables."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from time import perf_counter

# Compile modules once, not in each process, as in normal use.
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"
}


@dataclass(frozen=True)
class Cost:
    """CPU and wall-clock seconds, and peak memory in bytes, of a process.

    The memory is at least that of the parent process.
    """

    cpu: float
    wall: float
    memory: int
    output: str


class FailedError(Exception):
    """A measured program failed; the message is its output."""


def process(command: Sequence[str], *codes: int) -> Cost:
    """Run a program to its end. Raises FailedError unless its exit code is 0 or one of some."""
    start = perf_counter()
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        env=ENVIRONMENT,
    ) as running:
        assert running.stdout is not None
        output = running.stdout.read()
        _, status, used = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
    wall = perf_counter() - start
    if running.returncode not in (0, *codes):
        raise FailedError(f"{' '.join(command)}\n{output}")
    return Cost(used.ru_utime + used.ru_stime, wall, used.ru_maxrss * 1024, output)


def interleaved(
    runs: Mapping[str, Callable[[], float]], rounds: int, warm_up: int = 0
) -> dict[str, list[float]]:
    """Return the results of each action in each round.

    The actions take turns, so that a slow phase of the machine affects all of them.
    """
    found: dict[str, list[float]] = {name: [] for name in runs}
    for number in range(-warm_up, rounds):
        for name, run in runs.items():
            value = run()
            if number >= 0:
                found[name].append(value)
    return found


def spread(values: Sequence[float], form: str = "{:.0f}", scale: float = 1) -> str:
    """Format minimum, median and maximum."""
    three = (min(values), median(values), max(values))
    return " / ".join(form.format(value * scale) for value in three)


@dataclass
class Section:
    """Results of a group: a table, sentences before and after it, and sections that follow."""

    intro: str
    header: Sequence[str]
    rows: list[Sequence[str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    more: list[Section] = field(default_factory=list)

    def goal(
        self, what: str, value: float, limit: float, form: str, *, least: bool = False
    ) -> None:
        """Note if a goal is reached: at most `limit`, or at least `limit`."""
        reached = value >= limit if least else value <= limit
        bound = f"at {'least' if least else 'most'} {form.format(limit)}"
        verdict = "reached" if reached else "**missed**"
        self.notes.append(f"{what}: {form.format(value)}; goal {bound}, {verdict}")

    def markdown(self) -> str:
        """Return the section as Markdown."""
        lines = [self.intro, ""]
        if self.rows:
            lines += [_row(self.header), _row(["---"] + ["--:"] * (len(self.header) - 1))]
            lines += [_row(row) for row in self.rows] + [""]
        lines += [f"- {note}" for note in self.notes]
        text = "\n".join(lines).rstrip() + "\n"
        return "\n".join([text, *(section.markdown() for section in self.more)])


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
