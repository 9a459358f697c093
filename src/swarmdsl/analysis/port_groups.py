"""Connected ports and the ROS topic that each group of them shares.

Connectors join ports whatever lies between them, so a group is a connected component of the graph
of ports and connectors.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.base.naming import fresh
from swarmdsl.base.records import dataclass

PortKey = tuple[str | None, str]
"""The name of a part (None: the member itself) and of one of its ports."""


@dataclass(frozen=True)
class PortTopic:
    """The topic of a port as declared; `given` is True if the model names it.

    The topic of a port of the member itself is visible outside, so it counts as given.
    """

    topic: str
    given: bool
    sends: bool


@dataclass(frozen=True)
class PortGroup:
    """Connected ports, in the order of the model, and the topic that they share."""

    ports: tuple[PortKey, ...]
    topic: str


def port_groups(
    ports: Mapping[PortKey, PortTopic], connectors: Iterable[tuple[PortKey, PortKey]]
) -> list[PortGroup]:
    """Return the groups of a member; `ports` are its own and those of its parts.

    The topic of a group is that of the member's port in it; else a given one, senders first; else
    that of the sender. If the sender's topic is only its name and another group or port of the
    member uses that topic, the group gets `<part>/<name>`, numbered if that is taken too: data of
    different groups must not mix.
    """
    joined = list(_joined(ports, connectors))
    found = [(keys, *_topic(keys, ports)) for keys in joined]
    connected = {key for keys in joined for key in keys}
    taken = Counter(ports[chosen].topic for _, chosen, _ in found)
    taken.update({port.topic for key, port in ports.items() if key not in connected})
    made = []
    for keys, chosen, given in found:
        topic = ports[chosen].topic
        if not given and taken[topic] > 1:
            topic = fresh(f"{chosen[0]}/{topic}", taken.keys())
            taken[topic] += 1
        made.append(PortGroup(keys, topic))
    return made


def _joined(
    ports: Mapping[PortKey, PortTopic], connectors: Iterable[tuple[PortKey, PortKey]]
) -> Iterator[tuple[PortKey, ...]]:
    """Yield the ports of each group. Connectors of unknown ports are skipped."""
    group: dict[PortKey, list[PortKey]] = {}
    for source, target in connectors:
        if source not in ports or target not in ports:
            continue
        first, second = group.setdefault(source, [source]), group.setdefault(target, [target])
        if first is not second:
            first += second
            group.update((key, first) for key in second)
    order = {key: number for number, key in enumerate(ports)}
    for keys in {id(keys): keys for keys in group.values()}.values():
        yield tuple(sorted(keys, key=order.__getitem__))


def _topic(keys: Iterable[PortKey], ports: Mapping[PortKey, PortTopic]) -> tuple[PortKey, bool]:
    """Return the port whose topic the group has, and True if the model names that topic."""

    def rank(key: PortKey) -> tuple[bool, bool, bool]:
        port = ports[key]
        return key[0] is not None, not port.given, not port.sends

    chosen = min(keys, key=rank)
    return chosen, ports[chosen].given
