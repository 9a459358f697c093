"""Tables of how far engines and model checkers agree, printed for `--agreement`."""

from __future__ import annotations

import faulthandler
from collections import defaultdict
from collections.abc import Callable, Iterator

import pytest

from .engines import ENGINES
from .witnesses import Compared

CHECKERS = {"promela": "SPIN", "murphi": "rumur", "jani": "Storm"}
"""Model checkers, by their targets."""


@pytest.fixture(autouse=True)
def _an_end(request: pytest.FixtureRequest) -> Iterator[None]:
    """End the tests, with a traceback, if an engine goes round for ever where ours does not."""
    limit = request.node.get_closest_marker("timeout")
    faulthandler.dump_traceback_later(limit.args[0] if limit is not None else 300, exit=True)
    yield
    faulthandler.cancel_dump_traceback_later()


@pytest.fixture
def agree(record_property: Callable[[str, object], None]) -> Callable[[str, str, int, int], None]:
    """Notes for the table on how many of some scripts an engine agrees about a machine."""

    def agree(machine: str, engine: str, scripts: int, same: int) -> None:
        record_property("agreement", (machine, engine, scripts, same))

    return agree


@pytest.fixture
def witnessed(
    record_property: Callable[[str, object], None],
) -> Callable[[str, str, Callable[[], Compared]], Compared]:
    """Run a comparison with the checker of a target, and note for the table what it compared."""

    def witnessed(model: str, target: str, compare: Callable[[], Compared]) -> Compared:
        record_property("begun", (model, target))
        found = compare()
        record_property("witness", (model, target, *found))
        return found

    return witnessed


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if not terminalreporter.config.getoption("--agreement"):
        return
    _print_witnesses(terminalreporter)
    rows: dict[str, dict[str, tuple[int, int]]] = {}
    for outcome in ("passed", "xfailed", "failed"):
        for report in terminalreporter.getreports(outcome):
            for name, value in report.user_properties if report.when == "call" else ():
                if name == "agreement":
                    machine, engine, scripts, same = value
                    rows.setdefault(machine, {})[engine] = (scripts, same)
    if not rows:
        return
    terminalreporter.section("scripts on which engines agree with ours")
    width = max(map(len, rows)) + 2
    terminalreporter.write_line("".ljust(width) + "".join(name.rjust(22) for name in ENGINES))
    for machine in sorted(rows, key=str.lower):
        cells = [_cell(rows[machine].get(engine)) for engine in ENGINES]
        terminalreporter.write_line(machine.ljust(width) + "".join(c.rjust(22) for c in cells))
    totals = []
    for engine in ENGINES:
        cells_ = [row[engine] for row in rows.values() if engine in row]
        totals.append(_cell((sum(c[0] for c in cells_), sum(c[1] for c in cells_))))
    terminalreporter.write_line("all".ljust(width) + "".join(c.rjust(22) for c in totals))


def _cell(numbers: tuple[int, int] | None) -> str:
    if numbers is None:
        return "-"
    scripts, same = numbers
    return str(scripts) if same == scripts else f"{same} of {scripts}"


def _print_witnesses(terminalreporter: pytest.TerminalReporter) -> None:
    begun: defaultdict[tuple[str, str], int] = defaultdict(int)
    found: defaultdict[tuple[str, str], Compared] = defaultdict(lambda: Compared(0, 0, 0))
    for outcome in ("passed", "failed"):
        for report in terminalreporter.getreports(outcome):
            for name, value in report.user_properties if report.when == "call" else ():
                if name == "begun":
                    begun[value[0], value[1]] += 1
                if name == "witness":
                    begun[value[0], value[1]] -= 1
                    found[value[0], value[1]] += Compared(*value[2:])
    if not begun:
        return
    terminalreporter.section("swarms that other model checkers see as `swarmc verify`")
    terminalreporter.write_line("swarms with as many states; properties that hold, that fail")
    models = sorted({model for model, _ in begun}, key=str.lower)
    width = max(map(len, models)) + 2
    terminalreporter.write_line("".ljust(width) + "".join(c.rjust(22) for c in CHECKERS.values()))
    for model in models:
        cells = [
            _witness(found[model, each], begun[model, each]) if (model, each) in begun else "-"
            for each in CHECKERS
        ]
        terminalreporter.write_line(model.ljust(width) + "".join(c.rjust(22) for c in cells))


def _witness(found: Compared, differing: int) -> str:
    text = f"{found.counts}; {found.holds}, {found.fails}"
    return f"{text}; differs" if differing else text
