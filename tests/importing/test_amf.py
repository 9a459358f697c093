"""Algorithm Modelling Files: behaviours of the swarm library."""

from __future__ import annotations

import json
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.importing import import_adf

HELP = {"topic": "target_help", "msg_def": {"class": "swarm_msgs/Help"}}
POSE = {"topic": "pose", "msg_def": {"class": "geometry_msgs/PoseStamped"}}
SEARCH = {
    "name": "search",
    "description": "Look around.",
    "dependencies": [HELP, POSE],
    "api": {
        "inputs": [POSE],
        "comm_paradigm": "rosaction",
        "comm_model": {"name": "cmd/search", "class": "swarm_msgs/Search"},
    },
}
MODEL = """package uav

/// Look around.
function search : swarm {
  action "cmd/search" : swarm_msgs/Search
  in "pose" : geometry_msgs/PoseStamped
  out "found" : swarm_msgs/Found
}

function ask : swarm { service "cmd/ask" : swarm_msgs/Ask }

action swarm_msgs/Search {
  goal { altitude : float64 }
  result { ids : string[] }
}

service swarm_msgs/Ask {
  request { ids : string[3] }
}

message swarm_msgs/Found {
  /// Where it is.
  pose : geometry_msgs/Pose
}
"""


def test_a_topic_that_is_depended_on_is_listened_to() -> None:
    report = Diagnostics()
    text = json.dumps({"runtime-env": "ROS", "functions": [SEARCH]})
    (function,) = import_adf([Source("a.json", text)], "a", report, "swarm").functions

    assert function.category == "swarm"
    assert [(p.direction, p.topic, str(p.type)) for p in function.ports] == [
        ("in", "pose", "geometry_msgs/PoseStamped"),
        ("in", "target_help", "swarm_msgs/Help"),
    ]
    assert [(f.name, f.primary.span.text if f.primary else "") for f in report] == [
        ("assumed", "target_help")
    ]


def test_what_the_target_writes_comes_back(tmp_path: Path) -> None:
    model, out = tmp_path / "uav.swarm", tmp_path / "again.swarm"
    model.write_text(MODEL, encoding="utf-8")
    pipeline.build([model], [Request("amf", {})], tmp_path / "out")
    (file,) = (tmp_path / "out").rglob("*.amf.json")

    assert run(["import", "amf", str(file), "-o", str(out)]) == 0
    before, after = pipeline.check([model]).system, pipeline.check([out]).system
    assert before is not None
    assert after is not None
    assert after.functions == before.functions
    known = {each.type: each for each in after.interfaces}
    assert known == {each.type: each for each in before.interfaces}


def test_the_category_of_an_adf_file_counts_where_it_is_said() -> None:
    text = json.dumps({"functions": [{**SEARCH, "category": "abstraction-lib"}]})
    source = Source("a.json", text)
    (function,) = import_adf([source], "a", Diagnostics(), "swarm").functions

    assert function.category == "abstraction"
