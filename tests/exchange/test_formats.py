"""Content of each format, found by changing models: the table of docs/formats.md.

A format carries something if its files change with it. Each row changes one thing in a model.
"""

# ruff: noqa: E501 - one change a line

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "formats.md"
BEGIN, END = "<!-- what formats carry -->\n", "<!-- end of what formats carry -->\n"

MODEL = """/// Of the package.
package shop
struct Place { x : float64, y : float64 }
message Order { id : string, level : int32, where : Place }
action Lift { goal { height : float64 } result { count : int32 } }
/// Lifts boxes.
function lift : abstraction {
  action "cmd/lift" : Lift
  in "height" : std_msgs/Float64
  param slow : bool = false
}
/// Looks for boxes.
function search : swarm {
  action "cmd/search" : Lift
  out "found" : std_msgs/String
  param wide : float64 = 2.0
}
/// Work begins.
swarm event Start : swarmros/SimpleEvent on "begin"
event Low : sensor_msgs/BatteryState on "battery"
swarm event Ordered : Order
/// An eye.
sensor Eye {
  out seen : std_msgs/String on "seen"
  param rate : float64 = 10.0
  operation zoom(factor : float64)
}
controller Brain { in seen : std_msgs/String on "thought" }
/// A worker.
member Worker {
  behavior Simple
  param speed : float64 = 2.0
  eye : Eye { rate = 5.0 }
  brain : Brain
  connect eye.seen -> brain.seen
  communication zyre { port = 5228 }
}
member Boss { behavior Rich }
/// All of it is in the dialect of CPSwarm.
statemachine Simple {
  var height : float64
  var count : int32
  initial Idle
  /// Waits.
  state Idle { on Start -> Work }
  state Work {
    initial Up
    state Up {
      do lift(height = height) gives (count => count)
      /// Goes on.
      on succeeded -> Look
      on aborted -> Up
    }
    state Look {
      do search(height = 1.5)
      on succeeded -> Look
      on aborted -> Up
    }
    on Low -> Stop
  }
  final Stop
}
endless statemachine Rich {
  param most : int32 = 3
  var n : int32 = 0
  initial Ask
  state Ask {
    entry / n = n + 1
    on Ordered [event.level > 2] / n = n + 2, send Ordered(id = "a") -> Both
    after 30 s -> Fork
    on Start -> Inside.Back
  }
  choice Fork { [n > most] -> Ask; else -> Both }
  parallel state Both {
    region L { initial L1; state L1 { on Start -> L2 }  final L2 }
    region R { initial R1; state R1 { on Low -> R2 }  final R2 }
    on done -> Inside
    internal on Ordered -> R1
  }
  state Inside {
    initial I1
    state I1 { on Low -> I2 }
    final I2
    history Back -> I1
    on done.I2 -> Sub
  }
  state Sub = Part { on done -> Ask }
}
statemachine Part { param wait : duration = 1 s; initial P1; state P1 { after wait -> P2 }  final P2 }
/// The hall.
environment Hall { world "hall.world"; size 20 m x 10 m }
swarm Team { worker : Worker[2..8]; boss : Boss; environment Hall; fitness Quick }
/// The sooner the better.
fitness Quick { in out_of_it : float64; param limit : float64 = 100.0; maximize limit - out_of_it }
optimize Team { steps 500; evaluations 20; seed 7; worker.speed in 0.5 .. 3.0 step 0.5 }
"""

