"""The bridge configuration: its keys, and matching senders and receivers."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import NoOptions
from swarmdsl.codegen.exchange import swarmros
from swarmdsl.ir import System

Compile = Callable[[str], System]

TOKEN = re.compile(
    r"""(?P<skip>[\s,;]+|\#[^\n]*) | (?P<text>"(?:\\.|[^"\\])*") | (?P<number>-?[0-9]+)
    | (?P<word>[A-Za-z*][\w*-]*) | (?P<sign>[={}()])""",
    re.VERBOSE,
)


def parsed(text: str) -> dict[str, Any]:
    """Parse a libconfig file: groups as dicts, lists as lists (part of its grammar)."""
    tokens, at = [], 0
    while at < len(text):
        found = TOKEN.match(text, at)
        assert found, text[at : at + 20]
        at = found.end()
        if found.lastgroup != "skip":
            tokens.append(found[0])
    tokens.reverse()

    def group(end: str) -> dict[str, Any]:
        items: dict[str, Any] = {}
        while tokens and tokens[-1] != end:
            name, equals = tokens.pop(), tokens.pop()
            assert equals == "="
            assert name not in items
            items[name] = value()
        return items

    def value() -> Any:
        token = tokens.pop()
        if token == "{":
            items = group("}")
            assert tokens.pop() == "}"
            return items
        if token == "(":
            elements = []
            while tokens[-1] != ")":
                elements.append(value())
            tokens.pop()
            return elements
        if token.startswith('"'):
            return json.loads(re.sub(r"\\x", r"\\u00", token))
        return {"true": True, "false": False}[token] if token.isalpha() else int(token)

    made = group("")
    assert not tokens
    return made


MODEL = """
message Seen { header : std_msgs/Header, swarmio : swarmros/EventHeader, id : string }
swarm event Sight : Seen
swarm event Bid   : Seen on "auction/bid"
function auction : swarm {
  action "auction" : Go
  in  "bridge/events/auction/bid" : Seen
  in  "bridge/events/help"        : Seen
  out "help"                      : Seen
}
sensor Eye { out sight : Seen on "sight"; in light : std_msgs/Bool on "light" }
/// Looks around.
member Scout {
  behavior Look
  eye : Eye
  communication zyre { ifname = "wlan\\"0", port = 34000, name = "scout", device_class = "drone" }
}
member Worker { behavior Work }
member Rock { }
endless statemachine Look {
  initial A
  state A { entry / send Bid; on Low -> B }
  state B { do auction; on succeeded, aborted -> A }
}
endless statemachine Work { initial A; state A { on Sight, Bid -> A } }
"""


def emitted(system: System, *expected: str) -> dict[str, dict[str, Any]]:
    report = Diagnostics()
    files = {file.path: file.text for file in swarmros.emit(system, NoOptions(), report)}
    assert [found.message for found in report] == list(expected)
    return {path: parsed(text) for path, text in files.items()}


def test_endpoints(compiled: Compile) -> None:
    files = emitted(compiled(MODEL))

    assert set(files) == {"scout.cfg", "worker.cfg"}
    assert files["scout.cfg"]["endpoint"] == {
        "name": "scout",
        "deviceClass": "drone",
        "type": "zyre",
        "parameters": {"ifname": 'wlan"0', "port": 34000},
    }
    assert files["worker.cfg"]["endpoint"] == {
        "name": "Worker",
        "deviceClass": "Worker",
        "type": "zyre",
        "parameters": {},
    }


def test_what_is_sent_and_heard(compiled: Compile) -> None:
    files = {path: content["services"] for path, content in emitted(compiled(MODEL)).items()}
    sent = {path: [item["source"] for item in f["outgoingEvents"]] for path, f in files.items()}
    heard = {path: [item["suffix"] for item in f["incomingEvents"]] for path, f in files.items()}

    # By an effect, a function that is called, and a port; `light` stays on the robot.
    assert sent == {"scout.cfg": ["auction/bid", "help", "sight"], "worker.cfg": []}
    assert heard == {"scout.cfg": ["auction/bid", "help"], "worker.cfg": ["sight", "auction/bid"]}
    assert files["worker.cfg"]["incomingEvents"][0] == {
        "suffix": "sight",
        "message": "test/Seen",
        "name": "sight",
    }


def test_events_in_envelopes(compiled: Compile) -> None:
    """The bridge carries the envelope, by a header of its own."""
    model = MODEL.replace("entry / send Bid", "entry / send Bid to worker")
    model = model.replace("on Sight, Bid -> A", "on Bid / send Bid to event.sender")
    model += "swarm S { scout : Scout; worker : Worker[2] }"
    files = {path: content["services"] for path, content in emitted(compiled(model)).items()}
    sent = {each["source"]: each["message"] for each in files["worker.cfg"]["outgoingEvents"]}
    assert sent == {"auction/bid": "test_events/BidEnvelope"}
    heard = files["scout.cfg"]["incomingEvents"]
    assert {each["suffix"]: each["message"] for each in heard} == {
        "auction/bid": "test_events/BidEnvelope",
        "help": "test/Seen",
    }


def test_events_between_the_machines_of_a_robot(compiled: Compile) -> None:
    """A swarm event is for other robots: the envelope tells the robot that it is its own."""
    model = """
      swarm event Seen : std_msgs/Empty
      swarm event Lost : std_msgs/Empty
      endless statemachine Look { initial A; state A { after 1 s / send Seen, send Lost -> A } }
      endless statemachine Act { initial A; state A { on Seen -> A } }
      sensor Eye { behavior Look }
      member Scout { behavior Act; eye : Eye }
      member Other { behavior Look }
      swarm S { scout : Scout[2]; other : Other }
    """
    files = {path: content["services"] for path, content in emitted(compiled(model)).items()}
    for name in ("scout.cfg", "other.cfg"):
        sent = {each["source"]: each["message"] for each in files[name]["outgoingEvents"]}
        assert sent["seen"] == "test_events/SeenEnvelope"
        assert "test_events" not in sent.get("lost", "")


def test_what_the_bridge_cannot_take(compiled: Compile) -> None:
    system = compiled(
        """
        member M { behavior B; communication wifi { port = 1 } }
        endless statemachine B { initial A; state A { on Found / send Found -> A } }
        """
    )
    files = emitted(
        system,
        "target `swarmros` cannot represent topic `found`",
        "target `swarmros` cannot represent technology `wifi`",
    )

    assert files["m.cfg"]["services"]["incomingEvents"] == []
    assert files["m.cfg"]["services"]["outgoingEvents"] == []


@pytest.mark.parametrize(
    "name", ["complex_behaviors_swarmros.cfg", "complex_behaviors_uav_swarmros.cfg"]
)
def test_keys_of_real_files(name: str, compiled: Compile, corpus: Path) -> None:
    real = parsed((corpus / "swarmros" / name).read_text(encoding="utf-8"))
    ours = emitted(compiled(MODEL))["scout.cfg"]

    assert list(ours) == list(real)
    assert list(ours["endpoint"]) == list(real["endpoint"])
    assert list(ours["services"]) == list(real["services"])
    for list_ in ("outgoingEvents", "incomingEvents"):
        assert {tuple(item) for item in ours["services"][list_]} == {
            tuple(item) for item in real["services"][list_]
        }
