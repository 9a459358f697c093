"""Availability and versions of the tools that swarmdsl is compared with."""

from __future__ import annotations

import json
import platform
import shutil
import subprocess
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Protocol, TypeVar

from swarmdsl import __version__

FOLDER = Path(__file__).resolve().parent
MODULES = FOLDER.parent / "node_modules"
_NPM = {"langium", "@typespec/compiler", "@scion-scxml/scxml", "elkjs"}


class Measured(Protocol):
    """Measurable tool, with the package that it needs."""

    @property
    def name(self) -> str:
        """Name in tables."""

    @property
    def peer(self) -> str | None:
        """Name of a Python or npm package; None if none is needed."""


M = TypeVar("M", bound=Measured)


def divide(contenders: Iterable[M]) -> tuple[list[M], list[str]]:
    """Return the installed contenders, and a sentence for each missing one."""
    present, absent = [], []
    for each in contenders:
        if each.peer is None or version(each.peer) is not None:
            present.append(each)
        else:
            absent.append(f"{each.name} was not measured: {each.peer} is not installed")
    return present, absent


@cache
def version(peer: str) -> str | None:
    """Return the version of a package, or None if it is not installed."""
    if peer in _NPM:
        package = MODULES / peer / "package.json"
        if shutil.which("node") is None or not package.is_file():
            return None
        found = json.loads(package.read_text(encoding="utf-8"))["version"]
        assert isinstance(found, str)
        return found
    try:
        return version_of(peer)
    except PackageNotFoundError:
        return None


def title(name: str, peer: str | None) -> str:
    """Return a name with its version, and with the package if that has another name."""
    if peer is not None:
        alike = name.casefold() == peer.casefold()
        return f"{name} {version(peer)}" if alike else f"{name} ({peer} {version(peer)})"
    return f"{name} {platform.python_version()}" if name == "CPython" else f"{name} {__version__}"


def surroundings() -> str:
    """Describe the machine and the interpreters in a sentence."""
    node = shutil.which("node")
    words = [f"Python {platform.python_version()}"]
    if node is not None:
        shown = subprocess.run([node, "--version"], capture_output=True, text=True, check=True)
        words.append(f"Node {shown.stdout.strip().lstrip('v')}")
    words.append(f"{_processor()} ({_processors()} in use)")
    words.append(f"{platform.system()} {platform.machine()}")
    return ", ".join(words)


def _processors() -> int:
    import os

    return len(os.sched_getaffinity(0))


def _processor() -> str:
    file = Path("/proc/cpuinfo")
    if file.is_file():
        for line in file.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or "unknown processor"
