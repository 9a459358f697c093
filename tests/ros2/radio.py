"""A radio between computers that are network namespaces of Linux: partitions, and packets lost.

Each robot has a namespace, whose only way to others is a pair of virtual Ethernet devices; their
other ends are ports of a bridge in one more namespace, `air`. A port that is down is a robot out of
reach: its own device has no carrier then. A port that loses packets drops them in the kernel, by a
classic BPF program that needs no module.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

_NAMES = "fleet"
_NETWORK = "10.77.0"
_DEVICE = "air0"
_DROP, _PASS = 2, 2**32 - 1
"""Verdicts of a traffic filter: drop the packet, and leave it to the next filter."""
_PATIENCE = 60.0
_RANDOM = 2**32 - 0x1000 + 56
"""Address at which classic BPF reads a random number."""


def missing() -> str:
    """Return the reason for which there can be no radio here, or an empty text."""
    for tool in ("ip", "tc"):
        if shutil.which(tool) is None:
            return f"no `{tool}`: install iproute2"
    if os.geteuid() != 0:
        return "network namespaces need root"
    name = f"{_NAMES}-{os.getpid()}-probe"
    made = subprocess.run(["ip", "netns", "add", name], capture_output=True, text=True)
    if made.returncode:
        return f"network namespaces are not allowed: {made.stderr.strip()}"
    port = _run("ip", "-n", name, "link", "add", "one", "type", "veth", "peer", "name", "two")
    bridge = _run("ip", "-n", name, "link", "add", "br0", "type", "bridge")
    _run("ip", "netns", "del", name)
    faults = [each.stderr.strip() for each in (port, bridge) if each.returncode]
    return f"no virtual Ethernet: {faults[0]}" if faults else ""


class Radio:
    """Computers by name, each in a namespace of its own."""

    def __init__(self, names: Sequence[str], memory: Path) -> None:
        remove_leftovers()
        self._prefix = f"{_NAMES}-{os.getpid()}"
        self._memory = memory
        self.addresses = {name: f"{_NETWORK}.{n}" for n, name in enumerate(names, 1)}
        self._air = self._namespace("air")
        try:
            self._build()
        except BaseException:
            self.close()
            raise

    def command(self, name: str) -> list[str]:
        """Return the beginning of a command that runs on a computer.

        Robots share no memory: each has a folder of its own as `/dev/shm`.
        """
        enter = 'mount --bind "$0" /dev/shm && exec "$@"'
        memory = self._memory / name
        return ["ip", "netns", "exec", self._namespace(name), "sh", "-c", enter, str(memory)]

    def cut(self, *names: str) -> None:
        """Take computers out of reach of all others."""
        for name in names:
            self._ip("-n", self._air, "link", "set", _port(self.addresses[name]), "down")

    def heal(self, *names: str) -> None:
        """Bring computers back into reach."""
        for name in names:
            self._ip("-n", self._air, "link", "set", _port(self.addresses[name]), "up")

    def lose(self, share: float) -> None:
        """Lose this share of all packets that computers send, which they do not notice."""
        limit = int(share * 2**32)
        program = f"4,32 0 0 {_RANDOM},53 0 1 {limit},6 0 0 {_PASS},6 0 0 {_DROP}"
        for address in self.addresses.values():
            port = ("dev", _port(address))
            self._tc("qdisc", "replace", *port, "clsact")
            self._tc("filter", "add", *port, "ingress", "bpf", "da", "bytecode", program)

    def wait_for_losses(self, count: int) -> None:
        """Wait until so many packets were lost."""
        end = time.monotonic() + _PATIENCE
        while (lost := self._lost()) < count:
            assert time.monotonic() < end, f"only {lost} packets were lost"
            time.sleep(0.05)

    def lose_nothing(self) -> int:
        """Lose no packets any more; return how many were lost."""
        lost = self._lost()
        for address in self.addresses.values():
            self._tc("qdisc", "del", "dev", _port(address), "clsact")
        return lost

    def _lost(self) -> int:
        lost = 0
        for address in self.addresses.values():
            told = self._tc("-s", "-j", "qdisc", "show", "dev", _port(address))
            (filter_,) = (each for each in json.loads(told) if each["kind"] == "clsact")
            lost += filter_["drops"]
        return lost

    def close(self) -> None:
        """End what still runs on the computers, and remove them."""
        _remove(f"{self._prefix}-")

    def _build(self) -> None:
        self._ip("netns", "add", self._air)
        inside = ("-n", self._air, "link")
        # A bridge that learns who wants multicast would have to ask for it first.
        self._ip(*inside, "add", "br0", "type", "bridge", "mcast_snooping", "0")
        self._ip(*inside, "set", "br0", "up")
        for name, address in self.addresses.items():
            space, port = self._namespace(name), _port(address)
            (self._memory / name).mkdir(parents=True)
            self._ip("netns", "add", space)
            peer = ("type", "veth", "peer", "name", _DEVICE, "netns", space)
            self._ip(*inside, "add", port, *peer)
            self._ip(*inside, "set", port, "master", "br0", "up")
            self._ip("-n", space, "addr", "add", f"{address}/24", "dev", _DEVICE)
            for device in (_DEVICE, "lo"):
                self._ip("-n", space, "link", "set", device, "up")

    def _namespace(self, name: str) -> str:
        return f"{self._prefix}-{name}"

    def _tc(self, *arguments: str) -> str:
        return self._ip("netns", "exec", self._air, "tc", *arguments)

    @staticmethod
    def _ip(*arguments: str) -> str:
        done = _run("ip", *arguments)
        assert not done.returncode, f"ip {' '.join(arguments)}: {done.stderr}"
        return done.stdout


def remove_leftovers() -> None:
    """Remove the namespaces of tests that were killed."""
    for name in _namespaces():
        process = name.split("-")[1]
        if not Path("/proc", process).exists():
            _remove(f"{_NAMES}-{process}-")


def _remove(prefix: str) -> None:
    for name in _namespaces():
        if name.startswith(prefix):
            for process in _run("ip", "netns", "pids", name).stdout.split():
                _run("kill", "-KILL", process)
            _run("ip", "netns", "del", name)


def _namespaces() -> list[str]:
    names = (line.split()[0] for line in _run("ip", "netns", "list").stdout.splitlines())
    return [name for name in names if name.startswith(f"{_NAMES}-")]


def _port(address: str) -> str:
    return f"port{address.rpartition('.')[2]}"


def _run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True)
