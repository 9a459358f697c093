"""Client of the Debug Adapter Protocol, with an adapter in a thread of its own."""

from __future__ import annotations

import json
import os
import threading
from pathlib import Path
from types import TracebackType
from typing import Any

from swarmdsl.ide.debugger.messages import Connection
from swarmdsl.ide.debugger.session import Session
from swarmdsl.ide.server.io import Incoming, Outgoing


class RefusedError(Exception):
    """The adapter has refused a request."""


class Client:
    """Sends requests and keeps what comes; a message that is awaited ends each wait."""

    def __init__(self) -> None:
        reading, self._to = os.pipe()
        self._from, writing = os.pipe()
        streams = os.fdopen(reading, "rb"), os.fdopen(writing, "wb")
        session = Session(Connection(Incoming(streams[0]), Outgoing(streams[1])))
        self._received = os.fdopen(self._from, "rb")
        self._failure: BaseException | None = None
        self.events: list[dict[str, Any]] = []
        self.output = ""
        self._answers: dict[int, dict[str, Any]] = {}
        self._number = 0

        def serve() -> None:
            try:
                session.serve()
            except BaseException as error:
                self._failure = error
            finally:
                for stream in streams:
                    stream.close()

        self._thread = threading.Thread(target=serve, daemon=True)
        self._thread.start()

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        os.close(self._to)
        while self._received.read(1 << 16):
            pass
        self._received.close()
        self._thread.join()
        assert self._failure is None, self._failure

    # ---- messages

    def write(self, message: object) -> None:
        body = json.dumps(message).encode()
        os.write(self._to, b"Content-Length: %d\r\n\r\n%s" % (len(body), body))

    def _read(self) -> dict[str, Any] | None:
        length = 0
        while (line := self._received.readline()).strip():
            length = int(line.partition(b":")[2])
        if not line:
            return None
        message: dict[str, Any] = json.loads(self._received.read(length))
        if message["type"] == "event":
            self.events.append(message)
            self.output += message["body"].get("output", "")
        else:
            self._answers[message["request_seq"]] = message
        return message

    def request(self, command: str, **arguments: Any) -> dict[str, Any]:
        """Send a request; return the body of the answer, or raise RefusedError."""
        self._number += 1
        self.write(
            {"seq": self._number, "type": "request", "command": command, "arguments": arguments}
        )
        while self._number not in self._answers:
            assert self._read() is not None, f"no answer to {command}"
        answer = self._answers.pop(self._number)
        assert answer["command"] == command
        if not answer["success"]:
            raise RefusedError(answer["message"])
        body: dict[str, Any] = answer["body"]
        return body

    def await_event(self, *names: str) -> dict[str, Any]:
        """Return the next event of these names that was not awaited yet, with its name."""
        while True:
            for number, each in enumerate(self.events):
                if each["event"] in names:
                    del self.events[: number + 1]
                    return {**each["body"], "event": each["event"]}
            assert self._read() is not None, f"no {names}"

    # ---- sessions

    def launch(self, lines: dict[Path, list[Any]] | None = None, **arguments: Any) -> list[Any]:
        """Launch and run with breakpoints; return what the adapter says about these."""
        self.request("initialize", adapterID="swarm")
        self.request("launch", **arguments)
        self.await_event("initialized")
        said = []
        for path, asked in (lines or {}).items():
            given = [{"line": each} if isinstance(each, int) else each for each in asked]
            source = {"path": str(path)}
            answer = self.request("setBreakpoints", source=source, breakpoints=given)
            said += answer["breakpoints"]
        self.request("configurationDone")
        return said

    def stop(self) -> dict[str, Any]:
        """Wait until the run stands still; say why, with the top frame of the thread."""
        stopped = self.await_event("stopped", "terminated")
        assert stopped["event"] == "stopped", self.events
        stopped["frame"] = self.stack(stopped["threadId"])[0]
        return stopped

    def go(self, command: str, thread: int = 1) -> dict[str, Any]:
        """Go on, and wait until the run stands still again."""
        self.request(command, threadId=thread)
        return self.stop()

    def stack(self, thread: int) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = self.request("stackTrace", threadId=thread)["stackFrames"]
        return found

    def scopes(self, thread: int) -> dict[str, dict[str, str]]:
        """Return the variables of the top frame, by scope, as texts."""
        frame = self.stack(thread)[0]["id"]
        scopes = self.request("scopes", frameId=frame)["scopes"]
        return {
            scope["name"]: {
                each["name"]: each["value"] for each in self.variables(scope["variablesReference"])
            }
            for scope in scopes
        }

    def variables(self, number: int) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = self.request("variables", variablesReference=number)[
            "variables"
        ]
        return found

    def value(self, expression: str, context: str = "watch") -> str:
        result: str = self.request("evaluate", expression=expression, context=context)["result"]
        return result
