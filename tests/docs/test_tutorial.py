"""The tutorial, walked from its first command to its last, with the pictures that it shows."""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from ..ros2.domains import free_domain
from ..ros2.installed import installed
from .pages import ROOT, Block, Page
from .walk import Walk, commands, matches

TUTORIAL = Page(ROOT / "docs" / "tutorial.md")
PICTURES = ROOT / "docs" / "pictures" / "tutorial"


def _blocks(needs: str) -> list[Block]:
    """Those that need this beside swarmdsl: `ros2`, or the traces of a `flight`."""
    return [block for block in TUTORIAL.blocks if block.attributes.get("needs", "") == needs]


@pytest.fixture(scope="module")
def walked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of somebody who has followed all that does not need ROS."""
    folder = tmp_path_factory.mktemp("tutorial")
    walk = Walk(folder)
    for block in _blocks(""):
        walk.follow(block)
    return folder / "rescue"


def test_pictures_are_those_that_it_makes(walked: Path, bless: bool) -> None:
    shown = {Path(link).name for link in TUTORIAL.links if link.startswith("pictures/tutorial/")}

    assert len(shown) == 4
    if bless:
        for name in shown:
            (PICTURES / name).write_bytes((walked / name).read_bytes())
    assert {path.name for path in PICTURES.iterdir()} == shown
    for name in shown:
        assert (PICTURES / name).read_bytes() == (walked / name).read_bytes(), name


@pytest.mark.parametrize(
    ("needs", "project", "folders"),
    [
        ("ros1", "rescue1", {"roslaunch": "launch", "rosrun": "scripts"}),
        ("ros2cli", "rescue", {"ros2 launch": "launch"}),
    ],
)
def test_what_is_started_is_there(
    needs: str, project: str, folders: dict[str, str], walked: Path
) -> None:
    """The launch files and nodes of the commands that are not run here."""
    text = "".join(block.text for block in _blocks(needs))
    for command, folder in folders.items():
        started = re.findall(rf"{command} (\S+) (\S+)", text)

        assert started
        for package, name in started:
            places = walked.parent.glob(f"{project}/generated/*/{package}/{folder}/{name}")
            assert len(list(places)) == 1, f"{command} {package} {name}"


@pytest.mark.long
@pytest.mark.timeout(660)
def test_on_ros_2(walked: Path) -> None:
    """Build the workspace, let two drones fly, and hold what they did against the model."""
    ros = str(installed())
    folder = walked / "generated"
    # The packages of CPSwarm are there already, and only Python uses the others.
    words = ["-GNinja", "-DCMAKE_BUILD_TYPE=None", "-DBUILD_TESTING=OFF"]
    words.append(f"-DCMAKE_PROJECT_INCLUDE={ROOT / 'tests' / 'ros2' / 'without_cpp.cmake'}")
    quick = f"cmake-args: {json.dumps(words)}"
    (walked / "colcon.yaml").write_text(
        f"build: {{packages-skip: [cpswarm_msgs, swarmros], {quick}}}\n"
    )
    done = [f". {shlex.quote(ros)}/setup.sh", f". {shlex.quote(ros)}/ws/install/setup.sh"]
    shown = ""
    for block in _blocks("ros2"):
        if "file" in block.attributes:
            (folder / block.attributes["file"]).write_text(block.text, encoding="utf-8")
        else:
            done += (each.text for each in commands(block))
            shown += "".join(each.shown or "" for each in commands(block))
    environment = {
        **os.environ,
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        # As in a shell in which swarmdsl's environment is active.
        "VIRTUAL_ENV": sys.prefix,
        "COLCON_DEFAULTS_FILE": str(walked / "colcon.yaml"),
        "FASTDDS_DEFAULT_PROFILES_FILE": str(ROOT / "tests" / "ros2" / "loopback.xml"),
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(ROOT / "tests" / "ros2" / "loopback.xml"),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT",
        "ROS_LOG_DIR": str(walked / "log"),
    }

    with free_domain() as domain:
        code, printed = _run_in_a_group(
            ["bash", "-e", "-c", "\n".join(done)],
            walked,
            {**environment, "ROS_DOMAIN_ID": str(domain)},
        )

    assert code == 0, printed
    assert matches(printed, f"...\n{shown}"), printed
    flights = _blocks("flight")
    assert flights
    for block in flights:
        Walk(walked).follow(block)


def _run_in_a_group(
    command: list[str], folder: Path, environment: dict[str, str]
) -> tuple[int, str]:
    """Run a command; kill what it leaves behind, such as a node whose middleware does not end."""
    # Not a pipe, which what is left behind would hold open.
    log = folder / "terminal.txt"
    with log.open("wb") as terminal:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=terminal,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = process.wait(timeout=600)
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
    return code, log.read_text(encoding="utf-8")
