"""Measure proofs about whole swarms, beside SPIN and rumur."""

from __future__ import annotations

import json
import re
import shutil
import sys
from pathlib import Path
from typing import NamedTuple

from measure import Cost, Section, process

ROOT = Path(__file__).resolve().parents[1]
ONCE = Path(__file__).resolve().parent / "verify_once.py"
ROBOTS = (6, 8, 12, 16)
# More robots take them minutes, or more memory than there is.
SPIN, RUMUR = (6,), (6, 8)
SPEED, BYTES = 0.8, 100.0
"""Goals: at least so many million transitions a second, and at most so many bytes a state."""
SECONDS, APART = 6.0, 1.0
"""Goals in seconds from the text to the verdicts: 12 robots, and roles that do not speak."""
_PROPERTY = re.compile(r"^property .*\n(?:[ \t]+\S.*\n)*", re.MULTILINE)


class Search(NamedTuple):
    """Search of another program: the states that it found, and its cost."""

    states: int
    cost: Cost


def section(folder: Path) -> Section:
    """Verify swarms of some sizes, each once."""
    found = Section(
        "All states of [examples/emergency_exit](../examples/emergency_exit/README.md), without "
        "time and properties: CPU seconds of the whole command; with SPIN and rumur, also the "
        "compiler runs. They search what targets `promela` and `murphi` write of the swarm: SPIN "
        "distinguishes all robots, rumur searches with its symmetry reduction. The column *proofs* "
        "is swarmdsl with the verdicts on all properties of the example. The transitions a second "
        "and the bytes a state are those of the search alone. Each number is from one run.",
        [
            "robots",
            "states",
            "million transitions a second",
            "bytes a state",
            "swarmdsl s",
            "proofs s",
            "rumur s",
            "SPIN s",
            "states of SPIN",
        ],
    )
    model = _any_size("emergency_exit", folder, "Spiderino[8]")
    bare = _without_properties(model)
    for robots in ROBOTS:
        size = f"robot={robots}"
        states, transitions, seconds, grown = _once(model, size)
        searched, verified = _verify(bare, size), _verify(model, size)
        rumur, spin = _rumur(model, robots, folder), _spin(model, robots, folder)
        speed, each = transitions / seconds / 1e6, grown / states
        # In a small search the process hardly grows beyond what it needed before.
        is_large = states > 100_000
        found.rows.append(
            [
                str(robots),
                f"{states:,}",
                f"{speed:.2f}",
                f"{each:.0f}" if is_large else "",
                f"{searched.cpu:.2f}",
                f"{verified.cpu:.2f}",
                _seconds(rumur),
                _seconds(spin),
                f"{spin.states:,}" if spin is not None else "",
            ]
        )
        if is_large:
            found.goal(f"million transitions a second, {size}", speed, SPEED, "{:.2f}", least=True)
            found.goal(f"bytes a state, {size}", each, BYTES, "{:.0f}")
        if robots == 12:
            found.goal(f"seconds to the verdicts, {size}", verified.cpu, SECONDS, "{:.2f}")
        for name, other in (("rumur", rumur), ("SPIN", spin)):
            if other is not None:
                limit = other.cost.cpu
                found.goal(f"seconds, {size}, beside {name}", searched.cpu, limit, "{:.2f}")
        if rumur is not None and rumur.states != states:
            found.notes.append(f"**rumur counts {rumur.states:,} states, {size}**")
    rescue = _any_size("search_and_rescue", folder, "Uav[3]", "Rover[1..5]")
    apart = _verify(rescue, "uav=8", "rover=5")
    found.goal("seconds, search_and_rescue with 8 and 5 robots", apart.cpu, APART, "{:.2f}")
    exact = _verify(model, "robot=3", exact=True)
    found.notes.append(
        "emergency_exit with 3 robots and `--time exact`, where robots have clocks: "
        f"{exact.cpu:.2f} s to the verdicts"
    )
    for name in ("spin", "rumur"):
        if shutil.which(name) is None:
            found.notes.append(f"{name} was not measured: it is not installed")
    return found


