"""The topics of connected ports: all ports that connectors join are on one topic, a net.

A connector joins what is at its two ends, whatever lies between (as nets of circuits do), so a
net is a connected component of the graph of ports and connectors.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.base.naming import fresh
from swarmdsl.base.records import dataclass

Pin = tuple[str | None, str]
"""A part (None: the member itself) and the name of a port of it."""


@dataclass(frozen=True)
class PortTopic:
    """What a port says of its topic: `given` is whether the model names it.

    A port of the member itself is what others know of it, so its topic counts as given.
    """

    topic: str
    given: bool
    sends: bool


@dataclass(frozen=True)
class Net:
    """Ports that connectors join, in the order of the model, and the topic that they are on."""

    pins: tuple[Pin, ...]
    topic: str


def nets(ports: Mapping[Pin, PortTopic], connectors: Iterable[tuple[Pin, Pin]]) -> list[Net]:
    """The nets of a member: `ports` are those of all its parts, and its own.

    The topic is that of the member's port in the net; else one that is given, that of a sender
    first; else that of the sender. Where the sender's is only its name, and other ports of the
    member are on a topic of that name, it is `<part>/<name>`, with a number behind it where that
    is a topic, too, so that data do not mix.
    """
    joined = list(_joined(ports, connectors))
    found = [(pins, *_topic(pins, ports)) for pins in joined]
    connected = {pin for pins in joined for pin in pins}
    taken = Counter(ports[chosen].topic for _, chosen, _ in found)
    taken.update({port.topic for pin, port in ports.items() if pin not in connected})
    made = []
    for pins, chosen, given in found:
        topic = ports[chosen].topic
        if not given and taken[topic] > 1:
            topic = fresh(f"{chosen[0]}/{topic}", taken.keys())
            taken[topic] += 1
        made.append(Net(pins, topic))
    return made


def _joined(
    ports: Mapping[Pin, PortTopic], connectors: Iterable[tuple[Pin, Pin]]
) -> Iterator[tuple[Pin, ...]]:
    """The ports of each net. What the model does not have is passed over."""
    group: dict[Pin, list[Pin]] = {}
    for source, target in connectors:
        if source not in ports or target not in ports:
            continue
        first, second = group.setdefault(source, [source]), group.setdefault(target, [target])
        if first is not second:
            first += second
            group.update((pin, first) for pin in second)
    order = {pin: number for number, pin in enumerate(ports)}
    for pins in {id(pins): pins for pins in group.values()}.values():
        yield tuple(sorted(pins, key=order.__getitem__))


def _topic(pins: Iterable[Pin], ports: Mapping[Pin, PortTopic]) -> tuple[Pin, bool]:
    """The port whose topic the net has, and whether the model names it."""

    def rank(pin: Pin) -> tuple[bool, bool, bool]:
        port = ports[pin]
        return pin[0] is not None, not port.given, not port.sends

    chosen = min(pins, key=rank)
    return chosen, ports[chosen].given
