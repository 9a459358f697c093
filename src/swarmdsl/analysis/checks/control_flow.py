"""The ways through a machine: what is read and what is written on each of them, in order.

A way is a chain of points; a point does a few things one after the other and leads to others.
Guards are taken to be possible, and so is every event. What may happen on the way between two
points counts as written rather than not: the effects on exit of all states inside one that is
left, whichever of them is active.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.analysis.checks.accesses import (
    Step,
    Write,
    in_order,
    on,
    reads,
    results,
    while_active,
)
from swarmdsl.analysis.checks.livelock import at_once
from swarmdsl.analysis.checks.state_hierarchy import Outline
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Branch,
    Choice,
    Container,
    DoneTrigger,
    Entry,
    Exit,
    Expression,
    FinalState,
    History,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    Transition,
    Trigger,
    Vertex,
    nodes_of,
)

# What is in each other, from the outside to the inside.
_Path = Sequence[Vertex | Container]


@dataclass(slots=True, eq=False)
class Point:
    """What is done in order, and what may come next; `after` is the transition that led here.

    A point with `parts` is reached when each of these is.
    """

    steps: list[Step] = field(default_factory=list)
    leads_to: list[Point] = field(default_factory=list)
    after: Span | None = None
    parts: Sequence[Point] = ()


class Ways:
    """The points of a machine whose names are all resolved; `start` is where it begins."""

    def __init__(self, outline: Outline) -> None:
        self._outline = outline
        self._active = {vertex: Point(while_active(vertex)) for vertex in outline.vertices}
        self._on_entry = _on(Entry, outline)
        self._on_exit = _on(Exit, outline)
        self._exits: dict[Vertex | Container, list[tuple[State | Parallel, list[Write]]]] = {}
        for state, steps in self._on_exit.items():
            writes = [step for step in steps if isinstance(step, Write)]
            for outer in outline.around(state) if writes else ():
                self._exits.setdefault(outer, []).append((state, writes))
        self._left = {
            state
            for state, transitions in outline.transitions.items()
            if any(transition.target is not None for transition in transitions)
        }
        self.start = Point()
        self._enter(self.start, outline.machine, ())
        for vertex in self._active:
            self._leave(vertex)

    def forget(self) -> None:
        """Take the points apart: as they lead to each other, none would be freed without that."""
        ahead = [self.start, *self._active.values()]
        while ahead:
            point = ahead.pop()
            ahead += point.leads_to
            point.leads_to = []

    def _leave(self, vertex: Vertex) -> None:
        """Add what follows from being in a state, and the ways out of it."""
        here = self._active[vertex]
        around = self._outline.around(vertex)
        outer = [each for each in around if isinstance(each, (State, Parallel))]
        if outer and not self._is_passed(vertex):
            here.leads_to.append(self._active[outer[0]])
        match vertex:
            case Choice(branches=branches):
                origins = [here]
                for branch in branches:
                    origins = _tested(branch.guard, origins)
                    self._follow(origins, branch, vertex)
            case State() | Parallel():
                if vertex in self._on_exit and not self._left.isdisjoint(outer):
                    here.leads_to.append(Point(self._on_exit[vertex]))
                # By trigger: the guards are tested in order until one holds.
                waiting: dict[str, list[Point]] = {}
                for transition in self._outline.transitions[vertex]:
                    origins = []
                    triggers: list[Trigger | None] = [*transition.triggers]
                    for trigger in triggers or [None]:
                        word = trigger.span.text if trigger is not None else ""
                        if word not in waiting:
                            waiting[word] = self._fired(trigger, vertex)
                        waiting[word] = _tested(transition.guard, waiting[word])
                        origins += waiting[word]
                    self._follow(origins, transition, vertex)

    def _fired(self, trigger: Trigger | None, owner: State | Parallel) -> list[Point]:
        """The points at which a trigger has fired, and what comes with it is stored."""
        origins = self._origins(trigger, owner)
        stored = results(trigger, owner)
        return _followed(origins, Point([*stored])) if stored else origins

    def _origins(self, trigger: Trigger | None, owner: State | Parallel) -> list[Point]:
        """The points at which a trigger can fire."""
        if not isinstance(trigger, DoneTrigger):
            return [self._active[owner]]
        if trigger.final is not None and trigger.final.target in self._active:
            return [self._active[trigger.final.target]]
        if trigger.region is not None:
            return self._finals(trigger.region.target)
        if isinstance(owner, Parallel):
            return [self._join(owner)]
        return self._finals(owner) or [self._active[owner]]

    def _join(self, parallel: Parallel) -> Point:
        """The point that is reached when each region has reached a final state."""
        ends = [Point() for _ in regions(parallel)]
        joined = Point(parts=ends)
        for region, end in zip(regions(parallel), ends, strict=True):
            end.leads_to.append(joined)
            for final in self._finals(region):
                final.leads_to.append(end)
        return joined

    def _finals(self, container: Container | None) -> list[Point]:
        inside = self._outline.inside[container] if container is not None else ()
        return [self._active[state] for state in inside if isinstance(state, FinalState)]

    def _follow(self, origins: list[Point], arrow: Transition | Branch, source: Vertex) -> None:
        """Add the way that a transition or a branch goes."""
        target = arrow.target.target if arrow.target is not None else None
        point = Point(after=arrow.span if target is not None else None)
        _followed(origins, point)
        if target is None:
            point.steps += in_order(arrow.effects)
            return
        sources, path = self._outline.path(source), self._outline.path(target)
        stay = self._kept(arrow, source, target)
        left = sources[stay:]
        around = left[0] if left else source
        for state, writes in self._exits.get(around, ()):
            if state not in left and state is not source:
                point.steps += writes
        for outer in reversed(left):
            if isinstance(outer, (State, Parallel)):
                point.steps += self._on_exit.get(outer, ())
        point.steps += in_order(arrow.effects)
        stays = path[stay - 1]
        assert isinstance(stays, (StateMachine, State, Region))
        self._enter(point, stays, path[stay:])

    def _kept(self, arrow: Transition | Branch, source: Vertex, target: Vertex) -> int:
        """How many around both ends are not left: the last is no parallel state (SCXML 3.13)."""
        sources, path = self._outline.path(source), self._outline.path(target)
        inward = isinstance(arrow, Transition) and arrow.internal and isinstance(source, State)
        if len(sources) == len(path) and sources[-2] is path[-2] and not inward:
            return len(path) - 1
        kept = 0
        for depth, (outer, other) in enumerate(zip(sources, path, strict=False), 1):
            if outer is not other:
                break
            if isinstance(outer, (StateMachine, State, Region)) and (
                (inward and outer is source) or outer not in (source, target)
            ):
                kept = depth
        return kept

    def _enter(self, point: Point, container: Container, path: _Path) -> None:
        """Let a point lead to the states on a path, and to all that are entered with them."""
        if isinstance(container, Parallel):
            for region in regions(container):
                self._enter(point, region, path[1:] if region in path else ())
            return
        if not path:
            initials = self._outline.initials[container]
            path = self._below(container, initials[0].target) if initials else ()
        for vertex in path[:1]:
            assert not isinstance(vertex, (StateMachine, Region))
            self._enter_state(point, vertex, path[1:])

    def _enter_state(self, point: Point, vertex: Vertex, path: _Path) -> None:
        """The same from a state on."""
        if isinstance(vertex, History) and not isinstance(vertex.target.target, History):
            # Where it leads back to has been reached before, with less that was written.
            container = self._outline.container[vertex]
            self._enter(point, container, self._below(container, vertex.target))
            return
        if isinstance(vertex, (State, Parallel)):
            point.steps += self._on_entry.get(vertex, ())
            if self._outline.inside[vertex]:
                self._enter(point, vertex, path)
                return
        point.leads_to.append(self._active[vertex])

    def _is_passed(self, vertex: Vertex) -> bool:
        """Whether a vertex is left before anything around it reacts to an event."""
        return isinstance(vertex, (Choice, History)) or (
            isinstance(vertex, State)
            and any(
                transition.guard is None
                and any(at_once(each, vertex) for each in transition.triggers)
                for transition in self._outline.transitions[vertex]
            )
        )

    def _below(self, container: Container, ref: Ref[Vertex]) -> _Path:
        """The path from a container to a state in it."""
        path = self._outline.path(ref.target) if ref.target is not None else ()
        return path[path.index(container) + 1 :] if container in path else ()


def _on(kind: type[Entry] | type[Exit], outline: Outline) -> Mapping[State | Parallel, list[Step]]:
    """What states do when they are entered, or left."""
    if not nodes_of(outline.machine, kind):
        return {}
    return {state: steps for state in outline.states if (steps := on(kind, state))}


def _tested(guard: Expression | None, origins: list[Point]) -> list[Point]:
    """Add what a guard reads; return the points that follow."""
    steps: list[Step] = [*reads(guard, test=True)]
    return _followed(origins, Point(steps)) if steps else origins


def _followed(origins: Sequence[Point], point: Point) -> list[Point]:
    """Let points lead to another one."""
    for origin in origins:
        origin.leads_to.append(point)
    return [point]
