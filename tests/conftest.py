"""Fixtures of all tests: `--bless`, the examples, models from text, `swarmc` in a folder."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from swarmdsl.analysis.resolve.linker import link
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.project.loader import Project, load

from .absent import absent
from .children import pytest_timeout_set_timer, restore_interrupts
from .scheduling import (
    pytest_collection_finish,
    pytest_collection_modifyitems,
    pytest_xdist_make_scheduler,
)

__all__ = [  # hooks
    "pytest_collection_finish",
    "pytest_collection_modifyitems",
    "pytest_timeout_set_timer",
    "pytest_xdist_make_scheduler",
]

ROOT = Path(__file__).resolve().parents[1]
# What targets make has tests of its own, which are for ROS.
collect_ignore = ["golden", "skeleton/golden"]

restore_interrupts()

# What is made by chance is the same in each run; `--hypothesis-profile chance` makes others.
settings.register_profile(
    "chance", database=None, deadline=None, suppress_health_check=list(HealthCheck)
)
settings.register_profile("same", settings.get_profile("chance"), derandomize=True)
settings.load_profile("same")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--bless",
        action="store_true",
        help="take today's output as what the golden tests expect",
    )
    parser.addoption(
        "--thorough",
        action="store_true",
        help="run the tests too that show for more models what others show for some",
    )
    parser.addoption(
        "--agreement",
        action="store_true",
        help="print how far the engines of state machines agree, machine by machine",
    )
    parser.addoption(
        "--swarms", type=int, default=1, help="how many random swarms other model checkers look at"
    )
    parser.addoption(
        "--proofs", type=int, default=0, help="how many more random swarms are played in all ways"
    )
    parser.addoption(
        "--mutants", type=int, default=200, help="how many models with random mistakes are checked"
    )
    parser.addoption(
        "--cases",
        type=int,
        default=150,
        help="how many commands run with odd files, documents with mistakes, and any arguments",
    )


@pytest.fixture
def bless(request: pytest.FixtureRequest) -> bool:
    """Return True if golden files are to be rewritten instead of compared."""
    return bool(request.config.getoption("--bless"))


@pytest.fixture(scope="session")
def examples() -> Path:
    return ROOT / "examples"


@pytest.fixture
def compiled(tmp_path: Path) -> Callable[[str], System]:
    """Compile the text of a valid model."""

    def compile_text(text: str) -> System:
        path = tmp_path / "model.swarm"
        path.write_text(text, encoding="utf-8")
        result = pipeline.check([path])
        assert result.system is not None, [found.message for found in result.report]
        return result.system

    return compile_text


@pytest.fixture
def linked(tmp_path: Path) -> Callable[..., Project]:
    """Link files that are given as texts: the first one, and what it imports by name."""

    def link_texts(main: str, **others: str) -> Project:
        for name, text in {"main": main, **others}.items():
            (tmp_path / f"{name}.swarm").write_text(text, encoding="utf-8")
        report = Diagnostics()
        project = load([tmp_path / "main.swarm"], report)
        link(project, report)
        assert [found.message for found in report] == []
        return project

    return link_texts


@dataclass
class Ran:
    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def swarmc(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Ran]:
    """Run a command line in that folder, in this process."""

    def swarmc(*arguments: object) -> Ran:
        code = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Ran(code, captured.out, captured.err)

    return swarmc


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print which tests did not run, and what the tests with random mistakes have seen."""
    skipped = [report.longrepr for report in terminalreporter.getreports("skipped")]
    # The file, the line and the reason.
    told = absent(str(each[2]) for each in skipped if isinstance(each, tuple))
    if told is not None:
        terminalreporter.write_line(told)
    reports = terminalreporter.getreports("passed")
    figures = [dict(report.user_properties) for report in reports if report.when == "call"]
    for each in figures:
        if "figure" in each:
            terminalreporter.write_line(str(each["figure"]))
    figures = [each for each in figures if "mutants" in each]
    if figures:
        checked = sum(each["mutants"] for each in figures)
        wrong = sum(each["wrong"] for each in figures)
        slowest = max(each["slowest"] for each in figures)
        files, unprintable, formatted = (
            sum(each[name] for each in figures) for name in ("files", "unprintable", "formatted")
        )
        terminalreporter.write_line(
            f"{checked} mutants, none crashed: {wrong} rejected with a diagnostic, "
            f"the slowest in {slowest:.2f} s; {formatted} formatted; {checked - wrong} emitted "
            f"as {files} files, {checked - wrong - unprintable} of them printed"
        )
