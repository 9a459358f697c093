"""Diagnostics for what ROS 2 cannot express, and for invalid options."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

Reported = Callable[..., list[tuple[str, str, str]]]

HEAD = """
package lab
function go : abstraction { service "go" : std_srvs/Empty }
"""
ACTION = "action Fly { goal { x : float64 } result { x : uint32 } feedback { x : float64 } }"
MACHINE = """
statemachine Work {
  initial A
  state A { do go; on succeeded, aborted -> B }
  final B
}
"""


@pytest.mark.parametrize(
    ("text", "name", "part", "place"),
    [
        (
            "message Bad { fieldName : int32 }" + MACHINE,
            "bad-identifier",
            "`fieldName` as the name of a field",
            "fieldName",
        ),
        (
            "message Bad { const low : int32 = 1 }" + MACHINE,
            "bad-identifier",
            "`low` as the name of a constant",
            "low",
        ),
        (
            "message bad { x : int32 }" + MACHINE,
            "bad-identifier",
            "`bad` as the name of an interface",
            "bad",
        ),
        (
            'event Loud : std_msgs/Empty on "~loud"\n'
            + MACHINE.replace("state A { do go", "state A { on Loud -> B; do go"),
            "bad-identifier",
            "`~loud` as the name of a topic",
            "",
        ),
        (
            MACHINE.replace("initial A", "param class : int32 = 1\n  initial A").replace(
                "on succeeded, ", "on succeeded [class == 1] -> B; on succeeded, "
            ),
            "bad-identifier",
            "`class` as an attribute of Python",
            "",
        ),
        (
            MACHINE.replace("initial A", "param use_sim_time : bool = true\n  initial A").replace(
                "on succeeded, ", "on succeeded [use_sim_time] -> B; on succeeded, "
            ),
            "bad-identifier",
            "`use_sim_time` as a parameter",
            "",
        ),
        (
            MACHINE.replace("initial A", "param at : geometry_msgs/Pose\n  initial A"),
            "unsupported-construct",
            "a param of type `geometry_msgs/Pose`",
            "",
        ),
        (
            MACHINE.replace("Work", "Engine"),
            "bad-identifier",
            "`engine` as a module name",
            "",
        ),
        (
            ACTION + MACHINE.replace("-> B", '-> B; monitor "fly/goal" : lab/FlyActionGoal -> B'),
            "unsupported-construct",
            "an event of `lab/FlyActionGoal` that is heard",
            "",
        ),
        (
            ACTION + MACHINE.replace("-> B", '-> B; monitor "fly" : lab/FlyActionFeedback -> B'),
            "unsupported-construct",
            "`lab/FlyActionFeedback` on a topic other than `<action>/feedback`, `fly`",
            "",
        ),
        (
            ACTION
            + 'event Far : lab/FlyActionFeedback on "fly/feedback"\n'
            + MACHINE.replace("-> B", "/ send Far -> B"),
            "unsupported-construct",
            "an event of `lab/FlyActionFeedback` that is sent",
            "",
        ),
        (
            ACTION
            + MACHINE.replace(
                "-> B",
                '-> B; monitor "fly/feedback" : lab/FlyActionFeedback [event.header.seq > 1] -> B',
            ),
            "unsupported-construct",
            "field `header` of `lab/FlyActionFeedback`",
            "event.header",
        ),
        (
            MACHINE.replace("initial", "param big : uint64 = 9223372036854775808\n  initial", 1),
            "unsupported-construct",
            "a param of 9223372036854775808",
            "9223372036854775808",
        ),
        (
            MACHINE.replace("initial", "param big : uint64\n  initial", 1)
            + """
            member Uav { behavior Work; param big : uint64 = 9223372036854775807 }
            controller Worker { behavior Work; param big : uint64 }
            member Rover { work : Worker { big = 9223372036854775808 } }
            swarm All { uavs : Uav [1..2]; rovers : Rover [1..2]; others : Rover [1..2] }
            """,
            "unsupported-construct",
            "a param of 9223372036854775808",
            "9223372036854775808",
        ),
        (
            'swarm event Loud : std_msgs/Empty on "~/loud"\n'
            + MACHINE.replace("state A { do go", "state A { on Loud -> B; do go"),
            "bad-identifier",
            "`~/loud` as the name of a topic of the swarm",
            "",
        ),
    ],
)
def test_reports(reported: Reported, text: str, name: str, part: str, place: str) -> None:
    found = reported(HEAD + text)

    assert [each[0] for each in found] == [name], found
    assert part in found[0][1]
    assert place in found[0][2]
    assert found[0][2]


@pytest.mark.parametrize(
    "use",
    [
        "entry / number = last.header.seq",
        "exit / number = last.header.seq",
        "entry / send Far(x = last.header.seq)",
        "do fly(x = last.header.seq); on succeeded, aborted -> B",
        "after last.header.seq * 1 s -> B",
        "entry / last.header.seq = 1",
        "do fly(x = 1) gives (x => last.header.seq); on succeeded, aborted -> B",
    ],
)
def test_what_feedback_has_in_ros_1_only_is_reported_wherever_it_is_used(
    reported: Reported, use: str
) -> None:
    text = f"""
      package lab
      {ACTION}
      message Step {{ x : float64 }}
      event Far : Step
      function fly : abstraction {{ action "fly" : Fly }}
      statemachine Work {{
        initial A
        var last : lab/FlyActionFeedback
        var number : uint32
        state A {{
          {use}
          monitor "fly/feedback" : lab/FlyActionFeedback / last = event -> B
        }}
        final B
      }}
    """
    found = reported(text)

    assert [each[0] for each in found] == ["unsupported-construct"], found
    assert "field `header` of `lab/FlyActionFeedback`" in found[0][1]
    assert found[0][2].startswith(("last.header", "x => last.header"))


def test_what_is_used_of_a_package_that_is_written_is_described(reported: Reported) -> None:
    found = reported(HEAD + "event Done : other_msgs/Done\n" + MACHINE, interfaces="other_msgs")

    assert [each[0] for each in found] == ["unsupported-construct"]
    assert "`other_msgs/Done`, which the model does not describe" in found[0][1]
    assert found[0][2]


def test_so_is_what_their_messages_are_made_of(reported: Reported) -> None:
    message = "message other_msgs/Done { header : other_msgs/Header, again : other_msgs/Header }\n"
    text = HEAD + message + "event Done : other_msgs/Done\n" + MACHINE
    found = reported(text, interfaces="other_msgs")

    assert [each[0] for each in found] == ["unsupported-construct"]
    assert "`other_msgs/Header`, which the model does not describe" in found[0][1]
    assert found[0][2].startswith("header")


def test_what_ros_makes_of_an_action_is_described_with_it(reported: Reported) -> None:
    text = """
      package lab
      action fly_msgs/Fly { feedback { height : float64 } }
      function fly : abstraction { action "fly" : fly_msgs/Fly }
      statemachine Work {
        initial A
        state A { do fly; on succeeded, aborted -> B
          monitor "fly/feedback" : fly_msgs/FlyActionFeedback [event.feedback.height > 2] -> B }
        final B
      }
    """
    assert reported(text, interfaces="fly_msgs") == []


@pytest.mark.parametrize(
    ("option", "value", "part"),
    [
        ("package", "Bad Name", "cannot be the name of the package"),
        ("package", "rclpy", "cannot be the name of the package"),
        ("version", "1", "is not a version"),
        ("email", "me", "is not an e-mail address"),
        ("copyright", "Me", "is not a year and a name"),
        ("license", " ", "needs a text on one line"),
        ("lifecycle", "perhaps", "lifecycle"),
        ("interfaces", "a_msgs,Bad", "`Bad` is not a valid ROS package name"),
    ],
)
def test_options_are_checked(reported: Reported, option: str, value: str, part: str) -> None:
    found = reported(HEAD + MACHINE, **{option: value})

    assert [each[0] for each in found] == ["bad-option"]
    assert part in found[0][1]


def test_two_nodes_that_command_an_actuator(reported: Reported) -> None:
    model = (
        HEAD
        + """
