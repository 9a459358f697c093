"""`swarmc new`: projects that work as they are."""

from __future__ import annotations

import os
import pty
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.tools.scaffold.libraries import LIBRARIES

WAYS = {
    "plain": ["rescue"],
    "one": ["one-robot", "--member", "Rover=1"],
    "many": ["many", "--member", "Uav=3", "--member", "Rover=1..5", "--member", "Bird=*"],
    "names": [
        *("names", "--swarm", "Crowd", "--sensor", "Eye", "--controller", "Brain"),
        *("--actuator", "Legs", "--description", "Walks {{ about }} // and /* sees"),
    ],
    "swarm called like a member": ["robot"],
    "ros 1": ["old", "-t", "smach"],
}


@pytest.mark.parametrize("way", WAYS)
def test_a_project_works_as_it_is(way: str, swarmc, folder, monkeypatch) -> None:
    made = swarmc("new", *WAYS[way])
    assert (made.code, made.err.splitlines()[0]) == (0, ""), made.err
    project = folder / WAYS[way][0]
    assert sorted(made.out.splitlines()) == sorted(
        path.relative_to(folder).as_posix() for path in project.rglob("*") if path.is_file()
    )

    monkeypatch.chdir(project)
    assert (swarmc("check", "--deny", "warnings").out) == ""
    assert swarmc("fmt", "--check").code == 0
    tested = swarmc("test")
    assert (tested.code, "4 passed" in tested.err + tested.out) == (0, True)
    ran = swarmc("simulate", "--scenario", "scenarios/mission.toml", "--trace", "none")
    assert ran.code == 0
    assert "TargetFound" in ran.out + ran.err
    assert swarmc("build").code == 0
    assert (project / "generated" / "skeleton" / "explore" / "package.xml").is_file()
    # Names of packages that are told apart at a glance.
    own = {path.parent.name for path in project.glob("generated/*/*_*/package.xml")}
    package = project.name.replace("-", "_")
    assert {each for each in own if each.startswith(f"{package}_")} == {
        f"{package}_{what}" for what in ("behavior", "interfaces", "bringup")
    }
    for target in ("ros2", "smach"):
        assert (project / "generated" / target).is_dir() == (target in _targets(WAYS[way]))


def _targets(arguments: list[str]) -> set[str]:
    named = {each for each in arguments if each in ("ros2", "smach")}
    return named or {"ros2"}


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_project_with_robots_of_a_library_works_as_it_is(
    library: str, swarmc, folder, monkeypatch
) -> None:
    made = swarmc("new", "my-robots", "--robots", library)
    assert (made.code, made.err.splitlines()[0]) == (0, ""), made.err
    monkeypatch.chdir(folder / "my-robots")

    assert swarmc("check", "--deny", "warnings").out == ""
    assert swarmc("fmt", "--check").code == 0
    # The last test runs the scenario.
    tested = swarmc("test")
    assert (tested.code, "4 passed" in tested.err + tested.out) == (0, True)
    assert swarmc("build", "--deny", "warnings").code == 0
    assert Path("generated/ros2/my_robots_behavior/package.xml").is_file()

    settings = find_settings([Path()], Diagnostics())
    system = pipeline.check(settings.sources, settings).system
    assert system is not None
    about = LIBRARIES[library]
    ((role,),) = [swarm.roles for swarm in system.swarms]
    assert (role.name, role.multiplicity.lower, role.multiplicity.upper) == (about.role, 3, 3)
    text = "".join(path.read_text(encoding="utf-8") for path in Path("models").glob("*.swarm"))
    named = r"^(?:member|environment|endless statemachine|property) (\w+)|extends (\w+)"
    assert {one or other for one, other in re.findall(named, text, re.MULTILINE)} == about.declared
    assert [each.name for each in system.events if each.operator] == ["Abort", "Start"]
    needed = Path("generated/ros2/my_robots_behavior/package.xml").read_text(encoding="utf-8")
    assert all(f"<depend>{package}</depend>" in needed for package in about.packages)


