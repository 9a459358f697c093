"""Measure the parser and comparable parsers."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import inputs
import peers
import workspace
from measure import Section, interleaved, process, spread

SIZES = {1_000: 7, 10_000: 5, 100_000: 3}
"""Number of rounds by number of lines of a file."""
LARGEST = max(SIZES)

ONCE = str(Path(__file__).with_name("parse_once.py"))


@dataclass(frozen=True)
class Contender:
    """Parser as a program that prints seconds; `peer` is the package that it needs."""

    name: str
    suffix: str
    command: tuple[str, ...]
    peer: str | None = None


def _python(name: str, suffix: str = "swarm", peer: str | None = None) -> Contender:
    return Contender(name, suffix, (sys.executable, ONCE, name), peer)


def _node(name: str, suffix: str, peer: str, script: str, *more: str) -> Contender:
    files = [str(peers.FOLDER / file) for file in (script, *more)]
    return Contender(name, suffix, ("node", *files), peer)


OURS = _python("swarmdsl")
PROTOC = _python("protoc", "proto", "grpcio-tools")
CONTENDERS = (
    OURS,
    _python("textX", peer="textX"),
    _python("Lark", peer="lark"),
    _node("Langium", "swarm", "langium", "langium.mjs", "swarm.langium"),
    PROTOC,
    _node("TypeSpec", "tsp", "@typespec/compiler", "typespec.mjs"),
    _python("sqlglot", "sql", "sqlglot"),
    _python("CPython", "py"),
)


def section(folder: Path) -> Section:
    """Parse files of each size."""
    present, absent = peers.divide(CONTENDERS)
    files = {
        (suffix, lines): _write(folder, suffix, lines)
        for suffix in {each.suffix for each in present}
        for lines in SIZES
    }
    warm_up = min(SIZES)
    times: dict[int, dict[str, list[float]]] = {}
    memory: dict[str, int] = {}

    def run(contender: Contender, lines: int) -> float:
        first, file = files[contender.suffix, warm_up], files[contender.suffix, lines]
        cost = process([*contender.command, str(first), str(file)])
        memory[contender.name] = max(memory.get(contender.name, 0), cost.memory)
        return float(cost.output.split()[-1])

    for lines, rounds in SIZES.items():
        runs = {each.name: lambda each=each, lines=lines: run(each, lines) for each in present}
        times[lines] = interleaved(runs, rounds)

    found = Section(
        "Thousands of lines a second of CPU time (minimum / median / maximum), and the peak memory "
        "of the process with the largest file. All parsers are warm: each parsed a file of "
        f"{warm_up:,} lines five times before. Lines of different languages differ in content, so "
        "only orders of magnitude compare.",
        ["parser", *(f"{lines:,} lines" for lines in SIZES), "relative time", "MB"],
    )
    for each in present:
        speeds = [
            spread([lines / time for time in times[lines][each.name]], "{:.1f}", 1e-3)
            for lines in SIZES
        ]
        ratio = f"{_ratio(times[LARGEST], each.name):.1f}"
        size = f"{memory[each.name] / 1e6:.0f}"
        found.rows.append([peers.title(each.name, each.peer), *speeds, ratio, size])
    for name, least in (("textX", 20.0), ("Langium", 3.0)):
        if name in times[LARGEST]:
            ratio = _ratio(times[LARGEST], name)
            what = f"speed relative to {name} on {LARGEST:,} lines"
            found.goal(what, ratio, least, "{:.1f}", least=True)
    found.notes += absent
    return found


def _ratio(times: dict[str, list[float]], name: str) -> float:
    return median(times[name]) / median(times[OURS.name])


def _write(folder: Path, suffix: str, lines: int) -> Path:
    file = folder / str(lines) / f"bench.{suffix}"
    if suffix == "swarm":
        workspace.write_file(file, lines)
    else:
        file.parent.mkdir(exist_ok=True)
        file.write_text(inputs.WRITERS[suffix](lines), encoding="utf-8")
    return file
