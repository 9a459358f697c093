"""Tests of the server process: start and end."""

import json
import socket
import subprocess
import sys
import time

import pytest

SERVER = [sys.executable, "-m", "swarmdsl", "lsp"]


def message(**content):
    text = json.dumps({"jsonrpc": "2.0", **content}).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(text), text)


INITIALIZE = message(id=1, method="initialize", params={"capabilities": {}})


def answer(stream):
    header = stream.readline()
    while stream.readline().strip():
        pass
    return json.loads(stream.read(int(header.split(b":")[1])))


def capabilities(stream):
    return answer(stream)["result"]["capabilities"]


def test_server_ends_with_its_editor():
    process = subprocess.Popen(
        SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    process.stdin.write(INITIALIZE)
    process.stdin.flush()
    assert capabilities(process.stdout)["hoverProvider"]
    _, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (1, b"")


def test_server_registers_file_watchers():
    process = subprocess.Popen(SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    watching = {"workspace": {"didChangeWatchedFiles": {"dynamicRegistration": True}}}
    process.stdin.write(message(id=1, method="initialize", params={"capabilities": watching}))
    process.stdin.write(message(method="initialized", params={}))
    process.stdin.flush()
    capabilities(process.stdout)
    asked = answer(process.stdout)
    process.communicate(timeout=60)
    assert asked["method"] == "client/registerCapability"
    [registration] = asked["params"]["registrations"]
    watchers = registration["registerOptions"]["watchers"]
    assert {"globPattern": "**/*.swarm"} in watchers


def test_lenses_use_commands_of_the_editor(tmp_path):
    uri = (tmp_path / "a.swarm").as_uri()
    document = {"uri": uri, "languageId": "swarm", "version": 1, "text": "swarm One { }\n"}
    commands = ["swarmdsl.preview", "swarmdsl.references"]
    options = {"capabilities": {}, "initializationOptions": {"commands": commands}}
    process = subprocess.Popen(SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    for each in (
        message(id=1, method="initialize", params=options),
        message(method="textDocument/didOpen", params={"textDocument": document}),
        message(id=2, method="textDocument/codeLens", params={"textDocument": {"uri": uri}}),
    ):
        process.stdin.write(each)
    process.stdin.flush()
    capabilities(process.stdout)
    uses, preview = answer(process.stdout)["result"]
    process.stdin.write(message(id=3, method="codeLens/resolve", params=uses))
    process.stdin.flush()
    while (resolved := answer(process.stdout)).get("id") != 3:
        pass
    process.communicate(timeout=60)
    assert preview["command"]["arguments"] == [uri, {"kind": "swarm", "name": "One"}]
    command = resolved["result"]["command"]
    assert (command["title"], command["command"]) == ("0 references", "swarmdsl.references")
    assert command["arguments"] == [uri, uses["range"]["start"], []]


def test_properties_and_swarms_have_lenses_that_run_them(tmp_path):
    (tmp_path / "a.swarmtest.toml").touch()
    uri = (tmp_path / "a.swarm").as_uri()
    text = "swarm event Go : std_msgs/Empty\nswarm One { }\nproperty Quiet of One : never Go\n"
    document = {"uri": uri, "languageId": "swarm", "version": 1, "text": text}
    offers = ("simulate", "debug", "verify", "build", "test")
    commands = [f"swarmdsl.{each}" for each in offers]
    options = {"capabilities": {}, "initializationOptions": {"commands": commands}}
    process = subprocess.Popen(SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    for each in (
        message(id=1, method="initialize", params=options),
        message(method="textDocument/didOpen", params={"textDocument": document}),
        message(id=2, method="textDocument/codeLens", params={"textDocument": {"uri": uri}}),
    ):
        process.stdin.write(each)
    process.stdin.flush()
    capabilities(process.stdout)
    lenses = [each for each in answer(process.stdout)["result"] if "command" in each]
    process.communicate(timeout=60)
    swarm = {"kind": "swarm", "name": "One"}
    quiet = {"kind": "property", "name": "Quiet"}
    assert [(each["range"]["start"]["line"], *each["command"].values()) for each in lenses] == [
        (1, "Simulate", "swarmdsl.simulate", [uri, swarm]),
        (1, "Debug", "swarmdsl.debug", [uri, swarm]),
        (1, "Verify", "swarmdsl.verify", [uri, swarm]),
        (1, "Build", "swarmdsl.build", [uri, swarm]),
        (1, "Test", "swarmdsl.test", [uri, swarm]),
        (2, "Check in simulation", "swarmdsl.simulate", [uri, quiet]),
        (2, "Verify", "swarmdsl.verify", [uri, quiet]),
    ]


def test_server_on_a_loopback_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    process = subprocess.Popen([*SERVER, "--tcp", str(port)], stderr=subprocess.PIPE)
    try:
        deadline = time.monotonic() + 60
        while True:
            try:
                connection = socket.create_connection(("127.0.0.1", port))
                break
            except OSError:
                assert time.monotonic() < deadline
                time.sleep(0.1)
        with connection, connection.makefile("rwb") as stream:
            stream.write(INITIALIZE)
            stream.flush()
            assert capabilities(stream)["completionProvider"]
        process.wait(20)
    finally:
        process.kill()
        process.communicate()


@pytest.mark.parametrize("arguments", ["--tcp 0", "--tcp x", "--stdio --tcp 5007"])
def test_invalid_command_line(arguments):
    ran = subprocess.run([*SERVER, *arguments.split()], capture_output=True, text=True)
    assert ran.returncode == 2
    assert "Usage:" in ran.stderr


def test_a_port_that_is_taken():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        ran = subprocess.run([*SERVER, "--tcp", port], capture_output=True, text=True, timeout=60)
    assert (ran.returncode, "already in use" in ran.stderr) == (1, True)
