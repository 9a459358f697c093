"""Measure the response times of language servers.

Time is the CPU time of the threads of the server from a message to its answer.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from statistics import median, quantiles
from time import perf_counter

import peers
import workspace
from client import Client
from measure import Section, spread

ROUNDS = 5
KEYS = 100
# For servers that take seconds for each edit.
FEW = 10
SEED = 13
LINES_OF_A_FILE = 10_000
# Times that a name of an event is deleted and typed again, over all of its letters.
EVENTS = 120
_EVENT = "swarm event "
_WORD = "moved"
_PEERS = peers.FOLDER


@dataclass(frozen=True)
class Server:
    """Language server to measure."""

    name: str
    peer: str | None
    command: Sequence[str]


OURS = Server("swarmdsl", None, [str(Path(sys.executable).with_name("swarmc")), "lsp"])
LANGIUM = Server(
    "Langium",
    "langium",
    ["node", str(_PEERS / "langium_server.mjs"), str(_PEERS / "swarm.langium"), "--stdio"],
)


def section(folder: Path) -> Section:
    """Start servers, edit a large file, and open a large workspace."""
    small, single, large = folder / "small", folder / "single", folder / "large"
    workspace.write(small, 2)
    single.mkdir()
    workspace.write_file(single / "single.swarm", LINES_OF_A_FILE)
    lines = workspace.write(large)
    present, absent = peers.divide((OURS, LANGIUM))
    found = Section(
        "CPU time in milliseconds from a message to its result (minimum / median / maximum), for "
        f"{KEYS} keystrokes in a file of {LINES_OF_A_FILE:,} lines. The server of Langium is its "
        "generic one: with the grammar used here it links no names and checks no rules.",
        ["measurement", *(peers.title(each.name, each.peer) for each in present)],
    )
    starts: dict[str, list[float]] = {each.name: [] for each in present}
    clock: dict[str, list[float]] = {each.name: [] for each in present}
    for _ in range(ROUNDS):
        for each in present:
            cpu, seconds = _start(each, small)
            starts[each.name].append(cpu)
            clock[each.name].append(seconds)
    file = single / "single.swarm"
    typed = {each.name: _typed(each, file, KEYS if each is OURS else FEW) for each in present}
    peaks = {each.name: _peak(each, large) for each in present if each is OURS}
    renamed = _renamed(OURS, file)

    def row(what: str, value: Callable[[Server], str]) -> None:
        found.rows.append([what, *(value(each) for each in present)])

    row("start to diagnostics of 300 lines", lambda each: _figures(starts[each.name]))
    row("the same, wall clock", lambda each: _figures(clock[each.name]))
    row("keystroke to diagnostics", lambda each: _figures(typed[each.name].keys))
    row("completion", lambda each: _figures(typed[each.name].completions))
    row("hover", lambda each: _figures(typed[each.name].hovers))
    row(
        f"a letter of the name of an event that many machines use, {len(renamed.keys)} edits",
        lambda each: _figures(renamed.keys) if each is OURS else "",
    )
    row(
        "the same, those of them that bind or lose the events",
        lambda each: _figures(renamed.binding) if each is OURS else "",
    )
    row(
        "peak memory after these edits, MB",
        lambda each: f"{renamed.memory / 1e6:.0f}" if each is OURS else "",
    )
    row(
        f"peak memory with {lines:,} lines, MB",
        lambda each: f"{peaks[each.name] / 1e6:.0f}" if each.name in peaks else "",
    )
    ours = typed[OURS.name]
    slow = "95th percentile"
    found.goal("start to diagnostics, in ms", median(starts[OURS.name]) * 1e3, 400, "{:.0f}")
    found.goal(f"keystroke to diagnostics, in ms, {slow}", _high(ours.keys) * 1e3, 50, "{:.1f}")
    found.goal(f"completion, in ms, {slow}", _high(ours.completions) * 1e3, 30, "{:.1f}")
    found.goal(f"hover, in ms, {slow}", _high(ours.hovers) * 1e3, 30, "{:.1f}")
    found.goal("peak memory, in MB", peaks[OURS.name] / 1e6, 150, "{:.0f}")
    found.goal("a letter of the name of an event, in ms", median(renamed.keys) * 1e3, 150, "{:.0f}")
    found.goal("an edit that binds the events, in ms", median(renamed.binding) * 1e3, 150, "{:.0f}")
    found.goal("peak memory after these edits, in MB", renamed.memory / 1e6, 300, "{:.0f}")
    found.notes += absent
    return found


def _start(server: Server, folder: Path) -> tuple[float, float]:
    """Return CPU and wall-clock seconds from the start to the first diagnostics."""
    file = folder / "area0.swarm"
    client = Client(server.command, folder)
    client.open(file, f"{file.read_text(encoding='utf-8')}\nwrong\n")
    seconds, cpu = perf_counter() - client.started, client.cpu
    client.close()
    return cpu, seconds


@dataclass
class Typed:
    """CPU seconds of several actions."""

    keys: list[float]
    completions: list[float]
    hovers: list[float]


def _typed(server: Server, file: Path, count: int) -> Typed:
    """Type a word that is no declaration in many places, and delete it again."""
    text = file.read_text(encoding="utf-8")
    rows = text.split("\n")
    client = Client(server.command, file.parent)
    client.open(file, text)
    dice = Random(SEED)
    blank = [line for line, row in enumerate(rows) if not row]
    keys: list[float] = []
    version = 1
    while len(keys) < count:
        line = dice.choice(blank)
        for index, letter in enumerate([*_WORD, *_WORD]):
            typing = index < len(_WORD)
            place = index if typing else 2 * len(_WORD) - index - 1
            version += 1
            start = client.cpu
            client.type(file, version, line, place, letter if typing else "")
            client.wait_for_diagnostics(file)
            keys.append(client.cpu - start)
    actions = {}
    for name in ("completion", "hover"):
        actions[name] = [
            _asked(client, file, f"textDocument/{name}", *_place(rows, dice)) for _ in range(count)
        ]
    client.close()
    return Typed(keys, actions["completion"], actions["hover"])


@dataclass
class Renamed:
    """CPU seconds of edits of names of events, and the peak memory after them, in bytes.

    `binding` are the edits after which machines that used an event find none, or find it again.
    """

    keys: list[float]
    binding: list[float]
    memory: int


def _renamed(server: Server, file: Path) -> Renamed:
    """Delete the names of events letter by letter, and type them again."""
    text = file.read_text(encoding="utf-8")
    rows = text.split("\n")
    client = Client(server.command, file.parent)
    client.open(file, text)
    places = [(line, row) for line, row in enumerate(rows) if row.startswith(_EVENT)]
    found = Renamed([], [], 0)
    version = 1
    while len(found.keys) < 2 * EVENTS:
        for line, row in places:
            start, end = len(_EVENT), len(_EVENT) + len(row[len(_EVENT) :].split()[0])
            # The first letter stays: a declaration without a name is a syntax error.
            deleted = [(at, "") for at in range(end - 1, start, -1)]
            typed = [(at, row[at]) for at in range(start + 1, end)]
            for at, letter in (*deleted, *typed):
                version += 1
                before = client.cpu
                client.type(file, version, line, at, letter)
                client.wait_for_diagnostics(file)
                found.keys.append(client.cpu - before)
                if at == end - 1:
                    found.binding.append(found.keys[-1])
    found.memory = client.memory
    client.close()
    return found


def _place(rows: Sequence[str], dice: Random) -> tuple[int, int]:
    """Return a position in a non-empty line."""
    while not rows[line := dice.randrange(len(rows))].strip():
        pass
    return line, dice.randrange(len(rows[line]))


def _asked(client: Client, file: Path, method: str, line: int, character: int) -> float:
    start = client.cpu
    place = {"line": line, "character": character}
    client.ask(method, {"textDocument": {"uri": file.as_uri()}, "position": place})
    return client.cpu - start


def _peak(server: Server, folder: Path) -> int:
    """Return the peak memory with a file of a large workspace open, in bytes."""
    file = folder / "area5.swarm"
    client = Client(server.command, folder)
    client.open(file, f"{file.read_text(encoding='utf-8')}\nwrong\n")
    client.ask("workspace/symbol", {"query": "area5"})
    memory = client.memory
    client.close()
    return memory


def _figures(seconds: list[float]) -> str:
    return spread(seconds, "{:.1f}", 1e3)


def _high(seconds: list[float]) -> float:
    """Return the 95th percentile."""
    return quantiles(seconds, n=20)[-1]
