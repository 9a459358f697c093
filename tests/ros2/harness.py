"""Generated nodes as processes of a real ROS 2, with fakes around them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PATIENCE = 60.0
"""Timeout for an expected event, in seconds."""


class Ros:
    """Processes with a domain of their own, on this machine alone."""

    def __init__(self, folder: Path, packages: list[Path], domain: int, scratch: Path) -> None:
        self.scratch = scratch
        self.prefix: list[str] = []  # what begins each command
        self.python = folder / "venv" / "bin" / "python"
        self.processes: list[subprocess.Popen[str]] = []
        self.nodes: list[RosNode] = []
        installed = sorted((folder / "ws" / "install").glob("*/share"))
        prefixes = [str(each.parent) for each in installed]
        site = "lib/python3.*/site-packages"
        paths = [str(found) for each in installed for found in each.parent.glob(site)]
        profile = str(HERE / "loopback.xml")
        self.environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith("_ROS")},
            "PYTHONPATH": os.pathsep.join([*map(str, packages), *paths]),
            "AMENT_PREFIX_PATH": os.pathsep.join([*prefixes, str(folder / "venv")]),
            "LD_LIBRARY_PATH": os.pathsep.join(f"{each}/lib" for each in prefixes),
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT",
            "FASTRTPS_DEFAULT_PROFILES_FILE": profile,
            "FASTDDS_DEFAULT_PROFILES_FILE": profile,
            "ROS_PYTHON_CHECK_FIELDS": "1",
            "ROS_LOG_DIR": str(scratch / "log"),
            "PYTHONWARNINGS": "ignore",
        }

    def fakes(self) -> Fakes:
        """The process with servers and other robots."""
        return Fakes(self)

    def node(self, module: str, namespace: str = "/", **parameters: Any) -> RosNode:
        """A node; a parameter `a__b` is `a.b`."""
        made = RosNode(self, module, namespace, parameters)
        self.nodes.append(made)
        return made

    def prefer(self, package: Path) -> None:
        """Let nodes that are started from now on be of this package."""
        paths = [str(package), self.environment["PYTHONPATH"]]
        self.environment["PYTHONPATH"] = os.pathsep.join(paths)

    def overlay(self, install: Path) -> None:
        """Let processes that are started from now on use the packages of another workspace."""
        prefixes = [each.parent for each in sorted(install.glob("*/share"))]
        sites = [str(found) for each in prefixes for found in each.glob("lib/python3.*/site-*")]
        for name, paths in (
            ("PYTHONPATH", sites),
            ("AMENT_PREFIX_PATH", list(map(str, prefixes))),
            ("LD_LIBRARY_PATH", [f"{each}/lib" for each in prefixes]),
        ):
            self.environment[name] = os.pathsep.join([*paths, self.environment[name]])

    def start(self, *command: object, **options: Any) -> subprocess.Popen[str]:
        """Start a process."""
        process = subprocess.Popen(
            [*self.prefix, str(self.python), *map(str, command)],
            env=self.environment,
            text=True,
            cwd=self.scratch,
            **options,
        )
        self.processes.append(process)
        return process

    def close(self) -> None:
        """End all processes."""
        for node in self.nodes:
            node.log_stream.close()
        for process in self.processes:
            if process.poll() is None:
                process.kill()
            process.wait()
            for stream in (process.stdin, process.stdout, process.stderr):
                if stream is not None:
                    stream.close()


class Fakes:
    """Action and service servers, publishers and subscriptions; what they see is `seen`."""

    def __init__(self, ros: Ros) -> None:
        self.seen: list[dict[str, Any]] = []
        self._condition = threading.Condition()
        self.process = ros.start(HERE / "fakes.py", stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        threading.Thread(target=self._read, daemon=True).start()
        self.wait("ready", True)

    def do(self, what: str, **arguments: Any) -> None:
        """Let them do something."""
        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps({"do": what, **arguments}) + "\n")
        self.process.stdin.flush()

    def action(self, name: str, type_: str, *script: Any, **more: Any) -> None:
        """Serve an action; each goal ends as its line of the script says."""
        self.do("action", name=name, kind=type_, script=[_plan(each) for each in script], **more)

    def service(self, name: str, type_: str, *script: Any) -> None:
        """Serve a service."""
        plans = [_plan(each) for each in script or ("succeeded",)]
        self.do("service", name=name, kind=type_, script=plans)

    def publisher(self, topic: str, type_: str, **qos: Any) -> None:
        """Begin to publish on a topic."""
        self.do("publisher", topic=topic, kind=type_, **qos)

    def publish(self, topic: str, **data: Any) -> None:
        """Publish a message."""
        self.do("publish", topic=topic, data=data)

    def call(self, name: str, type_: str, **data: Any) -> dict[str, Any]:
        """Call a service; its response."""
        before = self.count("called", name)
        self.do("call", name=name, kind=type_, data=data)
        found: dict[str, Any] = self.wait("called", name, before + 1)["data"]
        return found

    def listeners(self, *topics: str, count: int = 1) -> None:
        """Wait until so many nodes listen to each topic."""
        before = self.count("listeners", [*topics])
        self.do("listeners", topics=topics, count=count)
        self.wait("listeners", [*topics], before + 1)

    def count(self, key: str, value: Any) -> int:
        """Return the number of lines seen with this value."""
        with self._condition:
            return sum(each.get(key) == value for each in self.seen)

    def found(self, key: str, value: Any) -> list[dict[str, Any]]:
        """All that was seen of something."""
        with self._condition:
            return [each for each in self.seen if each.get(key) == value]

    def wait(self, key: str, value: Any, count: int = 1) -> dict[str, Any]:
        """Wait until something was seen so often; the last of it."""
        end = time.monotonic() + PATIENCE
        with self._condition:
            while True:
                found = [each for each in self.seen if each.get(key) == value]
                if len(found) >= count:
                    return found[count - 1]
                left = end - time.monotonic()
                assert left > 0, f"{key} {value} was seen {len(found)} times in {self.seen}"
                self._condition.wait(left)

    def wait_for(
        self, key: str, value: Any, wanted: Callable[[dict[str, Any]], bool]
    ) -> dict[str, Any]:
        """Wait until something wanted was seen; the first of it."""
        end = time.monotonic() + PATIENCE
        with self._condition:
            while True:
                found = [each for each in self.seen if each.get(key) == value]
                for each in found:
                    if wanted(each):
                        return each
                left = end - time.monotonic()
                assert left > 0, f"{key} {value} is not as wanted, at last {found[-1:]}"
                self._condition.wait(left)

    def _read(self) -> None:
        assert self.process.stdout is not None
        try:
            for line in self.process.stdout:
                with self._condition:
                    self.seen.append(json.loads(line))
                    self._condition.notify_all()
        except ValueError:
            pass


class RosNode:
    """A generated node, and the trace that it writes."""

    def __init__(self, ros: Ros, module: str, namespace: str, parameters: dict[str, Any]) -> None:
        number = len(ros.processes)
        self.package, _, self.module = module.partition(".")
        self.parameters = parameters
        self.trace_file = ros.scratch / f"trace_{number}.jsonl"
        self.log_file = ros.scratch / f"log_{number}.txt"
        given = {"trace__file": str(self.trace_file), **parameters}
        arguments = ["--ros-args", "-r", f"__ns:={namespace}"]
        for name, value in given.items():
            arguments += ["-p", f"{name.replace('__', '.')}:={_yaml(value)}"]
        self.log_stream = self.log_file.open("w", encoding="utf-8")
        self.process = ros.start(
            "-m", module, *arguments, stdout=self.log_stream, stderr=subprocess.STDOUT
        )

    @property
    def log(self) -> str:
        """Log of the node."""
        return self.log_file.read_text(encoding="utf-8")

    @property
    def trace(self) -> list[dict[str, Any]]:
        """The lines of the trace that are complete."""
        if not self.trace_file.exists():
            return []
        text = self.trace_file.read_text(encoding="utf-8")
        return [json.loads(line) for line in text.splitlines(keepends=True) if line[-1] == "\n"]

    def until(self, condition: Callable[[list[dict[str, Any]]], bool], what: str) -> None:
        """Wait until something is so of the trace."""
        end = time.monotonic() + PATIENCE
        while not condition(self.trace):
            assert time.monotonic() < end, f"{what}: {self.trace}\n{self.log}"
            assert self.process.poll() is None or condition(self.trace), self.log
            time.sleep(0.02)

    def wait_in(self, *configuration: str) -> None:
        """Wait until exactly these states are active."""
        wanted = list(configuration)
        self.until(lambda t: bool(t) and t[-1]["configuration"] == wanted, f"in {wanted}")

    def wait_for(self, event: str, count: int = 1) -> dict[str, Any]:
        """Wait until an event was looked at so often; the line of it."""
        self.until(lambda t: sum(line["event"] == event for line in t) >= count, f"on {event}")
        return [line for line in self.trace if line["event"] == event][count - 1]

    def terminate(self, number: int = signal.SIGTERM) -> int:
        """Send a signal; the exit code."""
        self.process.send_signal(number)
        return self.exit_code()

    def exit_code(self) -> int:
        """Wait until the node has ended."""
        try:
            code = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"the node goes on: {self.log}") from None
        return code


def _plan(value: Any) -> dict[str, Any]:
    return {"outcome": value} if isinstance(value, str) else value


def _yaml(value: Any) -> str:
    return json.dumps(value)
