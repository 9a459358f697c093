"""Events of documents and their topics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.source import Span
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.calls import Monitor
from swarmdsl.importing.names import NamePool
from swarmdsl.importing.partial_states import OUTCOMES, PartialState
from swarmdsl.importing.scxml_patterns import FinalEvents, contents
from swarmdsl.ir import Event, Named, Type

_BRIDGE = "bridge/events/"
_INTERNAL = ("done.", "error.")


class Events:
    """Events of all documents that are imported together."""

    def __init__(self, names: NamePool, of_model: Iterable[Event] = ()) -> None:
        self.names = names
        self.known: dict[str, Event] = {}
        self.topics: dict[str, Named] = {}
        self._by_words: dict[str, list[str]] = {}
        self._words_of = 0
        self._types: dict[str, Type] = {}
        # Names of events without a topic in the document.
        self.guessed: set[str] = set()
        self._by_name = {event.name: event for event in of_model}
        self._by_topic = {event.incoming_topic: event for event in of_model}

    def add_portable(self, event: Event, place: Span, report: Diagnostics) -> None:
        """Add an event that the portable profile describes."""
        known = self.known.setdefault(event.name, event)
        self.names.taken.add(event.name)
        if (known.type, known.topic, known.swarm) != (event.type, event.topic, event.swarm):
            what = f"event `{event.name}` of `{event.type}` on `{event.topic}`"
            reason = f"another document declares it with `{known.type}` on `{known.topic}`"
            report.report("left-out", place, what=what, reason=reason)

    def collect(
        self, top: PartialState, ends: FinalEvents, document: Document, report: Diagnostics
    ) -> None:
        """Collect the events of a document and pair them with the topics of its monitors.

        Delays, completion events and outcomes of activities are internal and left out.
        """
        monitored: dict[str, Monitor] = {}
        for draft in top.walk():
            self._pair(draft, monitored, document, report)
        first: dict[str, Node] = {}
        for draft in top.walk():
            for edge in draft.edges:
                if edge.event and _is_plain(edge.event) and not _is_own(edge.event, draft, ends):
                    first.setdefault(edge.event, edge.node)
            for node in contents(draft):
                if node.name in ("send", "raise") and node.get("event"):
                    first.setdefault(node.attributes["event"], node)
        beginnings = {each for text in (*first, *self.known) for each in _beginnings(text)}
        for draft in top.walk():
            for edge in draft.edges:
                event = edge.event or ""
                if not event.endswith(".*") or event.startswith(_INTERNAL):
                    continue
                beginning = event.removesuffix(".*")
                if beginning not in beginnings:
                    first[beginning] = edge.node
                    beginnings.update(_beginnings(beginning))
        for text, node in first.items():
            if text in self.known:
                continue
            monitor = monitored.get(text)
            heard = self._by_topic.get(monitor.topic) if monitor is not None else None
            if heard is not None and monitor is not None and heard.type == monitor.type:
                self.known[text] = heard
                continue
            name = self.names.of(text)
            if monitor is None:
                self.guessed.add(name)
                if name in self._by_name:
                    self.known[text] = self._by_name[name]
                    continue
                type_ = Named("std_msgs", "Empty")
                place = document.at(node, "event", text)
                what = f"event `{text}` has no topic"
                report.report("assumed", place, what=what, assumed=f"`{type_}`")
                self.known[text] = Event(name, type_, snake_case(name), swarm=False)
                continue
            topic = monitor.topic or snake_case(name)
            swarm = topic.startswith(_BRIDGE)
            carried = self.topics.setdefault(topic, monitor.type)
            if carried != monitor.type:
                place = document.at(monitor.node)
                what = f"`{monitor.type}` as the type of `{topic}`"
                reason = f"another monitor declares `{carried}`"
                report.report("left-out", place, what=what, reason=reason)
            self.known[text] = Event(name, carried, topic.removeprefix(_BRIDGE), swarm)

    def matching(self, descriptor: str) -> list[str]:
        """Names of the events that match an event descriptor.

        A descriptor matches events that begin with its tokens (SCXML 3.12.1).
        """
        if self._words_of != len(self.known):
            self._words_of = len(self.known)
            self._by_words = {"": [event.name for event in self.known.values()]}
            for text, event in self.known.items():
                for beginning in _beginnings(text):
                    self._by_words.setdefault(beginning, []).append(event.name)
        return self._by_words.get(descriptor.removesuffix("*").removesuffix("."), [])

    def message(self, name: str) -> Named | None:
        """Message type of an event."""
        if len(self._types) != len(self.known):
            self._types = {event.name: event.type for event in self.known.values()}
        type_ = self._types.get(name)
        return type_ if isinstance(type_, Named) else None

    def _pair(
        self,
        draft: PartialState,
        monitored: dict[str, Monitor],
        document: Document,
        report: Diagnostics,
    ) -> None:
        waiting = list(
            dict.fromkeys(e.event for e in draft.edges if e.event and _is_plain(e.event))
        )
        by_topic: dict[str, list[str]] = {}
        for event in reversed(waiting):
            by_topic.setdefault(snake_case(event), []).append(event)
        left: list[Monitor] = []
        paired: set[str] = set()
        for monitor in draft.monitors:
            tail = snake_case(monitor.topic.rpartition("/")[2])
            if tail and by_topic.get(tail):
                event = by_topic[tail].pop()
                paired.add(event)
                monitored.setdefault(event, monitor)
            else:
                left.append(monitor)
        others = (event for event in waiting if event not in paired)
        for monitor in left:
            if (other := next(others, None)) is not None:
                monitored.setdefault(other, monitor)
            else:
                what = f"the monitor of `{monitor.topic or monitor.type}`"
                reason = "no transition handles its messages"
                report.report("left-out", document.at(monitor.node), what=what, reason=reason)


def _beginnings(event: str) -> Iterator[str]:
    """Yield the descriptors that match an event: its first words."""
    words = event.split(".")
    for count in range(1, len(words) + 1):
        yield ".".join(words[:count])


def _is_own(event: str, draft: PartialState, ends: FinalEvents) -> bool:
    does = draft.payload_node("activity") is not None and event.startswith(("do.", "gives."))
    return does or event in draft.timers or event in ends


def _is_plain(event: str) -> bool:
    """Return True for an external event, False for one of the machine itself."""
    return not (event.startswith(_INTERNAL) or event in OUTCOMES or event.endswith("*"))
