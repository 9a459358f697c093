"""What transitions wait for: events of a document as triggers of the language."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from swarmdsl.execution.scxml.content import delay_of
from swarmdsl.execution.scxml.document import Node
from swarmdsl.importing.calls import Call
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsayableError
from swarmdsl.importing.partial_states import OUTCOMES, Draft, Edge
from swarmdsl.importing.scxml_patterns import Ends
from swarmdsl.ir import (
    Binary,
    DoneTrigger,
    EventTrigger,
    Expression,
    Literal,
    Named,
    OutcomeTrigger,
    StateKind,
    TimeTrigger,
    Trigger,
    Type,
)
from swarmdsl.syntax.types import DURATION, INT

# What the portable profile writes for a delay that is computed, and what others may.
_COMPUTED = re.compile(r'Math\.max\(0, Math\.ceil\((.*)\)\) \+ "ms"')
_WITH_UNIT = re.compile(r"""(.*)\+\s*(["'])(ms|s)\2\s*""")
_TEXT = re.compile(r"""\s*(["'])([^"']*)\1\s*""")
_EMPTY = Named("std_msgs", "Empty")


class Triggers:
    """Finds the triggers of the transitions of one machine, whose states have their paths."""

    def __init__(
        self,
        events: Events,
        ends: Ends,
        paths: Mapping[Draft, str],
        wrapped: set[Draft],
        data: MachineData,
    ) -> None:
        self.events = events
        self.ends = ends
        self.paths = paths
        self.wrapped = wrapped
        self.data = data

    def of(self, edges: list[Edge], draft: Draft) -> tuple[Trigger, ...]:
        """The triggers of a transition; each of its events is an edge. Raises UnsayableError."""
        found = dict.fromkeys(each for edge in edges for each in self._of_edge(edge, draft))
        return tuple(self._together(list(found), draft))

    def message(self, triggers: tuple[Trigger, ...]) -> Type | None:
        """The message that comes with all of them; None where that is not said."""
        heard = [each.event for each in triggers if isinstance(each, EventTrigger)]
        types = set(map(self.events.message, heard))
        if len(types) != 1 or len(heard) < len(triggers):
            return None
        (type_,) = types
        return type_ if type_ != _EMPTY else None

    def _of_edge(self, edge: Edge, draft: Draft) -> Iterator[Trigger]:
        event, path = edge.event, self.paths[draft]
        if event is None:
            return
        if event in OUTCOMES:
            if isinstance(draft.call, Call):
                yield OutcomeTrigger(path, event)
        elif event in draft.timers:
            yield TimeTrigger(self._delay(draft.timers[event]))
        elif event in self.ends:
            for final in self.ends[event]:
                owner = final.parent
                assert owner is not None
                if owner in self.wrapped:
                    raise UnsayableError(f"the end of `{owner.id}` is known there only")
                yield DoneTrigger(self.paths[owner], self.paths[final])
        elif event.startswith("done.state."):
            yield self._done(event.removeprefix("done.state."), draft)
        elif draft.said("activity") is not None and event.startswith(("do.", "gives.")):
            _, state, outcome = (*event.split("."), "", "")[:3]
            if state != draft.id or outcome not in OUTCOMES:
                raise UnsayableError(f"`{event}` is no outcome of the activity of this state")
            yield OutcomeTrigger(path, outcome)
        elif event.startswith(("done.", "error.")):
            raise UnsayableError(f"a model has no event `{event}`")
        else:
            names = self.events.meant_by(event)
            if not names:
                raise UnsayableError(f"no event is called `{event}`")
            yield from map(EventTrigger, names)

    def _done(self, identifier: str, draft: Draft) -> Trigger:
        if identifier in draft.ids and draft.children:
            return DoneTrigger(self.paths[draft], None)
        for child in draft.children if draft.kind is StateKind.PARALLEL else ():
            if identifier in child.ids and child not in self.wrapped:
                return DoneTrigger(self.paths[child], None)
        raise UnsayableError(f"the end of `{identifier}` is known there only")

    def _together(self, triggers: list[Trigger], draft: Draft) -> Iterator[Trigger]:
        """The triggers, where those that say the same together are one.

        All final states of a state are its end. In the portable profile `aborted` is written as
        two events, where no transition tells `preempted` from it.
        """
        owners: dict[str, set[str]] = {}
        for owner in (draft, *draft.children):
            if owner in self.paths:
                finals = {self.paths[e] for e in owner.children if e.kind is StateKind.FINAL}
                owners[self.paths[owner]] = finals
        together = draft.said("activity") is not None and self._tells_nothing_apart(draft)
        seen: set[Trigger] = set()
        for trigger in triggers:
            if together and isinstance(trigger, OutcomeTrigger) and trigger.outcome == "preempted":
                continue
            if isinstance(trigger, DoneTrigger) and trigger.final is not None:
                finals = owners.get(trigger.state, set())
                if all(DoneTrigger(trigger.state, final) in triggers for final in finals):
                    trigger = DoneTrigger(trigger.state, None)
            if trigger not in seen:
                seen.add(trigger)
                yield trigger

    def _tells_nothing_apart(self, draft: Draft) -> bool:
        """Whether an activity that gave up leads where one that failed does, everywhere."""
        given_up, failed = f"do.{draft.id}.preempted", f"do.{draft.id}.aborted"
        by_node: dict[Node, set[str | None]] = {}
        for edge in draft.edges:
            by_node.setdefault(edge.node, set()).add(edge.event)
        return all((given_up in events) == (failed in events) for events in by_node.values())

    def _delay(self, node: Node) -> Expression:
        written = node.get("delay")
        text = _TEXT.fullmatch(node.get("delayexpr", ""))
        if written is not None or text is not None:
            length = delay_of(written if written is not None else text[2] if text else "")
            if length is None:
                raise UnsayableError(f"`{written}` is no delay")
            return Literal(length, DURATION)
        computed = _COMPUTED.fullmatch(node.get("delayexpr", ""))
        if computed is not None:
            return self.data.read(node, "delayexpr", computed[1], DURATION)
        with_unit = _WITH_UNIT.fullmatch(node.get("delayexpr", ""))
        if with_unit is None:
            raise UnsayableError(f"`{node.get('delayexpr')}` is no duration")
        unit = Literal(1_000_000 if with_unit[3] == "ms" else 1_000_000_000, DURATION)
        number = self.data.read(node, "delayexpr", with_unit[1], INT)
        return Binary("*", number, unit, DURATION)
