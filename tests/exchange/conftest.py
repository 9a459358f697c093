"""Models compiled from strings, the corpus, and a third-party SCXML engine."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import pytest
from statemachine.io import load

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.codegen.exchange import scxml
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"

Event = str | tuple[str, dict[str, object]]
Compile = Callable[[str], System]
Emit = Callable[..., dict[str, str]]
Walk = Callable[[str, Iterable[Event]], list[set[str]]]

# What the machines of the tests can do and hear.
PRELUDE = """
package test
action Go { result { reached : bool, count : int32 } }
action Drive { goal { speed : float64, name : string } result { count : int32, name : string } }
service Ask { request { times : uint8 } response { answer : bool } }
message Report { id : string, level : int32 }
function go : abstraction { action "cmd/go" : Go }
function drive : abstraction { action "cmd/drive" : Drive; in "pose" : geometry_msgs/Pose }
function ask : abstraction { service "cmd/ask" : Ask }
function land : abstraction { service "cmd/land" : std_srvs/Empty }
service std_srvs/Empty { }
swarm event Start : swarmros/SimpleEvent
swarm event Abort : swarmros/SimpleEvent
swarm event Found : Report
event Low : sensor_msgs/BatteryState on "battery"
"""


@pytest.fixture(scope="session")
def corpus() -> Path:
    """Folder with files of the CPSwarm project and the SCXML schema."""
    folder = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
    if not folder.is_dir():
        pytest.skip(f"no corpus of real files at {folder} (set SWARMDSL_CORPUS)")
    return folder


@pytest.fixture
def compiled(tmp_path: Path) -> Compile:
    """Compile declarations after some functions and events that they can use."""

    def compiled(text: str) -> System:
        path = tmp_path / "model.swarm"
        path.write_text(PRELUDE + text, encoding="utf-8")
        result = pipeline.check([path])
        assert result.system is not None, [found.message for found in result.report]
        return result.system

    return compiled


@pytest.fixture(scope="session")
def search_and_rescue() -> System:
    """The example."""
    result = pipeline.check([EXAMPLES / "search_and_rescue" / "sar.swarm"])
    assert result.system is not None
    return result.system


@pytest.fixture
def emit() -> Emit:
    """Return the files of target `scxml` by name; `expected` names the diagnostics."""

    def emit(
        system: System, profile: str = "portable", expected: Sequence[str] = ()
    ) -> dict[str, str]:
        report = Diagnostics()
        files = list(scxml.emit(system, scxml.Options(profile), report))
        assert list(expected) == [found.name for found in report]
        return {file.path: file.text for file in files}

    return emit


@pytest.fixture
def findings() -> Callable[[System, str], list[Diagnostic]]:
    """Return the diagnostics of target `scxml` for a system."""

    def findings(system: System, profile: str) -> list[Diagnostic]:
        report = Diagnostics()
        list(scxml.emit(system, scxml.Options(profile), report))
        return list(report)

    return findings


@pytest.fixture
def walk() -> Walk:
    """Run a document in python-statemachine; return the active states of each step.

    That engine evaluates expressions as Python and runs in real time only: documents
    with more than plain comparisons, or with delays, cannot be walked.
    """

    def walk(document: str, events: Iterable[Event]) -> list[set[str]]:
        machine = load(document, format="scxml", trusted=True)()
        active = [{state.id for state in machine.configuration}]
        for event in events:
            name, data = event if isinstance(event, tuple) else (event, {})
            machine.send(name, **data)
            active.append({state.id for state in machine.configuration})
        return active

    return walk