message Speed { x : float64 }
actuator Wheels { in velocity : Speed on "cmd_vel" }
sensor Stick { out velocity : Speed on "cmd_vel" }
event Drive : Speed on "cmd_vel"
statemachine Work {
  initial A
  state A { do go; on succeeded, aborted / send Drive(x = 1.0) -> B }
  final B
}
member Rover { behavior Work; wheels : Wheels; stick : Stick }
swarm Rovers { rover : Rover[2] }
"""
    )
    ((name, message, place),) = reported(model)
    assert name == "several-publishers"
    assert message == "several nodes publish commands on `cmd_vel`: `work` and `stick`"
    assert "velocity" in place
    # Another topic for each, or one of them alone.
    assert (
        reported(
            model.replace('out velocity : Speed on "cmd_vel"', 'out velocity : Speed on "joy"')
        )
        == []
    )
    assert reported(model.replace("; stick : Stick", "")) == []


VEHICLE = """
package lab
import px4.events.*
import px4.functions.*
import px4.members.*
statemachine Work {
  initial A
  state A { do land; on succeeded, aborted -> B }
  final B
}
member Copter extends Px4Vehicle { behavior Work }
swarm Copters { copter : Copter[2] }
"""


def test_offboard_control_beside_commands_of_a_machine(reported: Reported) -> None:
    assert reported(VEHICLE) == []
    entry = "entry / send VehicleCommand(command = 21)"
    ((name, message, _),) = reported(VEHICLE.replace("do land", f"{entry}; do land"))
    assert name == "several-publishers"
    topic = "`fmu/in/vehicle_command`"
    assert message == f"several nodes publish commands on {topic}: `work` and `px4_offboard`"


def test_functions_of_px4_agree_on_topics(reported: Reported) -> None:
    climb = """
