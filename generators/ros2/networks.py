"""Networks of swarms: the computers of robots, and the topics that leave them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen import Diagnostics, dataclass, replace
from swarmdsl.codegen.shared import behavior_nodes, envelopes_of
from swarmdsl.ir import Delivery, Named, StateMachine, System

from .launch import Launch, LaunchedRole
from .names import TARGET, type_name
from .network_options import LAST_DOMAIN
from .options import Options
from .package import heard_events, sent_events
from .topics import place

_GROUND = "ground"
"""The computer of the people who steer the swarm."""
_MOST = 100
"""Robots of a role without an upper limit, or with a higher one."""


@dataclass(frozen=True)
class SwarmTopic:
    """A topic of the swarm with its type, and the directions in which a robot uses it."""

    name: str
    type: str
    delivery: Delivery
    heard: bool
    sent: bool


@dataclass(frozen=True)
class Computer:
    """The computer of a robot: its host name, its domain, and the topics that leave it."""

    name: str
    host: str
    domain: int
    topics: tuple[SwarmTopic, ...]


@dataclass(frozen=True)
class Network:
    """The computers of a swarm, in the order of their domains; `hosts` finds all of them."""

    swarm: str
    computers: tuple[Computer, ...]
    hosts: tuple[str, ...]
    domain: int

    @property
    def ground(self) -> Computer:
        """The computer of people: it hears what robots send, and sends what they hear."""
        found: dict[str, SwarmTopic] = {}
        for topic in (topic for computer in self.computers for topic in computer.topics):
            known = found.get(topic.name, replace(topic, heard=False, sent=False))
            heard, sent = known.heard or topic.sent, known.sent or topic.heard
            found[topic.name] = replace(topic, heard=heard, sent=sent)
        return Computer(_GROUND, _GROUND, self.domain, tuple(found.values()))


def networks(
    system: System, launches: Iterable[Launch], options: Options, report: Diagnostics
) -> list[Network]:
    """Return the network of each swarm; report options that count for no other network."""
    if options.peers and options.network not in ("wifi", "zenoh"):
        fault = "option `peers` counts only with `network=wifi` or `network=zenoh`"
        report.report("bad-option", None, target=TARGET, fault=fault)
        return []
    if options.network == "none":
        return []
    return [_network(launch, system, options, report) for launch in launches]


def _network(launch: Launch, system: System, options: Options, report: Diagnostics) -> Network:
    computers = tuple(_computers(launch, system, options))
    last = options.domain + len(computers)
    if options.network == "domains" and last > LAST_DOMAIN:
        fault = (
            f"{len(computers)} robots of swarm {launch.swarm} need the domains to {last}, but the"
            f" last one is {LAST_DOMAIN}: set `domain` to a lower one, or take `network=zenoh`"
        )
        report.report("bad-option", launch.origin, target=TARGET, fault=fault)
    given = tuple(each.strip() for each in options.peers.split(",") if each.strip())
    hosts = given or tuple(each.host for each in computers)
    return Network(launch.name, computers, hosts, options.domain)


def _computers(launch: Launch, system: System, options: Options) -> Iterator[Computer]:
    domain = options.domain
    for role in launch.roles:
        member = system.members_by_name[role.member]
        machines = [node.machine for node in behavior_nodes(member, system)]
        topics = tuple(_topics(machines, launch, system))
        upper = role.upper if role.upper is not None else role.least
        for number in range(min(max(upper, role.least), _MOST)):
            domain += 1
            name = f"{role.name}_{number}"
            lines = _lines(f"/{launch.name}/{name}", role) if options.monitors else ()
            yield Computer(name, name.replace("_", "-"), domain, (*topics, *lines))


def _topics(
    machines: Iterable[StateMachine], launch: Launch, system: System
) -> Iterator[SwarmTopic]:
    """Yield the topics of the swarm on which nodes with these machines speak or listen."""
    around = envelopes_of(system)
    heard: dict[str, None] = {}
    sent: dict[str, None] = {}
    for machine in machines:
        heard.update(dict.fromkeys(heard_events(machine)))
        sent.update(dict.fromkeys(sent_events(machine)))
    found: dict[str, SwarmTopic] = {}
    for event in dict.fromkeys([*heard, *sent]):
        about = system.event(event)
        if about.predefined:
            continue
        topic, of_swarm = place(about, event in sent)
        if not of_swarm:
            continue
        type_ = around[event].type if event in around else about.type
        assert isinstance(type_, Named)
        name = f"/{launch.name}/{topic}"
        interface = f"{type_.package}/msg/{type_name(type_.name)}"
        delivery = about.delivery or Delivery()
        found[name] = SwarmTopic(name, interface, delivery, event in heard, event in sent)
    yield from found.values()
    yield SwarmTopic(f"/{launch.name}/models", _TEXT, _KEPT, heard=True, sent=True)
    if launch.heartbeat is not None:
        yield SwarmTopic(f"/{launch.name}/members", _TEXT, _ONCE, heard=True, sent=True)


def _lines(namespace: str, role: LaunchedRole) -> Iterator[SwarmTopic]:
    """Yield the topics of the nodes of a robot to which a monitor of the swarm listens."""
    for node in role.nodes:
        name = f"{namespace}/{node.name}/transitions"
        yield SwarmTopic(name, _TEXT, _KEPT, heard=False, sent=True)


_TEXT = "std_msgs/msg/String"
_ONCE = Delivery(reliable=False)
_KEPT = Delivery(latest=True, keep=1000)
