"""Topics of connected ports."""

from __future__ import annotations

import pytest

from swarmdsl.analysis.port_groups import PortKey, PortTopic, port_groups


def _pin(text: str) -> PortKey:
    part, _, port = text.rpartition(".")
    return part or None, port


def _topics(ports: str, connectors: str) -> dict[str, str]:
    """Return the topics of connected ports: `a.out` sends, others receive; `=` gives a topic."""
    known = {}
    for text in ports.split():
        name, _, topic = text.partition("=")
        pin = _pin(name)
        given = bool(topic) or pin[0] is None
        known[pin] = PortTopic(topic or pin[1], given, pin[1].startswith("out"))
    ends = [line.split("->") for line in connectors.split()]
    found = port_groups(known, ((_pin(source), _pin(target)) for source, target in ends))
    return {".".join(filter(None, pin)): net.topic for net in found for pin in net.ports}


@pytest.mark.parametrize(
    ("ports", "connectors", "topics"),
    [
        ("a.out b.in", "a.out->b.in", {"a.out": "out", "b.in": "out"}),
        # Ports connected to one sender are on one topic.
        (
            "a.out b.in c.in",
            "a.out->b.in a.out->c.in",
            {"a.out": "out", "b.in": "out", "c.in": "out"},
        ),
        # A given topic wins over a name, preferably that of the sender.
        ("a.out b.in=x", "a.out->b.in", {"a.out": "x", "b.in": "x"}),
        ("b.in=x a.out=y", "a.out->b.in", {"a.out": "y", "b.in": "y"}),
        # The topic of the member wins over both, wherever it is connected.
        ("in a.in=x b.in", "in->a.in in->b.in", {"in": "in", "a.in": "in", "b.in": "in"}),
        (
            "out=z a.out=x b.in=y",
            "a.out->b.in a.out->out",
            dict.fromkeys(("out", "a.out", "b.in"), "z"),
        ),
        # Senders with the same name are distinguished by their parts.
        (
            "a.out b.out c.in c.other",
            "a.out->c.in b.out->c.other",
            {"a.out": "a/out", "c.in": "a/out", "b.out": "b/out", "c.other": "b/out"},
        ),
        # Also from an unconnected port, which keeps its topic.
        ("a.out b.out c.in", "a.out->c.in", {"a.out": "a/out", "c.in": "a/out"}),
        ("out a.out c.in", "a.out->c.in", {"a.out": "a/out", "c.in": "a/out"}),
        # The new topic is not one of other ports either.
        (
            "a.out b.out=a/out c.in d.out",
            "a.out->c.in",
            {"a.out": "a/out_2", "c.in": "a/out_2"},
        ),
        # Given topics are not changed.
        (
            "a.out=x b.out=x c.in c.other",
            "a.out->c.in b.out->c.other",
            dict.fromkeys(("a.out", "c.in", "b.out", "c.other"), "x"),
        ),
        # Two groups that become one.
        (
            "a.out b.in c.out d.in",
            "a.out->b.in c.out->d.in c.out->b.in",
            dict.fromkeys(("a.out", "b.in", "c.out", "d.in"), "out"),
        ),
        # Unknown ports, which are reported.
        ("a.out b.in", "a.out->x.in b.in->b.in", {"b.in": "in"}),
    ],
)
def test_topics(ports: str, connectors: str, topics: dict[str, str]) -> None:
    assert _topics(ports, connectors) == topics
