"""Fleets of robots: one computer each, with its own network and shared memory, and a radio."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
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

    def fakes(self, *names: str) -> list[Any]:
        """Start processes with servers on computers, all at the same time."""
        with ThreadPoolExecutor() as pool:
            return list(pool.map(lambda name: self.computers[name].fakes(), names))

    def use_profile(self, file: Path) -> None:
        """Let processes that start from now on use a profile of DDS."""
        for computer in self.computers.values():
            computer.environment.update(dict.fromkeys(PROFILES, str(file)))

    @contextmanager
    def profile(self, file: Path) -> Iterator[None]:
        """Let processes that start meanwhile use another profile."""
        before = [dict(computer.environment) for computer in self.computers.values()]
        self.use_profile(file)
        yield
        for computer, environment in zip(self.computers.values(), before, strict=True):
            computer.environment = environment

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
