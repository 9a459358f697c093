"""Measure a workspace of many files: a full check, and edits."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from statistics import median, quantiles

import inputs
import peers
import workspace
from measure import Section, interleaved, process, spread
from parsing import OURS, PROTOC

ROUNDS = 5
LINES_OF_A_FILE = 10_000
_SWARMC = str(Path(sys.executable).with_name("swarmc"))
_RECHECK = str(Path(__file__).with_name("recheck.py"))


def section(folder: Path) -> Section:
    """Check the workspace, edit it, and edit a large file."""
    models, protos, single = folder / "models", folder / "protos", folder / "single.swarm"
    lines = workspace.write(models)
    files = sorted(models.iterdir())
    protos.mkdir()
    for file in files:
        count = file.read_text(encoding="utf-8").count("\n")
        text = inputs.proto(count, file.stem)
        (protos / f"{file.stem}.proto").write_text(text, encoding="utf-8")
    workspace.write_file(single, LINES_OF_A_FILE)
    check = [_SWARMC, "check", str(models)]
    walls: list[float] = []
    memory: list[int] = []

    def cold() -> float:
        cost = process(check)
        walls.append(cost.wall)
        memory.append(cost.memory)
        return cost.cpu

    runs = {"check": cold}
    present, absent = peers.divide((OURS, PROTOC))
    for each in present:
        inside = protos if each is PROTOC else models
        given = sorted(map(str, inside.iterdir()))
        command = [*each.command, given[0], *given]
        runs[each.name] = lambda command=command: float(process(command).output.split()[-1])
    times = interleaved(runs, ROUNDS, warm_up=1)
    edits = json.loads(process([sys.executable, _RECHECK, str(models), str(single)]).output)

    found = Section(
        f"{len(files)} files with {lines:,} lines that import each other, in milliseconds "
        f"(minimum / median / maximum of {ROUNDS} rounds).",
        ["measurement", "CPU, ms", "wall clock, ms"],
    )
    found.rows.append(
        ["`swarmc check`", spread(times["check"], scale=1e3), spread(walls[1:], scale=1e3)]
    )
    for each in present:
        name = f"parsed by {peers.title(each.name, each.peer)}, warm"
        found.rows.append([name, spread(times[each.name], scale=1e3), ""])
    again, keys = edits["again"], edits["keys"]
    for where, seconds in (
        ("one of these files", again),
        (f"a file of {LINES_OF_A_FILE:,} lines", keys),
    ):
        found.rows.append([f"check again after a keystroke in {where}", _figures(seconds), ""])
    found.goal("a check, in seconds of wall clock", median(walls[1:]), 2, "{:.2f}")
    found.goal("its peak memory, in MB", max(memory) / 1e6, 250, "{:.0f}")
    if PROTOC in present:
        ratio = median(times["swarmdsl"]) / median(times["protoc"])
        found.goal("time to parse a line, relative to protoc", ratio, 1, "{:.2f}")
    slow = "95th percentile"
    found.goal(f"check again after a keystroke, in seconds, {slow}", _high(again), 0.3, "{:.3f}")
    found.goal(f"a keystroke in the large file, in ms, {slow}", _high(keys) * 1e3, 25, "{:.1f}")
    found.notes += absent
    return found


def _figures(seconds: list[float]) -> str:
    return spread(seconds, "{:.1f}", 1e3)


def _high(seconds: list[float]) -> float:
    """Return the 95th percentile."""
    return quantiles(seconds, n=20)[-1]