def test_every_library_with_robots_for_ros_2_has_a_project() -> None:
    assert set(LIBRARIES) == {
        path.parent.name for path in resources.library().glob("*/members.swarm")
    } - {"cpswarm"}


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["x", "--robots", "turtlebot"], 2, "did you mean `turtlebot4`?"),
        (["x", "--robots", "nope"], 2, "'turtlebot4', 'nav2', 'crazyswarm2', 'mavros', 'px4'"),
        (["x", "--robots", "nav2", "--member", "Uav"], 2, "its own robots and parts, without `--m"),
        (["x", "--robots", "nav2", "-t", "smach"], 2, "`--robots` is for ROS 2"),
        (["nav2", "--robots", "turtlebot4"], 1, "`nav2` cannot be the name of a project"),
        (["x", "--robots", "nav2", "--swarm", "Site"], 1, "the template uses this name"),
    ],
)
def test_what_robots_of_a_library_cannot_be(arguments, code, said, swarmc, folder) -> None:
    ran = swarmc("new", *arguments)

    assert ran.code == code
    assert said in ran.err
    assert list(folder.iterdir()) == []


def test_the_swarm_has_what_the_command_line_says(swarmc, folder) -> None:
    swarmc("new", "rescue", "--member", "Uav=3", "--member", "Rover=2..*", "--sensor", "Eye")
    settings = find_settings([folder / "rescue"], Diagnostics())
    system = pipeline.check(settings.sources, settings).system

    assert system is not None
    (swarm,) = system.swarms
    assert [
        (role.name, role.member, role.multiplicity.lower, role.multiplicity.upper)
        for role in swarm.roles
    ] == [
        ("uav", "Uav", 3, 3),
        ("rover", "Rover", 2, None),
    ]
    assert system.optimizations[0].swarm == swarm.name == "Rescue"
    kinds = [(each.kind, each.name) for each in system.components]
    assert kinds == [("sensor", "Eye"), ("controller", "Pilot"), ("actuator", "Wheels")]
    assert all(len(member.connectors) == 2 for member in system.members)


def test_nothing_is_overwritten(swarmc, folder) -> None:
    (folder / "rescue").mkdir()
    assert swarmc("new", "rescue").code == 0
    (folder / "rescue" / "swarm.toml").write_text("# mine\n")
    again = swarmc("new", "rescue")

    assert (again.code, again.out) == (1, "")
    assert again.err.startswith("error[SW1502]: `rescue` already exists")
    assert (folder / "rescue" / "swarm.toml").read_text() == "# mine\n"
    (folder / "file").write_text("")
    assert swarmc("new", "file").code == 1
    assert swarmc("new", "rescue", "--folder", "other").code == 0
    assert (folder / "other" / "swarm.toml").is_file()
    free = folder / "free"
    for name in (".git", ".vscode"):
        (free / name).mkdir(parents=True)
    assert swarmc("new", "rescue", "--folder", "free").code == 0
    assert swarmc("new", "rescue", "--folder", "free").code == 1
    mine = folder / "mine" / ".gitignore"
    mine.parent.mkdir()
    mine.write_text("mine\n")
    assert swarmc("new", "rescue", "--folder", "mine").code == 1
    assert list(mine.parent.iterdir()) == [mine]


def test_a_dry_run_writes_nothing(swarmc, folder) -> None:
    ran = swarmc("new", "rescue", "--dry-run")

    assert "rescue/models/rescue.swarm" in ran.out
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["Rescue"], ["`Rescue` cannot be the name of a project: use `rescue`"]),
        (["on"], ["`on` cannot be the name of a project: write it in `snake_case`"]),
        (["2fast"], ["`2fast` cannot be the name of a project: write it in `snake_case`"]),
        (["../up"], ["`../up` cannot be the name of a project: use `up`"]),
        (["members"], ["`members` cannot be the name of a project: the template uses this name"]),
        (["example"], ["`example` cannot be the name of a project: ROS has a package `example_"]),
        (
            ["x", "--member", "uav=0", "--sensor", "State", "--actuator", "Pilot"],
            [
                "`uav` cannot be the name of a member: use `Uav`",
                "`0` cannot be the number of `uav`: write a multiplicity of at least one: `3`",
                "`State` cannot be the name of a sensor: `state` is a keyword",
                "`Pilot` cannot be the name of 2 elements: give each member",
            ],
        ),
        (
            ["x", "--member", "Uav=5..1"],
            ["`5..1` cannot be the number of `Uav`: write a multiplicity of at least one: `3`"],
        ),
        (
            ["x", "--swarm", "Field"],
            ["`Field` cannot be the name of a swarm: the template uses this name"],
        ),
        (
            ["x", "--sensor", "Speed"],
            ["`Speed` cannot be the name of a sensor: the template uses this name"],
        ),
    ],
)
def test_names_that_no_model_can_have(arguments, said, swarmc, folder) -> None:
    ran = swarmc("new", *arguments)
    found = re.findall(r"^error\[SW1501\]: (.*)$", ran.err, re.MULTILINE)
    ways = re.findall(r"^  = help: (.*)$", ran.err, re.MULTILINE)
    told = sorted(f"{each}: {way}" for each, way in zip(found, ways, strict=True))

    assert ran.code == 1
    assert list(folder.iterdir()) == []
    assert [each[: len(wanted)] for each, wanted in zip(told, sorted(said), strict=True)] == (
        sorted(said)
    )


