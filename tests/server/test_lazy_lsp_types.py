"""Lazily defined protocol types equal those of `lsprotocol`."""

import re
import subprocess
import sys

LOAD = """
from swarmdsl.ide.server import lazy_lsp_types
lazy_lsp_types.load()
"""
MESSAGES = [
    {"id": 1, "method": "textDocument/hover", "params": {
        "textDocument": {"uri": "file:///a"}, "position": {"line": 1, "character": 2}}},
    {"method": "textDocument/didChange", "params": {
        "textDocument": {"uri": "file:///a", "version": 3},
        "contentChanges": [{"text": "x"}, {"text": "", "range": {
            "start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 1}}}]}},
    {"id": "a", "method": "initialize", "params": {"processId": None, "rootUri": None,
        "capabilities": {"general": {"positionEncodings": ["utf-8"]},
            "textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}}},
]  # fmt: skip
USE = f"""
import attrs, json
from lsprotocol import types
from pygls.protocol import default_converter

converter = default_converter()
for message in {MESSAGES!r}:
    cls = types.METHOD_TO_TYPES[message["method"]][0]
    read = converter.structure({{"jsonrpc": "2.0", **message}}, cls)
    print(repr(read), json.dumps(converter.unstructure(read)), read == read)
for name, cls in types.ALL_TYPES_MAP.items():
    if isinstance(cls, type) and attrs.has(cls):
        print(cls, cls.__doc__, cls.__match_args__, [repr(each) for each in attrs.fields(cls)])
"""


def run(program):
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "")
    return ran.stdout


def test_started_server_has_defined_few_types():
    unfinished = run(f"""{LOAD}
from swarmdsl.ide.server.server import Server
Server(None)
print(len(lazy_lsp_types.unfinished()))
""")
    assert int(unfinished) > 450


def test_lazy_types_equal_eager_types():
    at_once = run(USE)
    assert "TextDocumentContentChangePartial" in at_once
    assert re.sub(r" at 0x\w+", "", run(LOAD + USE)) == re.sub(r" at 0x\w+", "", at_once)


def test_two_threads_use_the_same_type():
    found = run(f"""{LOAD}
import attrs, threading
from lsprotocol import types

waiting = list(lazy_lsp_types.unfinished())
start, done = threading.Barrier(4), []

def all_of_them():
    start.wait()
    for cls in waiting:
        attrs.fields(cls)
        done.append(types.Position(line=0, character=1))

threads = [threading.Thread(target=all_of_them) for _ in range(4)]
for each in threads:
    each.start()
for each in threads:
    each.join()
print(len(waiting), len(done), len(lazy_lsp_types.unfinished()))
""")
    waiting, done, unfinished = map(int, found.split())
    assert waiting > 500
    assert (done, unfinished) == (4 * waiting, 0)


def test_the_protocol_types_are_still_defined_when_they_are_imported() -> None:
    """Once `lsprotocol` defines its types lazily, `lazy_lsp_types` can be removed."""
    program = """
import attrs
calls = []
define = attrs.define
attrs.define = lambda cls=None, **options: (calls.append(cls), define(cls, **options))[1]
import lsprotocol.types
print(len(calls))
"""
    assert int(run(program)) > 400, "remove swarmdsl.ide.server.lazy_lsp_types"
