"""Debug adapter in a process of its own, for a client in this one."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from threading import Lock, Thread
from typing import Any, BinaryIO, cast

from swarmdsl.ide.debugger.messages import Connection, RequestError
from swarmdsl.ide.server.io import Incoming, Outgoing

# Python would import modules from the folder that it starts in: this one has none.
_FOLDER = Path(__file__).resolve().parent / "page"
_ENDED = "the simulation has ended"

Told = Callable[["Adapter", str, Mapping[str, Any]], None]


class Adapter:
    """Process of `swarmc debug`: a model that never comes back cannot hold the client.

    `told` is called in another thread with each event and its body, at last with `gone` and the
    exit code of the process.
    """

    def __init__(self, told: Told) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", "swarmdsl", "debug"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            cwd=_FOLDER,
            # Ctrl-C in the terminal is for the client, which ends the process.
            start_new_session=True,
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        streams = self._process.stdout, self._process.stdin
        self._streams = cast("tuple[BinaryIO, BinaryIO]", streams)
        self._connection = Connection(Incoming(self._streams[0]), Outgoing(self._streams[1]))
        self._told = told
        self._lock = Lock()
        self._waiting: dict[int, SimpleQueue[Any]] = {}
        self._number = 0
        self._is_gone = False
        Thread(target=self._read, daemon=True).start()

    def request(self, command: str, arguments: Mapping[str, Any]) -> Mapping[str, Any]:
        """Send a request, and return the body of the answer; raise RequestError if refused."""
        answers: SimpleQueue[Any] = SimpleQueue()
        with self._lock:
            if self._is_gone:
                raise RequestError(_ENDED)
            self._number += 1
            self._waiting[self._number] = answers
            self._connection.write(
                {
                    "seq": self._number,
                    "type": "request",
                    "command": command,
                    "arguments": arguments,
                }
            )
        answer = answers.get()
        if answer is None:
            raise RequestError(_ENDED)
        if not answer["success"]:
            raise RequestError(answer["message"])
        body: Mapping[str, Any] = answer["body"]
        return body

    def kill(self) -> None:
        """End the process, whatever it does; wait for that."""
        self._process.kill()
        self._process.wait()

    def _read(self) -> None:
        while message := self._connection.read():
            if message["type"] == "event":
                self._told(self, message["event"], message["body"])
                continue
            with self._lock:
                answers = self._waiting.pop(message["request_seq"])
            answers.put(message)
        code = self._process.wait()
        with self._lock:
            self._is_gone = True
            for answers in self._waiting.values():
                answers.put(None)
        for stream in self._streams:
            with suppress(OSError):  # what was not written yet
                stream.close()
        self._told(self, "gone", {"code": code})
