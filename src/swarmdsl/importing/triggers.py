"""Convert SCXML events to triggers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.execution.scxml.document import Node
from swarmdsl.importing.calls import Call
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.delays import read_delay
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsupportedError
from swarmdsl.importing.partial_states import OUTCOMES, Edge, PartialState
from swarmdsl.importing.scxml_patterns import FinalEvents
from swarmdsl.ir import (
    DoneTrigger,
    EventTrigger,
    Named,
    OutcomeTrigger,
    StateKind,
    TimeTrigger,
    Trigger,
    Type,
)

_EMPTY = Named("std_msgs", "Empty")


class Triggers:
    """Converts the triggers of one machine; `paths` are those of its states."""

    def __init__(
        self,
        events: Events,
        ends: FinalEvents,
        paths: Mapping[PartialState, str],
        wrapped: set[PartialState],
        data: MachineData,
    ) -> None:
        self.events = events
        self.ends = ends
        self.paths = paths
        self.wrapped = wrapped
        self.data = data
        # Numbers of final states, by the path of the state around them.
        self._finals: dict[str, int] = {}
        self._alike: dict[PartialState, bool] = {}

    def of(self, edges: list[Edge], draft: PartialState) -> tuple[Trigger, ...]:
        """Triggers of a transition, which has an edge for each event.

        Raises UnsupportedError.
        """
        found = dict.fromkeys(each for edge in edges for each in self._of_edge(edge, draft))
        return tuple(self._merged(list(found), draft))

    def message(self, triggers: tuple[Trigger, ...]) -> Type | None:
        """Return the common message type of all triggers; None if there is none."""
        heard = [each.event for each in triggers if isinstance(each, EventTrigger)]
        types = set(map(self.events.message, heard))
        if len(types) != 1 or len(heard) < len(triggers):
            return None
        (type_,) = types
        return type_ if type_ != _EMPTY else None

    def _of_edge(self, edge: Edge, draft: PartialState) -> Iterator[Trigger]:
        event, path = edge.event, self.paths[draft]
        if event is None:
            return
        if event in OUTCOMES:
            if isinstance(draft.call, Call):
                yield OutcomeTrigger(path, event)
        elif event in draft.timers:
            yield TimeTrigger(read_delay(draft.timers[event], self.data))
        elif event in self.ends:
            for final in self.ends[event]:
                owner = final.parent
                assert owner is not None
                if owner in self.wrapped:
                    raise UnsupportedError(f"the completion of `{owner.id}` cannot be handled here")
                state = self.paths[owner]
                if state not in self._finals:
                    kinds = [child.kind for child in owner.children]
                    self._finals[state] = kinds.count(StateKind.FINAL)
                yield DoneTrigger(state, self.paths[final])
        elif event.startswith("done.state."):
            yield self._done(event.removeprefix("done.state."), draft)
        elif draft.payload_node("activity") is not None and event.startswith(("do.", "gives.")):
            _, state, outcome = (*event.split("."), "", "")[:3]
            if state != draft.id or outcome not in OUTCOMES:
                raise UnsupportedError(f"`{event}` is not an outcome of the activity of this state")
            yield OutcomeTrigger(path, outcome)
        elif event.startswith(("done.", "error.")):
            raise UnsupportedError(f"a model has no event `{event}`")
        else:
            names = self.events.matching(event)
            if not names:
                raise UnsupportedError(f"unknown event `{event}`")
            yield from map(EventTrigger, names)

    def _done(self, identifier: str, draft: PartialState) -> Trigger:
        if identifier in draft.ids and draft.children:
            return DoneTrigger(self.paths[draft], None)
        for child in draft.children if draft.kind is StateKind.PARALLEL else ():
            if identifier in child.ids and child not in self.wrapped:
                return DoneTrigger(self.paths[child], None)
        raise UnsupportedError(f"the completion of `{identifier}` cannot be handled here")

    def _merged(self, triggers: list[Trigger], draft: PartialState) -> Iterator[Trigger]:
        """Yield the triggers, with equivalent groups merged.

        All final states of a state together are its completion. The portable profile writes
        `aborted` as two events unless a transition handles `preempted` separately.
        """
        completed = self._completed(triggers)
        together = self._treats_alike(draft)
        seen: set[Trigger] = set()
        for trigger in triggers:
            if together and isinstance(trigger, OutcomeTrigger) and trigger.outcome == "preempted":
                continue
            if isinstance(trigger, DoneTrigger) and trigger.state in completed:
                trigger = DoneTrigger(trigger.state, None)
            if trigger not in seen:
                seen.add(trigger)
                yield trigger

    def _completed(self, triggers: list[Trigger]) -> set[str]:
        """Return the paths of the states all of whose final states are among the triggers."""
        given: dict[str, set[str]] = {}
        for trigger in triggers:
            if isinstance(trigger, DoneTrigger) and trigger.final is not None:
                given.setdefault(trigger.state, set()).add(trigger.final)
        return {state for state in given if len(given[state]) == self._finals[state]}

    def _treats_alike(self, draft: PartialState) -> bool:
        """Return True if `preempted` of an activity leads to the same transitions as `aborted`."""
        if draft not in self._alike:
            has_activity = draft.payload_node("activity") is not None
            self._alike[draft] = has_activity and _has_equal_ways(draft)
        return self._alike[draft]


def _has_equal_ways(draft: PartialState) -> bool:
    given_up, failed = f"do.{draft.id}.preempted", f"do.{draft.id}.aborted"
    by_node: dict[Node, set[str | None]] = {}
    for edge in draft.edges:
        by_node.setdefault(edge.node, set()).add(edge.event)
    return all((given_up in events) == (failed in events) for events in by_node.values())
