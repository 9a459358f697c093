"""Tests of an idle server."""

import gc
import io
import json
import os
import threading

import pytest

from swarmdsl.ide.server import server, support
from swarmdsl.ide.server.io import Incoming, Outgoing

INITIALIZE = {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}


@pytest.fixture
def collected(monkeypatch):
    """Return an event that is set by garbage collections."""
    event = threading.Event()
    monkeypatch.setattr(gc, "collect", lambda *_: event.set() or 0)
    return event


def run(*messages, until):
    """Serve messages until an event; return the output of the server."""
    reader, writer = os.pipe()
    out = io.BytesIO()
    running = server.Server(Outgoing(out))
    with os.fdopen(reader, "rb") as incoming, os.fdopen(writer, "wb", buffering=0) as client:
        serving = threading.Thread(target=running.serve, args=(Incoming(incoming),))
        serving.start()
        for message in messages:
            content = json.dumps(message).encode()
            client.write(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))
        happened = until.wait(20)
        client.close()
        serving.join(20)
    assert happened
    return out.getvalue().decode()


def test_idle_server_loads_modules(collected, monkeypatch):
    done = []
    monkeypatch.setattr(support, "load_generators", lambda: done.append("targets"))
    monkeypatch.setattr(server, "parse", lambda source, report: done.append(source.text))
    run(INITIALIZE, until=collected)
    assert done == ["targets", "event"]


def test_errors_while_idle_are_logged(collected, monkeypatch, capsys):
    monkeypatch.setattr(support, "load_generators", lambda: 1 / 0)
    assert "internal error: division by zero" in run(INITIALIZE, until=collected)
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_busy_server_collects_garbage(collected, monkeypatch):
    monkeypatch.setattr(server, "_MESSAGES_PER_COLLECTION", 3)
    monkeypatch.setattr(server, "_IDLE_AFTER", 60)
    ask = {"jsonrpc": "2.0", "id": 2, "method": "workspace/symbol", "params": {"query": "a"}}
    assert '"id": 2' in run(INITIALIZE, ask, ask, until=collected)


def test_server_with_many_new_objects_collects_garbage(collected, monkeypatch):
    monkeypatch.setattr(server, "_IDLE_AFTER", 60)
    monkeypatch.setattr(server, "_new_objects", lambda: server._OBJECTS_PER_COLLECTION)
    assert '"id": 1' in run(INITIALIZE, until=collected)


def test_new_objects_are_counted_without_automatic_collection():
    gc.disable()
    try:
        gc.collect()
        kept = [[] for _ in range(1000)]
        # Some of those that were counted may be free by now, but not these.
        assert server._new_objects() >= len(kept)
    finally:
        gc.enable()
