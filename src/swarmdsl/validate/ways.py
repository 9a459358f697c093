"""The ways through a machine: what is read and what is written on each of them, in order.

A way is a chain of points; a point does a few things one after the other and leads to others.
Guards are taken to be possible, and so is every event. What may happen on the way between two
points counts as written rather than not: the effects on exit of all states inside one that is
left, whichever of them is active.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.dataclass import dataclass, field
from swarmdsl.link_machines import regions, vertices
from swarmdsl.source import Span
from swarmdsl.syntax import (
    Branch,
    Choice,
    Container,
    DoneTrigger,
    Entry,
    Exit,
    Expression,
    FinalState,
    History,
    Initial,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    Transition,
    Trigger,
    Variable,
    Vertex,
)
from swarmdsl.validate.outline import Outline
from swarmdsl.validate.settling import at_once
from swarmdsl.validate.steps import Step, Write, in_order, on, reads, results, while_active


@dataclass(slots=True, eq=False)
class Point:
    """What is done in order, and what may come next; `after` is the transition that led here.

    A point with `parts` is reached when each of these is.
    """

    steps: list[Step] = field(default_factory=list)
    leads_to: list[Point] = field(default_factory=list)
    after: Span | None = None
    parts: list[Point] = field(default_factory=list)
    _first: dict[Variable, Step] | None = None

    def first(self, variable: Variable) -> Step | None:
        """What is done first with a variable; the steps are all known by then."""
        if self._first is None:
            self._first = {step.variable: step for step in reversed(self.steps)}
        return self._first.get(variable)


class Ways:
    """The points of a machine whose names are all resolved; `start` is where it begins."""

    def __init__(self, outline: Outline) -> None:
        self._outline = outline
        self._active = {vertex: Point(while_active(vertex)) for vertex in outline.vertices}
        self._on_entry = {vertex: on(Entry, vertex) for vertex in outline.vertices}
        self._on_exit: dict[Vertex | Container, list[Step]] = {
            vertex: on(Exit, vertex) for vertex in outline.vertices
        }
        self._exits: dict[Vertex | Container, list[tuple[Vertex, list[Write]]]] = {}
        for state in outline.states:
            writes = [step for step in self._on_exit[state] if isinstance(step, Write)]
            for outer in outline.around(state) if writes else ():
                self._exits.setdefault(outer, []).append((state, writes))
        self._left = {
            state
            for state, transitions in outline.transitions.items()
            if any(transition.target is not None for transition in transitions)
        }
        self.start = self._enter(outline.machine, [], None)
        for vertex in self._active:
            self._leave(vertex)

    def _leave(self, vertex: Vertex) -> None:
        """Add what follows from being in a state, and the ways out of it."""
        here = self._active[vertex]
        around = self._outline.around(vertex)
        outer = [each for each in around if isinstance(each, (State, Parallel))]
        if outer and not self._is_passed(vertex):
            here.leads_to.append(self._active[outer[0]])
        match vertex:
            case Choice(branches=branches):
                tested: dict[Variable, Step] = {}
                for branch in branches:
                    _add_test(branch.guard, tested)
                    self._follow(here, list(tested.values()), branch, vertex)
            case State() | Parallel():
                if not self._left.isdisjoint(outer):
                    here.leads_to.append(Point(self._on_exit[vertex]))
                by_trigger: dict[str, dict[Variable, Step]] = {}
                for transition in self._outline.transitions[vertex]:
                    triggers: list[Trigger | None] = [*transition.triggers]
                    words = [trigger.span.text for trigger in transition.triggers] or [""]
                    for word in set(words):
                        _add_test(transition.guard, by_trigger.setdefault(word, {}))
                    for trigger, word in zip(triggers or [None], words, strict=True):
                        first = [*results(trigger, vertex), *by_trigger[word].values()]
                        for origin in self._origins(trigger, vertex):
                            self._follow(origin, first, transition, vertex)

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
        inside = vertices(container) if container is not None else ()
        return [self._active[state] for state in inside if isinstance(state, FinalState)]

    def _follow(
        self, origin: Point, first: list[Step], arrow: Transition | Branch, source: Vertex
    ) -> None:
        """Add the way that a transition or a branch goes."""
        effects = in_order(arrow.effects)
        target = arrow.target.target if arrow.target is not None else None
        if target is None:
            origin.leads_to.append(Point([*first, *effects]))
            return
        sources, path = self._outline.path(source), self._outline.path(target)
        inward = isinstance(arrow, Transition) and arrow.internal and isinstance(source, State)
        # The innermost around both that is not left: no parallel state is that (SCXML 3.13).
        stays: Container = [
            outer
            for outer, other in zip(sources, path, strict=False)
            if outer is other
            and isinstance(outer, (StateMachine, State, Region))
            and ((inward and outer is source) or outer not in (source, target))
        ][-1]
        left = sources[sources.index(stays) + 1 :]
        around = left[0] if left else source
        exits: list[Step] = [
            step
            for state, writes in self._exits.get(around, ())
            if state not in (*left, source)
            for step in writes
        ]
        for outer in reversed(left):
            exits += self._on_exit.get(outer, ())
        entered = self._enter(stays, path[path.index(stays) + 1 :], arrow.span)
        origin.leads_to.append(Point([*first, *exits, *effects], [entered], arrow.span))

    def _enter(
        self, container: Container, path: Sequence[Vertex | Container], after: Span | None
    ) -> Point:
        """The point at which the states on a path are entered, and all that come with them."""
        point = Point(after=after)

        def enter(vertex: Vertex, path: Sequence[Vertex | Container]) -> None:
            point.steps += self._on_entry[vertex]
            if isinstance(vertex, History) and not isinstance(vertex.target.target, History):
                # Where it leads back to has been reached before, with less that was written.
                container = self._outline.container[vertex]
                inside(container, self._below(container, vertex.target))
            elif isinstance(vertex, Parallel) or (
                isinstance(vertex, State) and any(vertices(vertex))
            ):
                inside(vertex, path)
            else:
                point.leads_to.append(self._active[vertex])

        def inside(container: Container, path: Sequence[Vertex | Container]) -> None:
            for region in regions(container):
                inside(region, path[1:] if region in path else [])
            if isinstance(container, Parallel):
                return
            if not path:
                initial = next((i for i in container.items if isinstance(i, Initial)), None)
                path = self._below(container, initial.target) if initial is not None else []
            for vertex in path[:1]:
                assert not isinstance(vertex, (StateMachine, Region))
                enter(vertex, path[1:])

        inside(container, path)
        return point

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

    def _below(self, container: Container, ref: Ref[Vertex]) -> Sequence[Vertex | Container]:
        """The path from a container to a state in it."""
        path = self._outline.path(ref.target) if ref.target is not None else []
        return path[path.index(container) + 1 :] if container in path else []


def _add_test(guard: Expression | None, tested: dict[Variable, Step]) -> None:
    """Add what a guard reads; what counts is the first read of each variable."""
    for read in reads(guard, test=True):
        tested.setdefault(read.variable, read)