def _any_size(example: str, folder: Path, *roles: str) -> Path:
    """Copy an example, with any number of members of some roles."""
    model = folder / example
    shutil.copytree(ROOT / "examples" / example, model)
    for path in model.glob("*.swarm"):
        text = path.read_text(encoding="utf-8")
        for role in roles:
            text = text.replace(role, f"{role.partition('[')[0]}[1..*]")
        path.write_text(text, encoding="utf-8")
    return model


def _without_properties(model: Path) -> Path:
    """Copy a model without its properties, which the other programs do not get."""
    bare = model.with_name(f"{model.name}_bare")
    shutil.copytree(model, bare)
    for path in bare.glob("*.swarm"):
        text = path.read_text(encoding="utf-8")
        path.write_text(_PROPERTY.sub("", text), encoding="utf-8")
    return bare


def _once(model: Path, *sizes: str) -> tuple[int, int, float, int]:
    states, transitions, seconds, grown = json.loads(
        process([sys.executable, str(ONCE), str(model), *sizes]).output
    )
    return states, transitions, seconds, grown


def _verify(model: Path, *sizes: str, exact: bool = False) -> Cost:
    options = [word for size in sizes for word in ("--size", size)]
    options += ["--time", "exact"] if exact else []
    command = [sys.executable, "-m", "swarmdsl", "verify", str(model), *options, "--limit", "10M"]
    # 1 says that a property does not hold.
    return process(command, 1)


def _seconds(search: Search | None) -> str:
    return f"{search.cost.cpu:.2f}" if search is not None else ""


def _built(model: Path, target: str, robots: int, folder: Path) -> Path:
    """Write the swarm for another program; return the folder of its file."""
    out = folder / f"{target}_{robots}"
    option = f"{target}.size=robot={robots}"
    command = ["build", str(model), "--target", target, "--option", option, "-o", str(out)]
    process([sys.executable, "-m", "swarmdsl", *command])
    return out / target


def _rumur(model: Path, robots: int, folder: Path) -> Search | None:
    """Search with rumur; None if there are too many robots, or no rumur."""
    if robots not in RUMUR or shutil.which("rumur") is None:
        return None
    written = _built(model, "murphi", robots, folder) / "Crowd.m"
    source, checker = written.with_suffix(".c"), written.with_suffix("")
    options = ["--deadlock-detection", "off", "--threads", "1", "--symmetry-reduction", "heuristic"]
    made = process(["rumur", *options, "--output", str(source), str(written)])
    compiled = process(
        [
            "cc",
            "-std=c11",
            "-O3",
            "-mcx16",
            str(source),
            "-o",
            str(checker),
            "-lpthread",
            "-latomic",
        ]
    )
    ran = process([str(checker)])
    # It also tells how far it has come.
    states = re.findall(r"(\d+) states", ran.output)
    return Search(int(states[-1]), _sum(made, compiled, ran))


def _spin(model: Path, robots: int, folder: Path) -> Search | None:
    """Search with SPIN; None if there are too many robots, or no SPIN."""
    if robots not in SPIN or shutil.which("spin") is None:
        return None
    place = _built(model, "promela", robots, folder)
    checker = place / "pan"
    made = _inside(place, ["spin", "-a", "Crowd.pml"])
    source = str(place / "pan.c")
    compiled = process(["cc", "-O3", "-DSAFETY", "-DMEMLIM=4096", source, "-o", str(checker)])
    # Robots that are safe wait for ever: that is no mistake.
    ran = _inside(place, [str(checker), "-E", "-m1000000"])
    states = re.search(r"(\d+) states, stored", ran.output)
    assert states is not None, ran.output
    return Search(int(states[1]), _sum(made, compiled, ran))


def _inside(folder: Path, command: list[str]) -> Cost:
    """Run a program in a folder, to which it writes."""
    return process(["env", "-C", str(folder), *command])


def _sum(*costs: Cost) -> Cost:
    cpu, wall = sum(each.cpu for each in costs), sum(each.wall for each in costs)
    return Cost(cpu, wall, max(each.memory for each in costs), costs[-1].output)
