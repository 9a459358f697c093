"""Run SCXML documents that judge themselves: each ends in state `pass` or `fail`.

The tests of the W3C (SCXML 1.0 Implementation Report Plan) in the form for ECMAScript are such
documents:

    make w3c W3C=folder

A document that is refused has a diagnostic before it runs. The exit code is 1 if one ends anywhere
but in `pass`. Documents without a state `pass` are for people to judge, or parts of others.
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance, LoopError
from swarmdsl.execution.engine.activity import Run
from swarmdsl.execution.scxml import read
from swarmdsl.execution.simulate.scenario.clock import Clock

WORDS = ("pass", "refuse", "unjudged", "wrong")
ENOUGH = 600 * 10**9
"""Virtual time of a document in nanoseconds."""


class Verdict(NamedTuple):
    """One of `WORDS`, with the codes of a refusal, or the states of a wrong end."""

    word: str
    reason: str = ""


class World(Clock):
    """World that is only a clock; errors are events of the document."""

    def start(self, run: Run) -> None:
        """Do nothing: there are no servers."""

    cancel = start

    def send(self, instance: object, event: Event) -> None:
        """Drop an event to others."""

    def failed(self, instance: object, error: Exception) -> None:
        """Ignore the error: the document gets its event."""


def judge(name: str, text: str) -> Verdict:
    """Read and run a document."""
    report = Diagnostics()
    machine = read(Source(name, text), report)
    if machine is None:
        codes = [f"{CODES[each.name].code} {each.message}" for each in report]
        return Verdict("refuse", "; ".join(dict.fromkeys(codes)))
    instance = Instance(machine, world := World())
    try:
        instance.start()
        world.advance(ENOUGH)
    except LoopError as error:
        return Verdict("wrong", str(error))
    if instance.final == "pass":
        return Verdict("pass")
    if "pass" not in machine.numbers and instance.final != "fail":
        return Verdict("unjudged")
    return Verdict("wrong", f"ends in {instance.final or instance.configuration.innermost}")


def main(folder: Path) -> int:
    """Print the verdict of each document in a folder, and the totals."""
    counts: Counter[str] = Counter()
    for path in sorted(folder.glob("*.scxml")):
        verdict = judge(path.name, path.read_text(encoding="utf-8"))
        counts[verdict.word] += 1
        sys.stdout.write(f"{path.name:<28}{verdict.word:<10}{verdict.reason}".rstrip() + "\n")
    words = [f"{counts[word]} {word}" for word in WORDS]
    sys.stdout.write(f"{counts.total()} documents: {', '.join(words)}\n")
    return 1 if counts["wrong"] or not counts else 0


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        sys.exit("make w3c W3C=folder: the folder with the test documents (*.scxml)")
    sys.exit(main(Path(sys.argv[1])))
