"""`catkin_make` builds and installs the packages of all examples; SWARMDSL_CATKIN=1 asks for it."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

DEBIAN = Path("/usr/share")
PATH = "/usr/sbin:/usr/bin:/sbin:/bin"
FOREIGN = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED COMPONENTS message_generation {needs})
{adds}
generate_messages(DEPENDENCIES {needs})
catkin_package()
"""
MANIFEST = """<package format="2">
<name>{name}</name><version>0.0.0</version><description>-</description>
<maintainer email="a@example.org">-</maintainer><license>-</license>
<buildtool_depend>catkin</buildtool_depend><build_depend>message_generation</build_depend>
{needs}</package>
"""
KINDS = {"msg": "message", "srv": "service", "action": "action"}


def _describe(package: Path, known: Iterable[str]) -> None:
    """Make a catkin package of the interfaces in a folder, as those who own them would."""
    files = {kind: sorted(package.glob(f"{kind}/*.{kind}")) for kind in KINDS}
    texts = [path.read_text(encoding="utf-8") for paths in files.values() for path in paths]
    named = set(re.findall(r"^(\w+)/\w+", "\n".join(texts), re.MULTILINE))
    needs = {name for name in named if name in known} | {"std_msgs"}
    needs |= {"actionlib_msgs"} if files["action"] else set()
    needs -= {package.name}
    adds = "".join(
        f"add_{KINDS[kind]}_files(FILES {' '.join(path.name for path in paths)})\n"
        for kind, paths in files.items()
        if paths
    )
    text = FOREIGN.format(name=package.name, needs=" ".join(sorted(needs)), adds=adds)
    (package / "CMakeLists.txt").write_text(text, encoding="utf-8")
    tags = "".join(f"<depend>{name}</depend>\n" for name in sorted(needs))
    (package / "package.xml").write_text(MANIFEST.format(name=package.name, needs=tags))


@pytest.mark.timeout(3600)
@pytest.mark.skipif(
    "SWARMDSL_CATKIN" not in os.environ, reason="slow: `SWARMDSL_CATKIN=1 make test-ros1`"
)
def test_packages_of_all_examples(workspace: Any, examples: Path, tmp_path: Path) -> None:
    if shutil.which("catkin_make", path=PATH) is None:
        pytest.skip("no catkin_make: apt-get install catkin ros-message-generation")
    source = tmp_path / "src"
    made = []
    for example in sorted(path.name for path in examples.iterdir() if path.is_dir()):
        if not workspace.can_make(example):
            continue
        _, package, _ = workspace.example(example)
        made.append(package.name)
        shutil.copytree(package.parent, source, dirs_exist_ok=True)
    foreign = set()
    for folder in sorted(workspace.folder.glob("*/interfaces/*")):
        if not (source / folder.name / "package.xml").exists() or folder.name in foreign:
            foreign.add(folder.name)
            ignore = shutil.ignore_patterns(
                "*Action.msg", "*Goal.msg", "*Result.msg", "*Feedback.msg"
            )
            shutil.copytree(folder, source / folder.name, dirs_exist_ok=True, ignore=ignore)
    known = {*foreign, *(path.parent.name for path in DEBIAN.glob("*/package.xml"))}
    for name in foreign:
        _describe(source / name, known)

    environment = {"PATH": PATH, "HOME": str(tmp_path)}
    command = ["catkin_make", "-DPYTHON_EXECUTABLE=/usr/bin/python3", "-j2", "-l99", "install"]
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )

    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    installed = tmp_path / "install"
    for name in made:
        scripts = sorted(path.name for path in (source / name / "scripts").iterdir())
        for script in scripts:
            found = installed / "lib" / name / script
            assert os.access(found, os.X_OK), found
        assert (installed / "share" / name / "launch").is_dir()
        assert list(installed.glob(f"lib/python3/dist-packages/{name}/node.py"))
