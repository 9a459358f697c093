"""Search spaces as integers with their scale, by the schema of the tool."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange import parameters
from swarmdsl.ir import System

Compile = Callable[[str], System]

SWARM = """
member Uav {
  param altitude : float64  = 2.5
  param patience : duration = 30 s
  param tries    : uint8    = 3
}
fitness Good { in covered : float64; maximize covered }
swarm Search { uav : Uav[1..8]; other : Uav; fitness Good }
"""


def emitted(
    system: System, *expected: tuple[str, str], package: str = ""
) -> dict[str, dict[str, Any]]:
    """Return parameters by name; `expected` are the reported places and notes."""
    report = Diagnostics()
    (file,) = parameters.emit(system, parameters.Options(package), report)
    assert file.path == "search/parameters.json"
    found = [(f.primary.span.text, *f.notes) for f in report if f.primary]
    assert found == list(expected)
    assert {f.name for f in report} <= {"no-place"}
    return {item["name"]: item for item in json.loads(file.text)["parameters"]}


def test_values_are_a_whole_number_times_the_step(compiled: Compile) -> None:
    system = compiled(
        SWARM
        + """
        optimize Search {
          uav.altitude in 0.1 .. 0.75 step 0.1
          uav.patience in 10 s .. 2 min step 500 ms
          uav.tries in 1 .. 5
          count of uav in 2 .. 8
        }
        """
    )
    made = emitted(system)

    # 0.1 is a tenth here, and no binary fraction near it.
    assert made == {
        "altitude": {
            "name": "altitude",
            "meta": "file:test_behavior",
            "min": 1,
            "max": 7,
            "scale": "0.1",
        },
        "patience": {
            "name": "patience",
            "meta": "file:test_behavior",
            "min": 20,
            "max": 240,
            "scale": "0.5",
        },
        "tries": {"name": "tries", "meta": "file:test_behavior", "min": 1, "max": 5, "scale": "1"},
        "uav": {"name": "uav", "meta": "command_line", "min": 2, "max": 8, "scale": "1"},
    }
    assert emitted(system, package="walk")["tries"]["meta"] == "file:walk"


def test_what_has_no_place(compiled: Compile) -> None:
    system = compiled(
        SWARM
        + """
        optimize Search {
          uav.altitude in 1.0 .. 20.0
          uav.patience in 10 s .. 20 s step 3 s
          uav.tries in 1 .. 5
          other.tries in 1 .. 4
          seed 4
        }
        """
    )
    made = emitted(
        system,
        (
            "uav.altitude in 1.0 .. 20.0",
            "the range is continuous, and the optimiser needs discrete values",
        ),
        (
            "uav.patience in 10 s .. 20 s step 3 s",
            "a value is a 32-bit integer times the step",
        ),
        (
            "other.tries in 1 .. 4",
            "it is the same param as that of role `uav` in the parameter file",
        ),
        ("4", "the file says what is varied, not how long"),
    )

    assert list(made) == ["tries"]
    assert made["tries"]["max"] == 5


def test_the_schema_and_a_real_file(compiled: Compile, corpus: Path) -> None:
    path = corpus / "schema" / "2021_OptimisedParameter.schema.json"
    validator = jsonschema.Draft7Validator(json.loads(path.read_text(encoding="utf-8")))
    real = json.loads((corpus / "optimisation" / "parameters.json").read_text(encoding="utf-8"))
    system = compiled(SWARM + "optimize Search { uav.tries in 1 .. 5; count of uav in 1 .. 2 }")
    ours = list(emitted(system).values())

    assert list(validator.iter_errors({"parameters": ours})) == []
    assert {tuple(item) for item in ours} == {tuple(item) for item in real["parameters"]}
    assert list(validator.iter_errors({"parameters": [{**ours[0], "scale": 1}]}))
