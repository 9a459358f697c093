"""Candidates over a real XMPP server: presence, a file, a candidate, as the orchestrator does it.

It needs Debian's package `prosody` and `slixmpp`: `make test-xmpp`.
"""

from __future__ import annotations

import asyncio
import json
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from .conftest import MODEL, SCENARIO
from .test_serving import CANDIDATE

slixmpp = pytest.importorskip("slixmpp", reason="no slixmpp: make test-xmpp")
IBB = "http://jabber.org/protocol/ibb"
CONFIGURATION = """
modules_enabled = {{ "roster", "saslauth", "tls", "disco", "presence", "message", "iq" }}
modules_disabled = {{ "s2s" }}
authentication = "internal_plain"
data_path = "{folder}"
pidfile = "{folder}/pid"
interfaces = {{ "127.0.0.1" }}
c2s_ports = {{ {port} }}
run_as_root = true
log = {{ info = "{folder}/log" }}
VirtualHost "localhost"
  ssl = {{ key = "{folder}/key.pem"; certificate = "{folder}/certificate.pem" }}
"""


@pytest.fixture
def port(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Start a server with the accounts of an orchestrator and of a manager."""
    if shutil.which("prosody") is None:
        pytest.skip("no prosody: make test-xmpp")
    with closing(socket.socket()) as free:
        free.bind(("127.0.0.1", 0))
        port = int(free.getsockname()[1])
    certificate = "req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out certificate.pem -days 2"
    names = ["-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"]
    command = ["openssl", *certificate.split(), *names]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    monkeypatch.setenv("SSL_CERT_FILE", str(tmp_path / "certificate.pem"))
    file = tmp_path / "prosody.cfg.lua"
    file.write_text(CONFIGURATION.format(folder=tmp_path, port=port))
    for account in ("orchestrator", "manager1"):
        words = ["prosodyctl", "--config", str(file), "register", account, "localhost", "secret"]
        subprocess.run(words, check=True, capture_output=True)
    with subprocess.Popen(
        ["prosody", "-F", "--config", str(file)], stdout=subprocess.DEVNULL
    ) as it:
        yield port
        it.kill()


class Orchestrator(slixmpp.ClientXMPP):  # type: ignore[misc,name-defined]
    """Stand-in for the orchestrator, which configures a manager and runs a candidate on it."""

    def __init__(self) -> None:
        super().__init__("orchestrator@localhost/cpswarm", "secret")
        for name in ("xep_0030", "xep_0047", "xep_0065", "xep_0095", "xep_0096"):
            self.register_plugin(name)
        self.manager: asyncio.Queue[Any] = asyncio.Queue()
        self.messages: asyncio.Queue[Any] = asyncio.Queue()
        self.add_event_handler("session_start", self._begin)
        self.add_event_handler("presence_available", self._meet)
        self.add_event_handler("message", self.messages.put_nowait)

    async def _begin(self, _: Any) -> None:
        self.send_presence(pstatus='{"type":"SOO","SCID":"test"}')
        await self.get_roster()

    def _meet(self, presence: Any) -> None:
        if presence["from"].user.startswith("manager"):
            self.manager.put_nowait(presence)

    async def converse(self, port: int) -> list[Any]:
        """Return what the manager says: presence, acknowledgement, result."""
        self.connect("localhost", port)
        presence = await self.manager.get()
        to = presence["from"]
        found = await self.plugin["xep_0030"].get_info(to)
        assert (
            "http://jabber.org/protocol/si/profile/file-transfer"
            in (found["disco_info"]["features"])
        )
        methods = [{"value": IBB, "label": "in band"}]
        offered = await self.plugin["xep_0096"].request_file_transfer(
            to, sid="a", methods=methods, name="test.zip", size=9000, desc="test,gui:=false"
        )
        assert IBB in str(offered)
        stream = await self.plugin["xep_0047"].open_stream(to, sid="a")
        await stream.sendall(b"x" * 9000)
        await stream.close()
        configured = await self.messages.get()
        self.send_message(mto=to.bare, mbody=CANDIDATE % 5.0, mtype="chat")
        result = await self.messages.get()
        self.disconnect()
        return [
            json.loads(each) for each in (presence["status"], configured["body"], result["body"])
        ]


def test_the_orchestrator_configures_a_manager_and_gets_a_fitness(
    port: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "model.swarm").write_text(MODEL, encoding="utf-8")
    (tmp_path / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
    monkeypatch.setenv("SWARMDSL_XMPP_PASSWORD", "secret")
    account = f"manager1@localhost:{port}"
    words = ["serve", "model.swarm", "--scenario", "scenario.toml", "--xmpp", account]
    command = [sys.executable, "-m", "swarmdsl", *words]
    with subprocess.Popen(
        command, cwd=tmp_path, stderr=subprocess.PIPE, encoding="utf-8"
    ) as serving:

        async def talk() -> list[Any]:
            return await asyncio.wait_for(Orchestrator().converse(port), 60)

        try:
            status, configured, result = asyncio.run(talk())
        finally:
            serving.kill()

    assert status["capabilities"] == {"dimensions": 2, "maxAgents": 0}
    assert configured == {"type": "SimulatorConfigured", "success": True}
    assert (result["OID"], result["SID"], result["success"]) == ("test!0d7c", "3", True)

    monkeypatch.setenv("SWARMDSL_XMPP_PASSWORD", "wrong")
    refused = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert refused.returncode == 1
    assert f"error[SW1833]: cannot serve as `{account}`: the server refuses" in refused.stderr