ROWS = {
    "the package": ("package shop", "package store"),
    "states": ("  final Stop\n", "  state Rest { on Start -> Work }\n  final Stop\n"),
    "transitions": ("on succeeded -> Look\n      on aborted -> Up\n    }\n    on Low", "on succeeded -> Up\n      on aborted -> Up\n    }\n    on Low"),
    "guards": ("event.level > 2", "event.level > 5"),
    "effects": ("n = n + 2", "n = n + 3"),
    "events that are sent": ('send Ordered(id = "a")', 'send Ordered(id = "b")'),
    "delays": ("after 30 s", "after 40 s"),
    "choices": ("[n > most] -> Ask", "[n > most + 1] -> Ask"),
    "histories": ("history Back -> I1", "deep history Back -> I1"),
    "the names of submachines": ("= Part { on done -> Ask }\n}\nstatemachine Part", "= Other { on done -> Ask }\n}\nstatemachine Other"),
    "topics of events": ('on "begin"', 'on "started"'),
    "which events are those of the swarm": ("swarm event Start", "event Start"),
    "messages of events": ("message Order { id : string, level : int32", "message Order { id : string, level : int16"),
    "functions that states call": ('"cmd/lift"', '"cmd/raise"'),
    "values in goals": ("search(height = 1.5)", "search(height = 2.5)"),
    "variables in goals and results": ("gives (count => count)", "gives (count => height)"),
    "types of variables": ("var n : int32", "var n : int64"),
    "fields of goals and results": ("action Lift { goal { height : float64 }", "action Lift { goal { height : float32 }"),
    "topics of functions": ('out "found"', 'out "seen_it"'),
    "params of functions": ("param slow : bool = false", "param slow : bool = true"),
    "components": ("operation zoom(factor", "operation focus(factor"),
    "ports": ('on "seen"', 'on "looked"'),
    "parts of members": ("eye : Eye { rate = 5.0 }", "eye : Eye { rate = 6.0 }"),
    "connectors": ("  connect eye.seen -> brain.seen\n", ""),
    "settings of communication": ("port = 5228", "port = 5229"),
    "params of members": ("param speed : float64 = 2.0", "param speed : float64 = 2.5"),
    "the number of members": ("Worker[2..8]", "Worker[3..8]"),
    "environments": ("size 20 m", "size 30 m"),
    "fitness": ("maximize limit", "maximize 2 * limit"),
    "what is varied": ("0.5 .. 3.0 step 0.5", "0.5 .. 3.5 step 0.5"),
    "how is searched": ("evaluations 20", "evaluations 30"),
    "documentation of functions": ("/// Looks for boxes.", "/// Finds boxes."),
    "documentation of states": ("/// Waits.", "/// Waits for work."),
    "documentation of transitions": ("/// Goes on.", "/// Continues."),
    "documentation of members": ("/// A worker.", "/// One that works."),
}  # fmt: skip

FORMATS: dict[str, tuple[str, dict[str, str]]] = {
    "SCXML, portable": ("scxml", {"profile": "portable"}),
    "SCXML, CPSwarm": ("scxml", {"profile": "cpswarm"}),
    "ADF, D5.4": ("adf", {"form": "d5.4"}),
    "ADF, schema": ("adf", {"form": "schema"}),
    "AMF": ("amf", {}),
    "swarmros": ("swarmros", {}),
    "parameters": ("parameters", {}),
    "composition": ("composition", {}),
    "fitness": ("fitness", {}),
    "FREVO": ("frevo", {}),
}


def written(system: System) -> dict[str, dict[str, str]]:
    """Return the files of a system in each format."""
    found = {}
    for name, (target, given) in FORMATS.items():
        generator = registry.load(target)
        assert isinstance(generator, Generator)
        options = generator.options_type(**given)
        files = generator.emit(system, options, Diagnostics())
        found[name] = {file.path: file.text for file in files}
    return found


def compiled(text: str, folder: Path) -> System:
    path = folder / "model.swarm"
    path.write_text(text, encoding="utf-8")
    result = pipeline.check([path])
    errors = [found.message for found in result.report if found.severity is Severity.ERROR]
    assert result.system is not None, errors
    return result.system


def table(folder: Path) -> str:
    """Return the formats that change with each row."""
    plain = written(compiled(MODEL, folder))
    lines = [f"| | {' | '.join(FORMATS)} |", "|---|" + ":-:|" * len(FORMATS)]
    for name, (old, new) in ROWS.items():
        assert MODEL.count(old) == 1, name
        changed = written(compiled(MODEL.replace(old, new), folder))
        cells = ["x" if changed[each] != plain[each] else "" for each in FORMATS]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "".join(f"{line}\n" for line in lines)


def test_the_table_says_which_format_carries_what(tmp_path: Path, bless: bool) -> None:
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(BEGIN)
    said, _, after = rest.partition(END)
    made = f"\n{table(tmp_path)}\n"
    if bless:
        PAGE.write_text(before + BEGIN + made + END + after, encoding="utf-8")
    assert said == made or bless


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_carries_something(name: str, tmp_path: Path) -> None:
    assert written(compiled(MODEL, tmp_path))[name]
