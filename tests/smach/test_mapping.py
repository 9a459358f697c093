"""The table that `swarmc targets smach` prints says what the generator does."""

import re
from collections.abc import Callable

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.codegen.api import OutputFile, Support
from swarmdsl.codegen.registry import load

HEADER = """package lab
message Note { level : int32 }
action Move { goal { x : float64 } result { seen : int32 } feedback { x : float64 } }
service Ask { }
function move : abstraction { action "move" : Move }
function ask  : abstraction { service "ask" : Ask }
event Go   : Note
event Stop : Note
swarm event Call : Note
swarm event Kept : Note { latest, keep 3 }
swarm event Brief : Note { lifespan 1 s }
swarm operator event Recall : Note
"""
PARTS = """
sensor Eye { out seen : Note; behavior Work }
sensor Ear { in heard : Note }
member Uav { left : Eye; right : Eye; ear : Ear; connect right.seen -> ear.heard }
swarm Uavs { uav : Uav }
"""
CONTRACTS = {
    "contract on an event": "contract Abort : on Go within 2 s reach End",
    "contract `when dead`": "contract Dies : when dead call ask",
}
CONTRACTED = "member Uav {{ behavior Work; {} }}  swarm Uavs {{ uav : Uav }}".format
"""A swarm of a member with a contract."""
WATCHING = {
    "contract on an event": ("lab_behavior/uavs_monitor.py", {"monitors": "true"}),
    "contract `when dead`": ("launch/uavs.launch.py", {}),
}
"""File of what watches a contract on ROS 2, and the options that it takes."""
BOX = "state In { on Go -> Deep }  state Deep { on Go -> In }"
MOVE = "do move(x = 1.0)"
ENDS = "on succeeded, aborted -> End"
MODELS = {
    "state with an action": f"state A {{ {MOVE}; {ENDS} }}",
    "state with a service": f"state A {{ do ask; {ENDS} }}",
    "state without activity": "state A { on Go -> End }",
    "composite state, submachine": f"state A {{ initial In; {BOX} on Stop -> End }}",
    "parallel state": """
        parallel state A {
          region R { initial B; state B { on Go -> Z }  final Z }
          on done -> End
        }""",
    "final state": """
        state A { initial B; state B { on Go -> Z }  final Z; on done -> End }""",
    "transition on an outcome": f"state A {{ {MOVE}; {ENDS} }}",
    "transition on an event": "state A { on Go -> End }",
    "transition on a completion": """
        state A { initial B; state B { on Go -> Z }  final Z; on done -> End }""",
    "transition on a certain final state": """
        state A {
          initial B; state B { on Go -> Z; on Stop -> Y }  final Z; final Y
          on done.Z -> End; on done.Y -> A
        }""",
    "transition after a time": "state A { after 3 s -> End }",
    "transition without a trigger": """
        var n : int32
        state A { on Go / n = event.level;  [n > 1] -> End }""",
    "choice": """
        var n : int32
        state A { on Go / n = event.level -> C }
        choice C { [n > 1] -> End; else -> A }""",
    "guard": "state A { on Go [event.level > 1] -> End }",
    "effect": "state A { on Go / send Stop(level = event.level) -> End }",
    "transition with several triggers": "state A { on Go, Stop -> End }",
    "transition out of states": """
        state A {
          initial In
          state In { on Go -> Deep }
          state Deep { on Stop -> End }
        }""",
    "transition into a state": f"""
        state A {{ on Go -> Box.Deep }}
        state Box {{ initial In; {BOX} on Stop -> End }}""",
    "initial state inside a state": f"""
        state A {{
          initial Box.Deep
          state Box {{ initial In; {BOX} }}
          on Stop -> End
        }}""",
    "history": f"""
        state A {{ initial In; {BOX} history H -> In; on Stop -> W }}
        state W {{ on Go -> A.H; on Stop -> End }}""",
    "deep history": f"""
        state A {{ initial In; {BOX} deep history H -> In; on Stop -> W }}
        state W {{ on Go -> A.H; on Stop -> End }}""",
    "internal transition": f"""
        state A {{
          initial In; {BOX}
          internal on Stop [event.level > 1] -> Deep
          on Stop -> End
        }}""",
    "transition without a target": """
        var n : int32
        state A { on Go / n = event.level; on Stop [n > 1] -> End }""",
    "entry, exit": "state A { entry / send Stop(); exit / send Stop(); on Go -> End }",
    "constant goal or request": f"state A {{ do move(x = 1.5); {ENDS} }}",
    "goal or request of values": f"""
        param far : float64 = 1.0
        state A {{ do move(x = far); {ENDS} }}""",
    "callback for a goal or request": f"state A {{ do move(by make); {ENDS} }}",
    "callback for a result or response": f"state A {{ {MOVE} gives by take; {ENDS} }}",
    "stored result or response": f"""
        var seen : int32
        state A {{
          {MOVE} gives (seen => seen)
          on succeeded [seen > 1] -> End
          on succeeded, aborted   -> A
        }}""",
    "variable": """
        var n : int32
        state A { on Go [n > 1] -> End; on Stop / n = 2 }""",
    "test of a state": """
        state A {
          initial B
          state B { on Go -> C }
          state C { on Go -> B }
          on Stop [in(C)] -> End
        }""",
    "time in a state": """
        state A { on Go [elapsed() > 1 s] -> End; on Stop -> End }""",
    "sender and time of an event": """
        state A { on Call [event.sender == "a" and event.sent > 1 s] -> End }""",
    "address of a sent event": "state A { on Go / send Call to uav[0] -> End }",
    "identity of the robot": "state A { on Go [self.index == 1] -> End; on Stop -> End }",
    "param": """
        param n : int32 = 2
        state A { on Go [n > 1] -> End; on Stop -> End }""",
    "param that is a message": """
        param first : Note
        state A { on Go [first.level > 1] -> End; on Stop -> End }""",
    "sent event": "state A { on Go / send Stop() -> End }",
    "latest, keep of an event": "state A { on Go / send Kept -> End }",
    "lifespan, deadline of an event": "state A { on Go / send Brief -> End }",
    "deferred event": "state A { defer Stop; on Go -> B }  state B { on Stop -> End }",
    "delayed sending, cancel": """
        state A { on Go / send Call after 3 s; on Stop / cancel Call -> End }""",
    "events of members": "state A { on member_lost -> End }",
    "number of present robots": "state A { on Go [present() > 1] -> End }",
    "contract on an event": "state A { on Go -> End }",
    "contract `when dead`": "state A { on Go -> End }",
    "connector": "state A { on Go -> End }",
    "initial state of a machine that is final": "final A",
    "name that Python cannot have": """
        var lambda : int32
        state A { on Go [lambda > 1] -> End; on Stop / lambda = 2 }""",
}
ONLY_ROS_1 = ("latest, keep of an event", "lifespan, deadline of an event")
FOR_ROS_2 = {
    **{name: model for name, model in MODELS.items() if name not in ONLY_ROS_1},
    "swarm event": "state A { on Call -> End }",
    "event of a person": "state A { on Recall -> End }",
    "delivery of a swarm event": "state A { on Go / send Kept -> End }",
    "monitored topic": 'state A { monitor "seen" : Note [event.level > 1] -> End }',
    "monitored feedback of an action": """
        var last : float64
        state A {
          do move(x = 1.0)
          on succeeded, aborted -> End
          monitor "move/feedback" : lab/MoveActionFeedback [event.feedback.x > last]
            / last = event.feedback.x
        }""",
}


