"""The table of how far the engines agree, printed for `--agreement`."""

from __future__ import annotations

import faulthandler
from collections.abc import Callable, Iterator

import pytest

from .engines import ENGINES


@pytest.fixture(autouse=True)
def _an_end() -> Iterator[None]:
    """End the tests, with a traceback, if an engine goes round for ever where ours does not."""
    faulthandler.dump_traceback_later(300, exit=True)
    yield
    faulthandler.cancel_dump_traceback_later()


@pytest.fixture
def agree(record_property: Callable[[str, object], None]) -> Callable[[str, str, int, int], None]:
    """Notes for the table on how many of some scripts an engine agrees about a machine."""

    def agree(machine: str, engine: str, scripts: int, same: int) -> None:
        record_property("agreement", (machine, engine, scripts, same))

    return agree


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    rows: dict[str, dict[str, tuple[int, int]]] = {}
    for outcome in ("passed", "xfailed", "failed"):
        for report in terminalreporter.getreports(outcome):
            for name, value in report.user_properties if report.when == "call" else ():
                if name == "agreement":
                    machine, engine, scripts, same = value
                    rows.setdefault(machine, {})[engine] = (scripts, same)
    if not rows or not terminalreporter.config.getoption("--agreement"):
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
