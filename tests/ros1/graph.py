"""A ROS graph of our own on the loopback interface: its master, its environment, its processes."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import tempfile
import threading
import time
import xmlrpc.client
import xmlrpc.server
from collections.abc import Iterable
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
PYTHON = Path("/usr/bin/python3")
_NEEDED = ("actionlib", "genpy", "rosmaster", "rospy", "rostopic", "std_srvs", "geometry_msgs")
_INSTALL = (
    "apt-get install python3-rosmaster python3-rospy python3-rostopic python3-actionlib"
    " python3-std-srvs python3-geometry-msgs"
)
_LEFT_OUT = ("ROS_", "PYTHON", "VIRTUAL_ENV", "PYENV")


def missing() -> str | None:
    """Return the reason that there can be no graph here, None where there can."""
    if not PYTHON.exists():
        return f"no {PYTHON}: apt-get install python3"
    code = f"import {', '.join(_NEEDED)}"
    found = subprocess.run([PYTHON, "-c", code], capture_output=True, text=True, check=False)
    if found.returncode:
        why = found.stderr.strip().splitlines()[-1]
        return f"no ROS 1 ({why}): {_INSTALL}"
    if not Path("/usr/lib/actionlib_msgs/genaction.py").exists():
        return "no genaction.py for actions: apt-get install libactionlib-msgs-dev"
    return None


class Graph:
    """A master, and the processes that were started beside it."""

    def __init__(self) -> None:
        self.python, self.folder = str(PYTHON), HERE
        self._scratch = tempfile.TemporaryDirectory(prefix="ros1-")
        self.home = Path(self._scratch.name)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.uri = f"http://127.0.0.1:{port}"
        self.master = xmlrpc.client.ServerProxy(self.uri)
        self._started: list[subprocess.Popen[Any]] = []
        self.start(["/usr/bin/rosmaster", "--core", "-p", str(port)], output="master")
        wait_until(self._answers, "the master answers", 60)

    def environment(self, modules: Iterable[str | Path] = (), **more: str) -> dict[str, str]:
        """The variables of a process in this graph; `modules` are folders to import from."""
        kept = {k: v for k, v in os.environ.items() if not k.startswith(_LEFT_OUT)}
        folders = [str(folder) for folder in modules]
        return {
            **kept,
            "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
            "PYTHONPATH": os.pathsep.join(folders),
            "ROS_MASTER_URI": self.uri,
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(self.home),
            "ROS_LOG_DIR": str(self.home / "log"),
            "ROS_PACKAGE_PATH": os.pathsep.join(_smach_packages()),
            "ROS_DISTRO": "noetic",
            "ROS_PYTHON_VERSION": "3",
            **more,
        }

    def start(
        self, command: list[str], output: str | None = None, **options: Any
    ) -> subprocess.Popen[Any]:
        """Start a process; what it prints goes to a file, unless `stdout` is given."""
        options.setdefault("env", self.environment())
        if output is not None:
            with (self.home / f"{output}.txt").open("a") as file:
                options.setdefault("stdout", file)
                options.setdefault("stderr", file)
                process = subprocess.Popen(command, start_new_session=True, **options)
        else:
            process = subprocess.Popen(command, start_new_session=True, **options)
        self._started.append(process)
        return process

    def printed(self, output: str) -> str:
        """Return what processes with this output have printed."""
        path = self.home / f"{output}.txt"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def set_param(self, name: str, value: Any) -> None:
        """Give a ROS parameter a value."""
        self.master.setParam("/test", name, value)

    def wait_until(self, test: Any, what: str) -> None:
        """Wait for something to become true."""
        wait_until(test, what)

    def wait_for_node(self, name: str) -> None:
        """Wait until a node is known to the master."""
        what = f"{name} is not known"
        wait_until(lambda: self.master.lookupNode("/test", name)[0] == 1, what, 60)  # type: ignore[index]

    def wait_for_link(self, topic: str) -> None:
        """Wait until who publishes on a topic knows somebody who hears it."""

        def linked() -> bool:
            publishers: Any = self.master.getSystemState("/test")
            for node in dict(publishers[2][0]).get(topic, ()):
                found: Any = self.master.lookupNode("/test", node)
                with xmlrpc.client.ServerProxy(found[2]) as proxy:
                    links: Any = proxy.getBusInfo("/test")
                if any(link[2] == "o" and link[4] == topic for link in links[2]):
                    return True
            return False

        wait_until(linked, f"nobody hears {topic}")

    def interrupt(
        self, command: list[str], call: str, environment: dict[str, str], answers: bool = True
    ) -> int:
        """The exit code of a node to which SIGTERM comes while it waits for a call of the master.

        `call` is the first of that name: `registerPublisher`. The master answers late, or not
        before the node has ended. Raises TimeoutExpired for a node that does not end.
        """
        master = self.master

        class Between:
            """Hands on what a node asks the master, the one call late."""

            process: subprocess.Popen[Any] | None = None

            def _dispatch(self, method: str, arguments: Any) -> Any:
                if method == call and self.process is not None:
                    process, self.process = self.process, None
                    process.send_signal(signal.SIGTERM)
                    if answers:
                        time.sleep(0.3)
                    else:
                        process.wait()
                return getattr(master, method)(*arguments)

        between = Between()
        with xmlrpc.server.SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) as server:
            server.register_instance(between)
            threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
            uri = f"http://127.0.0.1:{server.server_address[1]}"
            environment = {**environment, "ROS_MASTER_URI": uri}
            between.process = process = self.start(command, output=call, env=environment)
            try:
                return process.wait(20)
            finally:
                self.end(process)
                server.shutdown()

    def end(self, process: subprocess.Popen[Any]) -> None:
        """End one of the processes."""
        end(process)

    def stop(self) -> None:
        """End what was started, the master last."""
        self.master("close")()
        for process in reversed(self._started):
            end(process)
        self._scratch.cleanup()

    def _answers(self) -> bool:
        with contextlib.suppress(OSError):
            return bool(self.master.getPid("/test")[0] == 1)  # type: ignore[index]
        return False


def _smach_packages() -> list[str]:
    """Folders of the manifests of the real smach; smach_ros looks up its own."""
    known = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    named = os.environ.get("SWARMDSL_SMACH_PATH", "").split(os.pathsep)
    return [*filter(None, known), *{str(Path(folder).parents[1]) for folder in named if folder}]


def end(process: subprocess.Popen[Any]) -> None:
    """End a process and what it has started: by SIGTERM, after 3 seconds by SIGKILL."""
    for signal_ in (signal.SIGTERM, signal.SIGKILL):
        if process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal_)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(3)
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            stream.close()


def wait_until(test: Any, what: str, seconds: float = 60.0) -> None:
    """Wait for something to become true."""
    limit = time.monotonic() + seconds
    while not test():
        assert time.monotonic() < limit, what
        time.sleep(0.005)