def test_every_construct_has_a_model() -> None:
    assert [each.construct for each in load("smach").mapping] == list(MODELS)


@pytest.mark.parametrize("number", range(len(MODELS)), ids=list(MODELS))
def test_the_table_is_true(
    number: int,
    generate: Callable[..., dict[str, OutputFile]],
    reported: Callable[..., list[tuple[str, str, str]]],
) -> None:
    mapped = load("smach").mapping[number]
    body = MODELS[mapped.construct]
    end = "" if body == "final A" else "final End"
    model = f"{HEADER}statemachine Work {{ initial A; {body} {end} }}"
    if mapped.construct in CONTRACTS:
        told = reported(model + CONTRACTED(CONTRACTS[mapped.construct]))
        codes = [CODES[name].code for name, _, _ in told]
        assert codes == re.findall(r"\((SW\d{4})\)", mapped.means)
        return
    if mapped.construct == "connector":
        (word,) = re.findall("`([^`]*)`", mapped.means)
        assert word in generate(model + PARTS)["launch/uav.launch"].text
        return
    if mapped.construct == "latest, keep of an event":
        (text,) = [f.text for path, f in generate(model).items() if path.endswith("events.py")]
        assert all(word in text for word in re.findall("`([^`]*)`", mapped.means))
        return
    if mapped.support is Support.REJECTED:
        (code,) = re.findall(r"\((SW\d{4})\)", mapped.means)
        assert [CODES[name].code for name, _, _ in reported(model)] == [code]
        return
    (text,) = [
        file.text for path, file in generate(model).items() if path.endswith("behavior/work.py")
    ]
    # Without what is imported, and in one line.
    built = " ".join(text[text.index("def build") :].split())
    words = re.findall("`([^`]*)`", mapped.means)
    assert words
    for word in words:
        assert word in built, word