def test_a_project_is_for_one_generation_of_ros(swarmc, folder) -> None:
    ran = swarmc("new", "rescue", "-t", "ros2", "-t", "smach")

    assert ran.code == 2
    assert "a project is for ROS 2 (ros2) or ROS 1 (smach)" in ran.err
    assert list(folder.iterdir()) == []


def test_a_folder_that_cannot_be_written(swarmc, folder) -> None:
    (folder / "file").write_text("")
    ran = swarmc("new", "rescue", "--folder", "file/below")

    assert ran.code == 1
    assert "SW0909" in ran.err


def test_without_a_terminal_nobody_is_asked(swarmc) -> None:
    ran = swarmc("new")

    assert ran.code == 2
    assert "NAME is missing" in ran.err


@pytest.fixture
def terminal(folder: Path) -> Callable[[list[str], str], tuple[int, str]]:
    """Run `swarmc` on a terminal, with something typed."""

    def typed(arguments: list[str], keys: str) -> tuple[int, str]:
        ours, its = pty.openpty()
        command = [sys.executable, "-m", "swarmdsl", *arguments]
        environment = {**os.environ, "TERM": "dumb", "COLUMNS": "100"}
        with subprocess.Popen(
            command, stdin=its, stdout=its, stderr=its, cwd=folder, env=environment
        ) as process:
            os.close(its)
            os.write(ours, keys.encode())
            shown = b""
            while True:
                try:
                    read = os.read(ours, 4096)
                except OSError:  # the other end is closed
                    break
                if not read:
                    break
                shown += read
        os.close(ours)
        return process.returncode, shown.decode()

    return typed


def test_on_a_terminal_one_is_asked(terminal, folder, swarmc, monkeypatch) -> None:
    (folder / "taken").mkdir()
    (folder / "taken" / "file").write_text("")
    answers = [
        *(
            "Rescue",
            "taken",
            "rescue",
            "Finds people.",
            "uav",
            "Uav",
            "0",
            "2",
            "y",
            "Rover",
            "1..5",
            "n",
        ),
        *("Eye", "Uav", "Brain", "", "", "smach"),
    ]
    code, shown = terminal(["new"], "".join(f"{each}\n" for each in answers))

    assert code == 0, shown
    assert "use `rescue`" in shown
    assert shown.index("`taken` already exists") < shown.index("Description")
    assert "use `Uav`" in shown
    main = (folder / "rescue" / "models" / "rescue.swarm").read_text()
    assert "/// Finds people.\n" in main
    assert "  uav   : Uav[2]\n  rover : Rover[1..5]\n" in main
    members = (folder / "rescue" / "models" / "members.swarm").read_text()
    assert "sensor Eye {" in members
    assert "controller Brain {" in members
    assert "actuator Wheels {" in members
    settings = (folder / "rescue" / "swarm.toml").read_text()
    assert "[targets.smach]" in settings
    assert "ros        = 1" in settings
    monkeypatch.chdir(folder / "rescue")
    assert swarmc("check", "--deny", "warnings").code == 0


def test_robots_of_a_library_leave_few_questions(terminal, folder) -> None:
    code, shown = terminal(["new", "-i", "--robots", "nav2"], "store\n\nNight\n")

    assert code == 0, shown
    assert "Description" in shown
    assert not re.search("type of robot|sensor|Target", shown)
    assert "swarm Night {" in (folder / "store" / "models" / "store.swarm").read_text()


def test_where_no_project_can_go_one_is_asked_no_more_than_its_name(terminal, folder) -> None:
    (folder / "file").write_text("")
    code, shown = terminal(["new", "-i", "--folder", "file"], "rescue\n")

    assert code == 1
    assert "Description" not in shown
    assert "SW1502" in shown


def test_who_leaves_the_questions_leaves_nothing(terminal, folder) -> None:
    code, _ = terminal(["new", "rescue", "-i"], "\x04")

    assert code == 130
    assert list(folder.iterdir()) == []
