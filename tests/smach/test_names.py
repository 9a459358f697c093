"""No name of the model is in the way of what the nodes import and define."""

import runpy
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.naming import snake_case
from swarmdsl.codegen.api import OutputFile

NAMES = [
    *("Main", "Run", "Threading", "Sys", "Copy", "Math", "Functools"),
    *("Smach", "SmachRos", "Rospy", "Actionlib", "Msg", "Srv", "Action"),
    *("InitialUserdata", "Userdata", "Build", "Behavior", "Machine", "Step", "Lab", "LabBehavior"),
]
MODEL = """
package lab
message Note {{ level : int32, text : string }}
action GO {{ result {{ note : Note }} }}
function ask : abstraction {{ service "ask" : std_srvs/Empty }}
function go  : abstraction {{ action "go" : GO }}
event Go    : Note
event Built : other_msgs/build on "built"
statemachine {name} {{
  param limit : int32
  param wait  : duration = 1 ms
  var note : Note
  initial Userdata
  state Userdata {{
    do ask(by make_request)
    on succeeded, aborted -> machine
    on Built -> Userdata
  }}
  state machine {{
    entry / note.text = "a"
    on Go [event.level > sqrt(limit)] / note.level = event.level -> smach
  }}
  state smach {{ do go gives (note => note); on succeeded, aborted -> _ }}
  state _ {{ after wait -> _1 }}
  final _1
}}
"""


@pytest.mark.parametrize("name", NAMES)
def test_node_of_a_machine(
    name: str, robot: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Only the main thread could handle signals, and this process goes on after the node.
    monkeypatch.setattr("signal.signal", lambda number, handler: None)
    monkeypatch.setattr("faulthandler.dump_traceback_later", lambda *_, **__: None)
    module = snake_case(name)
    made = robot(MODEL.format(name=name), module, **{"~limit": 4})
    world = made.world
    world.answers.update(ask=["succeeded"], go=["succeeded"])
    script = tmp_path / "out" / "lab_behavior" / "scripts" / module
    codes: list[object] = []

    def run() -> None:
        with pytest.raises(SystemExit) as ending:
            runpy.run_path(str(script), run_name="__main__")
        codes.append(ending.value.code)

    node = threading.Thread(target=run, daemon=True)
    node.start()
    for _ in range(400):  # what comes before the machine has begun is lost
        world.publish("go", level=3)
        node.join(0.05)
        if codes:
            break
    assert codes == [0]
    assert world.log[-1] == ("shutdown", "state machine ended: _1")
    assert world.called() == ["ask", "go"]


def test_python_of_them_is_sound(
    generate: Callable[..., dict[str, OutputFile]], tmp_path: Path
) -> None:
    paths = []
    for name in NAMES:
        for file, made in generate(MODEL.format(name=name)).items():
            if file.endswith(".py") or "scripts/" in file:
                path = tmp_path / name / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(made.text, encoding="utf-8")
                compile(made.text, str(path), "exec")
                paths.append(path)
    flakes = [sys.executable, "-m", "pyflakes", *map(str, paths)]
    assert subprocess.run(flakes, capture_output=True, text=True, check=False).stdout == ""
