"""The server survives invalid messages, dead clients and unusual files."""

import json
import subprocess
import sys

import pytest

from swarmdsl.ide.server.features import FEATURES
from swarmdsl.ide.server.models import Models

from .model import MODEL, ROVER
from .test_process import SERVER, answer, message


class Raw:
    """Server that receives raw bytes."""

    def __init__(self):
        self.process = subprocess.Popen(
            SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self._last = 0

    def send(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def ask(self, method, params=None):
        self._last += 1
        self.send(message(id=self._last, method=method, params=params))
        return self.answer_to(self._last)

    def answer_to(self, identity):
        while (found := answer(self.process.stdout)).get("id") != identity:
            pass
        return found

    def initialize(self, folder=None):
        folders = [{"uri": folder.as_uri(), "name": "a"}] if folder else None
        return self.ask("initialize", {"capabilities": {}, "workspaceFolders": folders})

    def open(self, path, text):
        document = {"uri": path.as_uri(), "languageId": "swarm", "version": 1, "text": text}
        self.send(message(method="textDocument/didOpen", params={"textDocument": document}))

    def findings(self, path):
        self.send(message(id="settle", method="workspace/symbol", params={"query": "\0"}))
        while True:
            found = answer(self.process.stdout)
            params = found.get("params", {})
            if found.get("method", "").endswith("Diagnostics") and params["uri"] == path.as_uri():
                return params["diagnostics"]


@pytest.fixture
def raw():
    server = Raw()
    yield server
    server.process.stdin.close()
    server.process.stdin = None
    _, errors = server.process.communicate(timeout=60)
    assert b"Traceback" not in errors, errors.decode()


def test_invalid_messages(raw):
    assert raw.ask("textDocument/hover", {})["error"]["code"] == -32002
    raw.initialize()
    raw.send(b"Content-Length: 5\r\n\r\n{nope")
    assert raw.answer_to(None)["error"]["code"] == -32700
    for data in (b"[1, 2]", b"3", b'"text"', b"[" * 100_000, b"\xff\xfe{}"):
        raw.send(b"Content-Length: %d\r\n\r\n%s" % (len(data), data))
        assert raw.answer_to(None)["error"]["code"] in (-32600, -32700)
    raw.send(b"X-Other: 1\r\n\r\n" + b"content-length:2\r\nContent-Type: a\r\n\r\n{}")
    assert raw.ask("no/such")["error"]["code"] == -32601
    raw.send(message(id={"a": []}, method=["x"], params=7))
    raw.send(message(method="textDocument/didChange", params=[]))
    raw.send(message(method="$/unknown", params=None))
    raw.send(message(id=99, result=None))
    assert raw.ask("initialize", {})["error"]["code"] == -32600
    assert raw.ask("workspace/symbol", {"query": 5})["result"] == []


def test_invalid_params(raw, tmp_path):
    """Requests with missing or invalid params are answered."""
    path = tmp_path / "a.swarm"
    raw.initialize(tmp_path)
    raw.open(path, MODEL)
    document = {"uri": path.as_uri()}
    far = {"line": 10**9, "character": -5}
    for method in (name for features in FEATURES.values() for name in features):
        for params in (
            None,
            [],
            {},
            {"textDocument": None},
            {"textDocument": {"uri": 5}},
            {"textDocument": {"uri": "untitled:1"}, "position": far},
            {"textDocument": document, "position": {"line": "x"}},
            {"textDocument": document, "position": far, "range": {"start": far, "end": far}}
            | {"positions": [far], "newName": "x", "item": {}, "data": 5, "query": None},
            {"item": {"uri": document["uri"], "selectionRange": {"start": None}}},
            {"data": {"uri": [], "position": far}},
        ):
            code = raw.ask(method, params).get("error", {}).get("code")
            assert code in (None, -32602, -32803), (method, params)
    for method in ("didOpen", "didChange", "didClose"):
        for params in ({}, {"textDocument": {"uri": document["uri"], "text": 5}}):
            raw.send(message(method=f"textDocument/{method}", params=params))
    changes = [{"text": 5}, {"range": {}, "text": ""}, 3]
    for change in changes:
        params = {"textDocument": {**document, "version": 2}, "contentChanges": [change]}
        raw.send(message(method="textDocument/didChange", params=params))
    raw.send(message(method="workspace/didChangeWatchedFiles", params={"changes": [5, {}]}))
    raw.send(message(method="workspace/didChangeWorkspaceFolders", params={"event": 5}))
    assert raw.ask("workspace/symbol", {"query": "Patrol"})["result"] == []
    raw.open(path, MODEL)
    assert len(raw.ask("workspace/symbol", {"query": "Patrol"})["result"]) == 1


@pytest.mark.parametrize("data", [b"x" * 10**6, b"Content-Length: 999999999999\r\n\r\n"])
def test_invalid_framing_ends_the_server(data):
    ran = subprocess.run(SERVER, input=data, capture_output=True, timeout=60)
    assert (ran.returncode, ran.stdout, ran.stderr) == (1, b"", b"")


def test_cancelled_requests(raw, tmp_path):
    raw.initialize(tmp_path)
    query = message(id="a", method="workspace/symbol", params={"query": ""})
    cancel = message(method="$/cancelRequest", params={"id": "b"})
    other = message(id="b", method="workspace/symbol", params={"query": ""})
    raw.open(tmp_path / "a.swarm", MODEL)
    raw.send(query + other + cancel)
    assert "result" in raw.answer_to("a")
    answered = raw.answer_to("b")
    assert "result" in answered or answered["error"]["code"] == -32800


def test_shutdown_and_exit(raw):
    raw.initialize()
    assert raw.ask("shutdown")["result"] is None
    assert raw.ask("workspace/symbol", {"query": ""})["error"]["code"] == -32002
    raw.send(message(method="exit"))
    assert raw.process.wait(20) == 0


def test_dead_client_with_open_pipe():
    client = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    server = Raw()
    server.ask("initialize", {"processId": client.pid, "capabilities": {}})
    client.communicate()
    assert server.process.wait(30) == 1
    server.process.communicate()


def test_two_editors(tmp_path):
    """Each editor has its own server and its own text."""
    first, second = Raw(), Raw()
    path = tmp_path / "a.swarm"
    path.write_text(MODEL)
    try:
        for server, text in ((first, MODEL), (second, MODEL.replace("-> Home", "-> Hone", 1))):
            server.initialize(tmp_path)
            server.open(path, text)
        assert first.findings(path) == []
        assert len(second.findings(path)) == 1
    finally:
        for server in (first, second):
            server.process.communicate(timeout=60)


@pytest.mark.timeout(60)
def test_file_of_5_mb(raw, tmp_path):
    raw.initialize(tmp_path)
    path = tmp_path / "large.swarm"
    text = "const A : int32 = 5 // much\n" * 190_000
    raw.open(path, text)
    [found] = raw.findings(path)
    assert found["code"] == "SW1217"
    raw.open(path, MODEL)
    assert raw.findings(path) == []


def codes(models):
    return [each.code for _, _, found in models.diagnostics() for each in found]


def test_closed_file_that_is_not_utf_8(tmp_path):
    (tmp_path / "swarm.toml").write_text("[project]\n")
    (tmp_path / "latin.swarm").write_bytes("// gr\xfcn\n".encode("latin-1"))
    models = Models()
    (tmp_path / "patrol.swarm").write_text(MODEL, encoding="utf-8")
    models.edit(tmp_path / "patrol.swarm", MODEL)
    assert codes(models) == ["SW0004"]
    models.edit(tmp_path / "latin.swarm", "const A : int32 = 5\n")
    assert codes(models) == []


def test_file_name_that_is_not_utf_8(raw, tmp_path):
    (tmp_path / "swarm.toml").write_text("[project]\n")
    with open(bytes(tmp_path) + b"/\xff.swarm", "w") as file:  # noqa: PTH123 - no str has it
        file.write("const A : int32 = B\n")
    raw.initialize(tmp_path)
    raw.open(tmp_path / "a.swarm", "const A : int32 = C\n")
    assert [each["code"] for each in raw.findings(tmp_path / "a.swarm")] == ["SW0202"]


def test_renamed_file(tmp_path):
    (tmp_path / "swarm.toml").write_text("[project]\n")
    old, new = tmp_path / "patrol.swarm", tmp_path / "tour.swarm"
    old.write_text(MODEL)
    models = Models()
    models.edit(old, MODEL)
    models.edit(tmp_path / "rover.swarm", ROVER)
    assert codes(models) == []
    old.rename(new)
    models.close(old)
    models.refresh([old, new])
    models.edit(new, MODEL)
    assert "SW0001" in codes(models)
    models.edit(tmp_path / "rover.swarm", ROVER.replace("patrol.swarm", "tour.swarm"))
    assert codes(models) == []


def test_closed_files_are_released(tmp_path):
    models = Models()
    for number in range(3):
        path = tmp_path / str(number) / "a.swarm"
        models.edit(path, MODEL)
        assert models.file(path) is not None
        models.close(path)
        assert models.all() == []
    assert json.dumps(list(map(str, models._projects))) == "[]"
    assert (models._texts, models._changed, models._workspaces) == ({}, {}, {})


def test_failed_workspace_is_rebuilt(tmp_path, monkeypatch):
    """A workspace with a partial update is not used again after an internal error."""
    from swarmdsl.driver.workspace import Workspace

    models = Models()
    path = tmp_path / "a.swarm"
    models.edit(path, MODEL)
    assert codes(models) == []
    with monkeypatch.context() as patch:
        patch.setattr(Workspace, "update", lambda *_: 1 / 0)
        models.edit(path, MODEL.replace("-> Home", "-> Hone", 1))
        with pytest.raises(ZeroDivisionError):
            codes(models)
    assert codes(models) == ["SW0202"]
