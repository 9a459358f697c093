"""`swarmc preview` in a process of its own, and a client of its pages."""

from __future__ import annotations

import http.client
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

PATIENCE = 60


class Browser:
    """HTTP client of a preview page that receives its events."""

    def __init__(self, port: int) -> None:
        self.port = port
        self._events: http.client.HTTPResponse | None = None

    def get(self, path: str, host: str | None = None) -> http.client.HTTPResponse:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        connection.request("GET", path, headers={"Host": host or f"127.0.0.1:{self.port}"})
        return connection.getresponse()

    def picture(self, id_: str) -> Any:
        return json.loads(self.get(f"/picture?id={id_}").read())

    def post(self, path: str, body: str, headers: dict[str, str]) -> http.client.HTTPResponse:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        connection.request("POST", path, body, headers)
        return connection.getresponse()

    def opened(self, place: object) -> Any:
        answer = self.post("/open", json.dumps(place), {"Content-Type": "application/json"})
        return json.loads(answer.read())

    def leave(self) -> None:
        """Close the event stream."""
        assert self._events is not None
        self._events.close()

    def told(self) -> Any:
        """Return the next message."""
        if self._events is None:
            self._events = self.get("/events")
        while True:
            line = self._events.readline().decode()
            assert line, "nothing more is told"
            if line.startswith("data: "):
                return json.loads(line.removeprefix("data: "))


@contextmanager
def served(model: Path, *options: str, named: bool = True) -> Iterator[Browser]:
    paths = [model.name] if named else []
    command = [sys.executable, "-m", "swarmdsl", "preview", *paths, *options]
    process = subprocess.Popen(
        command,
        cwd=model.parent,
        # No editor was found.
        env={**os.environ, "PATH": os.defpath},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout is not None
    address = None
    while address is None:
        line = process.stdout.readline()
        assert line, "it ended"
        address = re.search(r"http://127\.0\.0\.1:(\d+)/(?=\s|$)", line)
    try:
        yield Browser(int(address[1]))
    finally:
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, said
