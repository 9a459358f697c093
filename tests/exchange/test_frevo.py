"""The search of FREVO: number of evaluations, and parameters varied."""

from __future__ import annotations

import json
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.exchange import frevo
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

Compile = Callable[[str], System]

MODEL = """
member Uav { param altitude : float64 = 2.5 }
fitness Good { in covered : float64; maximize covered }
environment Field { world "field.world"; size 10 m x 10 m }
/// Looks for people.
swarm Search { uav : Uav[1..8]; base : Uav[2]; some : Uav[3..*]; environment Field; fitness Good }
optimize Search {
  uav.altitude in 1.0 .. 20.0 step 0.5
  count of uav in 2 .. 8
  SETTINGS
}
"""
# What a component of FREVO 1 is made of.
DTD = """
<!ELEMENT icomponent (config, properties, requirements)>
<!ELEMENT config (entry+)>
<!ELEMENT properties (propentry*)>
<!ELEMENT requirements (reqentry*)>
<!ELEMENT entry EMPTY>
<!ATTLIST entry key CDATA #REQUIRED type CDATA #REQUIRED value CDATA #REQUIRED>
<!ELEMENT propentry EMPTY>
<!ATTLIST propentry key CDATA #REQUIRED type CDATA #REQUIRED value CDATA #REQUIRED>
<!ELEMENT reqentry EMPTY>
<!ATTLIST reqentry key CDATA #REQUIRED type CDATA #REQUIRED value CDATA #REQUIRED>
"""


def emitted(
    system: System, *expected: str, **options: Any
) -> tuple[dict[str, Any], etree._Element]:
    """Return configuration and problem; `expected` are the constructs reported."""
    report = Diagnostics()
    configuration, problem = frevo.emit(system, frevo.Options(**options), report)
    assert (configuration.path, problem.path) == (
        "search/frevoConfiguration.json",
        "search/Search.xml",
    )
    begin = "target `frevo` cannot represent "
    assert [found.message.removeprefix(begin) for found in report] == list(expected)
    return json.loads(configuration.text), etree.fromstring(problem.text.encode())


ALWAYS = ("the size of environment `Field`", "multiplicity `3..*`")


@pytest.mark.parametrize(
    ("evaluations", "candidates", "generations", "said"),
    [
        (100, 10, 9, ()),
        (10, 10, 0, ()),
        (4, 4, 0, ()),
        (25, 10, 1, ("25 evaluations",)),
    ],
)
def test_evaluations(
    evaluations: int, candidates: int, generations: int, said: tuple[str, ...], compiled: Compile
) -> None:
    system = compiled(MODEL.replace("SETTINGS", f"evaluations {evaluations}; seed 7"))
    made, _ = emitted(system, *ALWAYS, *said)

    assert (made["candidateCount"], made["generationCount"]) == (candidates, generations)
    assert (made["evolutionSeed"], made["evaluationSeed"]) == (7, 7)


def test_what_the_model_leaves_open_is_an_option(compiled: Compile) -> None:
    system = compiled(MODEL.replace("SETTINGS", ""))
    made, _ = emitted(
        system, *ALWAYS, candidates=4, generations=6, timeout=9, enough="0.5", package="mine"
    )

    assert (made["candidateCount"], made["generationCount"]) == (4, 6)
    assert made["simulationTimeoutSeconds"] == 9
    assert made["problemBuilder"] == {
        "representationInputCount": 0,
        "representationOutputCount": 2,
        "maximumFitness": 0.5,
    }
    assert made["representationBuilder"]["parameters"] == [
        {
            "name": "altitude",
            "metaInformation": "file:mine",
            "minimum": 2,
            "maximum": 40,
            "scale": 0.5,
        },
        {
            "name": "uav",
            "metaInformation": "command_line",
            "minimum": 2,
            "maximum": 8,
            "scale": 1.0,
        },
    ]


def test_a_seed_of_32_bits(compiled: Compile) -> None:
    made, _ = emitted(
        compiled(MODEL.replace("SETTINGS", "seed 4294967301")), *ALWAYS, "seed 4294967301"
    )

    assert made["evolutionSeed"] == 5


def test_the_problem(compiled: Compile) -> None:
    _, problem = emitted(compiled(MODEL.replace("SETTINGS", "steps 500")), *ALWAYS)
    entries = {item.get("key"): (item.get("type"), item.get("value")) for item in problem.iter()}
    entries.pop(None)

    dtd = etree.DTD(StringIO(DTD))
    assert dtd.validate(problem), dtd.error_log
    assert problem.getroottree().docinfo.doctype == (
        '<!DOCTYPE icomponent SYSTEM "../IComponent.dtd">'
    )
    assert entries == {
        "classdir": ("STRING", "Search/search"),
        "classname": ("STRING", "search.Search"),
        "name": ("STRING", "Search"),
        "description": ("STRING", "Looks for people."),
        "environment": ("STRING", "field.world"),
        "steps": ("INT", "500"),
        "swarmMembers": ("INT", "6"),
        "rosPath": ("STRING", "/opt/ros/noetic"),
        "rosWs": ("STRING", ""),
        "rosPackage": ("STRING", "test_behavior"),
        "inputnumber": ("INT", "0"),
        "outputnumber": ("INT", "2"),
        "minimumCandidates": ("INT", "1"),
        "maximumCandidates": ("INT", "1"),
    }


@pytest.mark.parametrize(
    ("option", "value", "fault"),
    [
        ("candidates", "0", "`0` is not a number from 1 to 2147483647"),
        ("enough", "much", "`much` is no number"),
        ("enough", "inf", "`inf` is not finite"),
    ],
)
def test_options_that_no_search_can_have(
    option: str, value: str, fault: str, tmp_path: Path
) -> None:
    path = tmp_path / "model.swarm"
    path.write_text("member Uav { }", encoding="utf-8")
    built = pipeline.build([path], [Request("frevo", {option: value})], tmp_path / "out")

    assert [found.message for found in built.report] == [f"target `frevo`: {fault}"]


def test_keys_of_a_real_file(compiled: Compile, corpus: Path) -> None:
    text = (corpus / "optimisation" / "frevoConfiguration.json").read_text(encoding="utf-8")
    ours, _ = emitted(compiled(MODEL.replace("SETTINGS", "")), *ALWAYS)

    assert shape(ours) == shape(json.loads(text))


def shape(value: Any) -> Any:
    """Return keys and types of values; for lists the first element, else class names."""
    if isinstance(value, dict):
        return [(name, shape(item)) for name, item in value.items()]
    if isinstance(value, list):
        return [shape(value[0])]
    if isinstance(value, (int, float)):
        return "number"
    return value if value[0].isupper() else "text"
