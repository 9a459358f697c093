"""Settings for the radio between robots: as text, by the schemas that their programs document."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from typing import Any

import pytest
import yaml

from swarmdsl.codegen.api import OutputFile

MODEL = """
package test
swarm event Go : std_msgs/Empty { reliable, keep 5, lifespan 2 s }
swarm event Plan : std_msgs/Int32 { latest }
swarm event Near : std_msgs/Empty { best effort, deadline 1 s }
event Own : std_msgs/Empty
endless statemachine Lead {
  initial Idle
  state Idle {
    on Own / send Go, send Plan(data = 1) -> Idle
    on Near / send Near -> Idle
  }
}
endless statemachine Follow {
  initial Idle
  state Idle { on Go / send Near -> Idle; on Plan -> Idle }
}
member Leader { behavior Lead }
member Follower { behavior Follow }
swarm Crew {
  leader : Leader
  follower : Follower[2..3]
  heartbeat 1 s lost after 5 s
}
property Never of Crew : never some leader hears Own
"""
FOLDER = "test_behavior/config/crew/network"
Files = dict[str, OutputFile]


def own(files: Files) -> dict[str, str]:
    """Return the files of the network by name."""
    return {
        path.removeprefix(f"{FOLDER}/"): file.text
        for path, file in files.items()
        if path.startswith(FOLDER)
    }


def json5(text: str) -> Any:
    """Return the value of a text in the part of JSON5 that is also YAML."""
    return yaml.safe_load(re.sub(r"^ *//.*$", "", text, flags=re.MULTILINE))


def test_without_the_option_there_are_no_files(generate: Callable[..., Files]) -> None:
    assert own(generate(MODEL)) == {}


def test_each_robot_has_a_domain_and_a_bridge(generate: Callable[..., Files]) -> None:
    files = generate(MODEL, network="domains", domain="30")
    found = {name: yaml.safe_load(text) for name, text in own(files).items()}
    names = ["leader_0", *(f"follower_{number}" for number in range(3))]
    assert sorted(found) == sorted(f"{name}.domain_bridge.yaml" for name in names)
    domains = [found[f"{name}.domain_bridge.yaml"]["from_domain"] for name in names]
    assert domains == [31, 32, 33, 34]
    assert {each["to_domain"] for each in found.values()} == {30}
    topics = found["leader_0.domain_bridge.yaml"]["topics"]
    assert topics == {
        "/crew/go": {
            "type": "std_msgs/msg/Empty",
            "qos": _qos("reliable", "volatile", 5, lifespan=2_000_000_000),
        },
        "/crew/plan": {
            "type": "std_msgs/msg/Int32",
            "qos": _qos("reliable", "transient_local", 1),
        },
        "/crew/near": {
            "type": "std_msgs/msg/Empty",
            "bidirectional": True,
            "qos": _qos("best_effort", "volatile", 1000, deadline=1_000_000_000),
        },
        "/crew/models": {
            "type": "std_msgs/msg/String",
            "bidirectional": True,
            "qos": _qos("reliable", "transient_local", 1000),
        },
        "/crew/members": {
            "type": "std_msgs/msg/String",
            "bidirectional": True,
            "qos": _qos("best_effort", "volatile", 1000),
        },
    }
    topics = found["follower_0.domain_bridge.yaml"]["topics"]
    assert topics["/crew/go"]["reversed"] is True
    assert "reversed" not in topics["/crew/near"]
    assert "config/crew/network/*" in files["test_behavior/setup.py"].text


def _qos(reliability: str, durability: str, depth: int, **times: int) -> dict[str, Any]:
    policies = {"reliability": reliability, "durability": durability, "history": "keep_last"}
    return {**policies, "depth": depth, **times}


def test_zenoh_routes_the_topics_of_the_swarm_alone(generate: Callable[..., Files]) -> None:
    found = own(generate(MODEL, network="zenoh", monitors="true"))
    bridge = json5(found["follower_1.zenoh_bridge.json5"])
    allowed = bridge["plugins"]["ros2dds"]["allow"]
    both = ["/crew/models", "/crew/members"]
    assert allowed["subscribers"] == ["/crew/go", "/crew/plan", *both]
    lines = "/crew/follower_1/follow/transitions"  # for a monitor of the swarm
    assert allowed["publishers"] == ["/crew/near", *both, lines]
    assert all(allowed[kind] == [] for kind in allowed if "service" in kind or "action" in kind)
    ground = json5(found["ground.zenoh_bridge.json5"])["plugins"]["ros2dds"]["allow"]
    assert {lines, "/crew/go"} < set(ground["subscribers"])
    assert {"/crew/go", "/crew/near"} <= set(ground["publishers"])
    assert lines not in ground["publishers"]
    ends = [f"tcp/{name}:7447" for name in ("leader-0", "follower-0", "follower-2")]
    assert bridge["connect"]["endpoints"] == ends
    router = json5(found["zenoh_router.json5"])
    assert router["connect"]["endpoints"] == [*ends[:2], "tcp/follower-1:7447", ends[2]]


def test_profiles_of_dds_look_for_the_robots(generate: Callable[..., Files]) -> None:
    found = own(generate(MODEL, network="wifi", peers="10.0.0.1, uav.local", lease="90"))
    for name in ("fastdds", "fastdds3"):
        root = ElementTree.fromstring(found[f"{name}.xml"])
        space = {"": "http://www.eprosima.com"}
        hosts = [each.text for each in root.iterfind(".//address", space)]
        assert hosts == ["127.0.0.1", "10.0.0.1", "uav.local"]
        assert root.findtext(".//leaseDuration/sec", namespaces=space) == "90"
        functions = ElementTree.fromstring(found[f"{name}_functions.xml"])
        assert [each.text for each in functions.iterfind(".//address", space)] == ["127.0.0.1"]
    root = ElementTree.fromstring(found["cyclonedds.xml"])
    space = {"": "https://cdds.io/config"}
    peers = [each.get("Address") for each in root.iterfind(".//Peer", space)]
    assert peers == ["127.0.0.1", "10.0.0.1", "uav.local"]


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        ({"peers": "10.0.0.1"}, "counts only with `network=wifi` or `network=zenoh`"),
        ({"network": "domains", "peers": "a"}, "counts only with `network=wifi`"),
        ({"network": "wifi", "peers": "a,b:7"}, "`b:7` is no IPv4 address and no host name"),
        ({"network": "zenoh", "domain": "3"}, "`domain` counts only with `network=domains`"),
        ({"lease": "60"}, "`lease` counts only with `network=wifi`"),
        ({"network": "wifi", "lease": "1"}, "a lease is at least 5 s"),
        ({"network": "domains", "domain": "200"}, "a domain is from 0 to 100"),
        ({"network": "domains", "domain": "99"}, "4 robots of swarm Crew need the domains to 103"),
        ({"network": "lora"}, "option `network` takes"),
        ({"network": "domains", "composed": "true"}, "robots in one process share a domain"),
    ],
)
def test_options_that_do_not_fit_are_told(
    reported: Callable[..., list[tuple[str, str, str]]], options: dict[str, str], fault: str
) -> None:
    ((name, message, _),) = reported(MODEL, **options)
    assert name == "bad-option"
    assert fault in message
