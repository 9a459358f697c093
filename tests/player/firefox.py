"""Firefox, driven by Marionette: playwright drives builds of its own only.

A message is `LENGTH:JSON`; JSON is `[0, number, command, parameters]` there, and
`[1, number, error, result]` back (https://firefox-source-docs.mozilla.org/testing/marionette/).
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import time
from pathlib import Path
from typing import Any

_PREFERENCES = {
    "marionette.port": 0,  # a free one, which the profile tells
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "toolkit.telemetry.reportingpolicy.firstRun": False,
    "app.update.disabledForTesting": True,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
}
_PATIENCE = 120


class Firefox:
    """A Firefox without a window, with a new profile in a folder."""

    def __init__(self, program: str, folder: Path) -> None:
        lines = [f"user_pref({json.dumps(k)}, {json.dumps(v)});" for k, v in _PREFERENCES.items()]
        (folder / "user.js").write_text("\n".join(lines), encoding="utf-8")
        command = [program, "--headless", "--marionette", "--no-remote", "--profile", str(folder)]
        environment = {**os.environ, "HOME": str(folder), "MOZ_CRASHREPORTER_DISABLE": "1"}
        self._process = subprocess.Popen(
            command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        try:
            self._socket = socket.create_connection(("127.0.0.1", self._port(folder)), _PATIENCE)
            self._rest = b""
            self._number = 0
            self._receive()
            self.ask("WebDriver:NewSession", {"capabilities": {}})
        except BaseException:
            self._process.kill()
            self._process.wait()
            raise

    def ask(self, command: str, parameters: dict[str, Any]) -> Any:
        """Return the result of a command."""
        self._number += 1
        text = json.dumps([0, self._number, command, parameters]).encode()
        self._socket.sendall(b"%d:%s" % (len(text), text))
        _, number, error, result = self._receive()
        assert (number, error) == (self._number, None)
        return result

    def open(self, address: str) -> None:
        """Open a page, and wait until it is there."""
        self.ask("WebDriver:Navigate", {"url": address})

    def value(self, expression: str) -> Any:
        """Return the value of an expression about the `player` of the page, once it is ready.

        It is no script of the page, which its policy would not let run.
        """
        script = f"""const [done] = arguments;
        const look = () => {{
          if (!document.documentElement.dataset.ready) return setTimeout(look, 20);
          const {{ player }} = window.wrappedJSObject;
          done(JSON.stringify({expression}));
        }};
        look();"""
        asked = {"script": script, "args": [], "sandbox": "default"}
        return json.loads(self.ask("WebDriver:ExecuteAsyncScript", asked)["value"])

    def close(self) -> None:
        """End it."""
        self.ask("Marionette:Quit", {"flags": ["eForceQuit"]})
        self._socket.close()
        self._process.wait(_PATIENCE)

    def _port(self, folder: Path) -> int:
        """Return the port of the profile as soon as Firefox listens to it."""
        path = folder / "MarionetteActivePort"
        end = time.monotonic() + _PATIENCE
        while not (path.exists() and path.read_text(encoding="utf-8")):
            assert self._process.poll() is None
            assert time.monotonic() < end
            time.sleep(0.05)
        return int(path.read_text(encoding="utf-8"))

    def _receive(self) -> Any:
        while b":" not in self._rest:
            self._rest += self._read()
        length, _, rest = self._rest.partition(b":")
        while len(rest) < int(length):
            rest += self._read()
        self._rest = rest[int(length) :]
        return json.loads(rest[: int(length)])

    def _read(self) -> bytes:
        data = self._socket.recv(1 << 16)
        assert data, "Firefox has ended"
        return data
