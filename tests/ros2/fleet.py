"""Fleets of robots: one computer each, with its own network and shared memory, and a radio."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .conftest import load_module
from .radio import Radio

HERE = Path(__file__).resolve().parent
PROFILES = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
"""Variables with the file of profiles, of today and of earlier versions."""


class Fleet:
    """Robots by the names of their computers, such as `uav_0`."""

    def __init__(
        self, ros_folder: Path, packages: list[Path], names: Iterable[str], scratch: Path
    ) -> None:
        self._scratch = scratch
        self.radio = Radio(list(names), scratch / "memory")
        self.computers: dict[str, Any] = {}
        for name in self.radio.addresses:
            folder = scratch / name
            folder.mkdir()
            made = load_module("harness").Ros(ros_folder, packages, 0, folder)
            made.prefix = self.radio.command(name)
            for variable in PROFILES:
                del made.environment[variable]
            self.computers[name] = made

    @property
    def nodes(self) -> list[Any]:
        """All nodes that were started."""
        return [node for computer in self.computers.values() for node in computer.nodes]

    def use_profile(self, file: Path, *names: str) -> None:
        """Let the processes that start on computers, or on all of them, use a profile of DDS."""
        for name in names or self.computers:
            environment = self.computers[name].environment
            environment.update(dict.fromkeys(PROFILES, str(file)))

    @contextmanager
    def profile(self, name: str, file: Path) -> Iterator[None]:
        """Let processes that start meanwhile on a computer use another profile."""
        before = Path(self.computers[name].environment[PROFILES[0]])
        self.use_profile(file, name)
        yield
        self.use_profile(before, name)

    def set_clock_wrong(self, name: str, milliseconds: int) -> None:
        """Let the clock of a computer be ahead of that of the others."""
        library = self._scratch / "clock.so"
        if not library.exists():
            build = ["gcc", "-shared", "-fPIC", "-o", str(library), str(HERE / "clock.c"), "-ldl"]
            subprocess.run(build, check=True)
        given = {"LD_PRELOAD": str(library), "CLOCK_OFFSET_MS": str(milliseconds)}
        self.computers[name].environment.update(given)

    def close(self) -> None:
        """End all processes, and remove the computers."""
        try:
            for computer in self.computers.values():
                computer.close()
        finally:
            self.radio.close()
