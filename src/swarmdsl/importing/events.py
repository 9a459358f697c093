"""Events of a document: which there are, and on which topics robots hear of them."""

from __future__ import annotations

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.importing.calls import Monitor
from swarmdsl.importing.drafts import OUTCOMES, Draft
from swarmdsl.importing.names import Names
from swarmdsl.ir import Event, Named
from swarmdsl.naming import snake_case
from swarmdsl.scxml.document import Document, Node

_BRIDGE = "bridge/events/"
_INTERNAL = ("done.", "error.")


class Events:
    """The events of all documents that are read together."""

    def __init__(self, names: Names) -> None:
        self.names = names
        self.known: dict[str, Event] = {}
        self.topics: dict[str, Named] = {}

    def collect(self, top: Draft, document: Document, report: Diagnostics) -> None:
        """Find the events of one document, and pair them with the topics of its monitors."""
        monitored: dict[str, Monitor] = {}
        for draft in top.walk():
            self._pair(draft, monitored, document, report)
        first: dict[str, Node] = {}
        for draft in top.walk():
            for edge in draft.edges:
                if edge.event and _is_plain(edge.event):
                    first.setdefault(edge.event, edge.node)
            for node in _contents(draft):
                if node.name in ("send", "raise") and node.get("event"):
                    first.setdefault(node.attributes["event"], node)
        for text, node in first.items():
            if text in self.known:
                continue
            name = self.names.of(text)
            monitor = monitored.get(text)
            if monitor is None:
                type_ = Named("std_msgs", "Empty")
                place = document.at(node, "event", text)
                what = f"no topic goes with event `{text}`"
                report.report("assumed", place, what=what, assumed=f"`{type_}`")
                self.known[text] = Event(name, type_, snake_case(name), swarm=False)
                continue
            topic = monitor.topic or snake_case(name)
            swarm = topic.startswith(_BRIDGE)
            carried = self.topics.setdefault(topic, monitor.type)
            if carried != monitor.type:
                place = document.at(monitor.node)
                what = f"`{monitor.type}` as what `{topic}` carries"
                reason = f"another monitor hears `{carried}` there"
                report.report("left-out", place, what=what, reason=reason)
            self.known[text] = Event(name, carried, topic.removeprefix(_BRIDGE), swarm)

    def meant_by(self, descriptor: str) -> list[str]:
        """The names of the events that a descriptor of a transition stands for."""
        beginning = descriptor.removesuffix("*").removesuffix(".")
        return [
            event.name
            for text, event in self.known.items()
            if not beginning or text == beginning or text.startswith(f"{beginning}.")
        ]

    def _pair(
        self,
        draft: Draft,
        monitored: dict[str, Monitor],
        document: Document,
        report: Diagnostics,
    ) -> None:
        waiting = list(
            dict.fromkeys(e.event for e in draft.edges if e.event and _is_plain(e.event))
        )
        left: list[Monitor] = []
        for monitor in draft.monitors:
            tail = snake_case(monitor.topic.rpartition("/")[2])
            match = next((each for each in waiting if tail and snake_case(each) == tail), None)
            if match is None:
                left.append(monitor)
            else:
                waiting.remove(match)
                monitored.setdefault(match, monitor)
        for monitor in left:
            if waiting:
                monitored.setdefault(waiting.pop(0), monitor)
            else:
                what = f"the monitor of `{monitor.topic or monitor.type}`"
                reason = "nothing waits for what it hears"
                report.report("left-out", document.at(monitor.node), what=what, reason=reason)


def _is_plain(event: str) -> bool:
    """Whether it is an event of the system, and not one of the machine itself."""
    return not (event.startswith(_INTERNAL) or event in OUTCOMES or event.endswith("*"))


def _contents(draft: Draft) -> list[Node]:
    inside = [*draft.entry, *draft.exit]
    inside += [child for edge in draft.edges for child in edge.node.children]
    return [node for each in inside for node in each.walk()]