function climb : abstraction {
  action "climb" : px4_offboard_msgs/TakeOff
  in "vehicle_status" : px4_msgs/VehicleStatus
}
"""
    calls = "do climb(altitude = 2.0); on succeeded, aborted -> C }\n  state C { do land"
    model = VEHICLE.replace("import px4.events.*", "import px4.offboard.*\nimport px4.events.*")
    model = model.replace("do land", calls)
    found = reported(model.replace("statemachine", climb + "statemachine", 1))
    ((name, message, _),) = found
    assert name == "unsupported-construct"
    assert "two topics of `px4_msgs/VehicleStatus`" in message
    assert "`vehicle_status`" in message
    assert "`fmu/out/vehicle_status_v1`" in message
    same = climb.replace("vehicle_status", "fmu/out/vehicle_status_v1")
    assert reported(model.replace("statemachine", same + "statemachine", 1)) == []


def test_files_that_start_robots(generate: Callable[..., Any]) -> None:
    model = (
        HEAD
        + MACHINE
        + """
member Rover { behavior Work }
swarm Rovers { rover : Rover[2..4] }
swarm Others { rover : Rover }
"""
    )
    files = generate(model, systemd="true", compose="true")
    robots = yaml.safe_load(files["lab_behavior/deploy/compose.yaml"].text)["services"]
    assert [*robots] == ["rovers.rover_0", "rovers.rover_1", "others.rover_0"]
    robot = robots["others.rover_0"]
    words = ["ros2", "launch", "lab_behavior", "robot.launch.py", "member:=rover_0"]
    assert robot["command"].split()[:6] == [*words, "swarm:=others"]
    assert robot["network_mode"] == robot["ipc"] == "host"
    # Robots of two swarms with one name share no folder, and the unit asks for the swarm.
    assert "log_dir:=/output/others/logs/rover_0" in robot["command"]
    assert "trace_dir:=/output/rovers/traces" in robots["rovers.rover_0"]["command"]
    unit = files["lab_behavior/deploy/lab_behavior@.service"].text
    assert ' robot.launch.py member:=%i swarm:="$SWARM" ' in unit
    assert "# SWARM is the swarm of the robot: rovers or others." in unit
    assert "#   echo SWARM=rovers | sudo tee -a /etc/default/lab_behavior" in unit
    assert "glob('deploy/*')" in files["lab_behavior/setup.py"].text
    assert not any("/deploy/" in path for path in generate(model))
    verify_unit(unit)


def test_a_monitor_takes_no_module_of_the_package(generate: Callable[..., Any]) -> None:
    model = HEAD + MACHINE + "member Rover { behavior Work }\nswarm Swarm { rover : Rover }\n"
    files = generate(model + "property Ends of Swarm : never some rover in B\n", monitors="true")
    module = "lab_behavior/lab_behavior/swarm_monitor"
    assert "class Monitor:" in files[f"{module}.py"].text
    assert "SWARM = Swarm(" in files[f"{module}_2.py"].text


def verify_unit(unit: str) -> None:
    """Let systemd judge a unit, if it is there."""
    if shutil.which("systemd-analyze") is not None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "lab_behavior@.service")
            path.write_text(unit, encoding="utf-8")
            done = subprocess.run(["systemd-analyze", "verify", path], capture_output=True)
        assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


@pytest.mark.parametrize("second", ["", "swarm Others { rover : Rover }"])
def test_started_robots_have_the_profiles_of_their_network(
    second: str, generate: Callable[..., Any]
) -> None:
    behavior = MACHINE + "member Rover { behavior Work }\nswarm Rovers { rover : Rover }\n"
    watched = "property Ends of Rovers : never some rover in B\n"
    files = generate(
        HEAD + behavior + watched + second,
        systemd="true",
        compose="true",
        network="wifi",
        monitors="true",
    )
    unit = files["lab_behavior/deploy/lab_behavior@.service"].text
    swarm = "$SWARM" if second else "rovers"
    assert f"/share/lab_behavior/config/{swarm}/network" in unit
    assert 'FASTDDS_DEFAULT_PROFILES_FILE="$network/$FASTDDS"' in unit
    assert ("ExecStartPre=" in unit) == bool(second)
    verify_unit(unit)
    started = yaml.safe_load(files["lab_behavior/deploy/compose.yaml"].text)["services"]
    robot = started["rovers.rover_0" if second else "rover_0"]
    monitor = started["rovers_monitor"]
    # The program itself gets the signal that ends it, which `ros2 run` does not pass on.
    program = "/ws/install/lab_behavior/lib/lab_behavior/rovers_monitor"
    arguments = '--ros-args -r __ns:=/rovers -r __node:=monitor -p members:="rover[0]"'
    assert monitor["command"] == f"{program} {arguments}"
    watching = files["lab_behavior/deploy/lab_behavior_rovers_monitor.service"].text
    assert 'Environment="MEMBERS=rover[0]"' in watching
    assert 'network="$prefix/share/lab_behavior/config/rovers/network"' in watching
    assert 'exec "$prefix/lib/lab_behavior/rovers_monitor" --ros-args -r __ns:=/rovers' in watching
    assert not any("others_monitor.service" in path for path in files)
    verify_unit(watching)
    for each in (robot, monitor):
        told = each["environment"]
        folder = "/ws/install/lab_behavior/share/lab_behavior/config/rovers/network"
        assert told["FASTDDS_DEFAULT_PROFILES_FILE"] == f"{folder}/${{FASTDDS:-fastdds.xml}}"
        assert told["ROS_DOMAIN_ID"] == "${ROS_DOMAIN_ID:-0}"
    readme = files["lab_behavior/README.md"].text
    assert "## Network of rovers" in readme
    assert "export FASTDDS_DEFAULT_PROFILES_FILE=$network/fastdds.xml" in readme
