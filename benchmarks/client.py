"""Minimal client of a language server; it waits for each answer."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

from measure import ENVIRONMENT


class Client:
    """Server process for a folder, and its messages."""

    def __init__(self, command: Sequence[str], folder: Path) -> None:
        self.started = perf_counter()
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=ENVIRONMENT
        )
        self._last = 0
        capabilities = {"textDocument": {"publishDiagnostics": {}}}
        folders = [{"uri": folder.as_uri(), "name": folder.name}]
        self.ask(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": folder.as_uri(),
                "capabilities": capabilities,
                "workspaceFolders": folders,
            },
        )
        self.tell("initialized", {})

    def open(self, file: Path, text: str) -> None:
        """Open a file and wait for its diagnostics."""
        document = {"uri": file.as_uri(), "languageId": "swarm", "version": 1, "text": text}
        self.tell("textDocument/didOpen", {"textDocument": document})
        self.wait_for_diagnostics(file)

    def type(self, file: Path, version: int, line: int, character: int, text: str) -> None:
        """Insert a string at a position, or delete one character if it is empty."""
        start = {"line": line, "character": character}
        end = {"line": line, "character": character + (not text)}
        change = {"range": {"start": start, "end": end}, "text": text}
        self.tell(
            "textDocument/didChange",
            {
                "textDocument": {"uri": file.as_uri(), "version": version},
                "contentChanges": [change],
            },
        )

    def wait_for_diagnostics(self, file: Path) -> None:
        """Wait for the next diagnostics of a file."""
        self._until(
            lambda message: (
                message.get("method") == "textDocument/publishDiagnostics"
                and message["params"]["uri"] == file.as_uri()
            )
        )

    def ask(self, method: str, params: Any) -> Any:
        """Send a request and wait for the answer."""
        self._last += 1
        self._send({"id": self._last, "method": method, "params": params})
        answer = self._until(lambda message: message.get("id") == self._last)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]

    def tell(self, method: str, params: Any) -> None:
        """Send a notification."""
        self._send({"method": method, "params": params})

    @property
    def cpu(self) -> float:
        """CPU seconds used so far by the threads of the server."""
        tasks = Path(f"/proc/{self._process.pid}/task").glob("*/schedstat")
        return sum(int(each.read_text(encoding="utf-8").split()[0]) for each in tasks) / 1e9

    @property
    def memory(self) -> int:
        """Peak memory in bytes."""
        lines = self._system("status").splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) * 1024

    def close(self) -> None:
        """End the server."""
        self.ask("shutdown", None)
        self.tell("exit", None)
        self._process.communicate(timeout=30)

    def _system(self, name: str) -> str:
        return Path(f"/proc/{self._process.pid}/{name}").read_text(encoding="utf-8")

    def _send(self, message: dict[str, Any]) -> None:
        assert self._process.stdin is not None
        content = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))
        self._process.stdin.flush()

    def _until(self, wanted: Callable[[Any], bool]) -> Any:
        assert self._process.stdout is not None
        while True:
            length = 0
            while line := self._process.stdout.readline().strip():
                name, _, value = line.partition(b":")
                if name.lower() == b"content-length":
                    length = int(value)
            if not length:
                raise RuntimeError("the server is gone")
            message = json.loads(self._process.stdout.read(length))
            if "method" in message and "id" in message:  # a request of the server
                self._send({"id": message["id"], "result": None})
            elif wanted(message):
                return message
