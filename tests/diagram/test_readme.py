"""The diagrams in the READMEs of generated packages."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from swarmdsl.codegen.diagram.readme import pictures
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline

from .conftest import ROOT, system_of

SAR = ROOT / "examples" / "search_and_rescue"


@pytest.mark.parametrize("target", ["smach", "ros2", "yasmin"])
def test_a_package_shows_what_it_does(target: str, tmp_path: Path) -> None:
    assert not pipeline.build([SAR], [Request(target)], tmp_path).report.has_errors
    text = (tmp_path / target / "sar_behavior" / "README.md").read_text()
    tokens = MarkdownIt("commonmark").parse(text)
    blocks = [each.content for each in tokens if each.type == "fence" and each.info == "mermaid"]
    titles = [block.splitlines()[1] for block in blocks]
    assert titles == [
        "title: composition SearchAndRescue",
        "title: endless statemachine UavSearch",
        "title: statemachine RoverRescue",
    ]
    assert '  swarm ---|"rover [1..5] in base"| role_rover\n' in blocks[0]
    assert "  Mission_Idle --> Mission_TakeOff : MissionStart\n" in blocks[1]
    heads = [
        content.content
        for opened, content in pairwise(tokens)
        if opened.type == "heading_open" and opened.tag == "h3"
    ]
    assert heads[-3:] == [
        "Swarm `SearchAndRescue`",
        "State machine `UavSearch`",
        "State machine `RoverRescue`",
    ]


def test_a_swarm_whose_members_run_others_is_left_out() -> None:
    system = system_of(SAR)
    rescue = [machine for machine in system.machines if machine.name == "RoverRescue"]
    members = [each for each in system.members if each.name == "Uav"]
    alone = replace(system, swarms=(replace(system.swarms[0], roles=system.swarms[0].roles[:1]),))
    assert members[0].behavior == "UavSearch"
    assert [each.title for each in pictures(alone, rescue)] == ["State machine `RoverRescue`"]


def test_what_mermaid_does_not_draw_is_left_out(tmp_path: Path) -> None:
    def shown(states: int) -> bool:
        path = tmp_path / f"large{states}.swarm"
        inside = (f"state S{at} {{ after 1 s -> S{(at + 1) % states} }}" for at in range(states))
        path.write_text(f"endless statemachine M {{ initial S0; {' '.join(inside)} }}\n")
        system = system_of(path)
        return bool(pictures(system, system.machines))

    assert shown(499)  # and the edge to the initial state
    assert not shown(500)
