"""Resolve names inside a state machine: targets of transitions, regions, final states.

The lookup starts at the source of a transition: its siblings, then outwards level by level,
then the states inside the source. A path (`Search.Sweep`) leads down from its first name.
States in another region of the same parallel state come last: a transition to them is an
error that a check reports.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import TypeVar

from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside
from swarmdsl.analysis.resolve.report_unresolved_states import (
    report_ambiguous_state,
    report_missing_state,
    report_region_in_path,
    report_state_not_around,
    report_state_outside,
)
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import Level, content, regions, states_by_name, vertices
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Choice,
    Container,
    DoneTrigger,
    Elapsed,
    Expression,
    FinalState,
    History,
    Initial,
    InState,
    Node,
    Parallel,
    Param,
    Ref,
    Region,
    State,
    StateMachine,
    Transition,
    Variable,
    Vertex,
    children,
    nodes_of,
    walk,
)

V = TypeVar("V", bound=Vertex | Region)


def link_machine(machine: StateMachine, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the references between the states of a machine."""
    linker = _MachineLinker(scope, report)
    linker.link(machine, (), ())
    if [*nodes_of(machine, InState), *nodes_of(machine, Elapsed)]:
        linker.link_tests(machine, (), (), StateNesting(machine))


def link_expression_of_machine(
    expression: Expression,
    around: Sequence[Container],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Resolve the states that an expression tests or measures.

    It is as if written in the last of some containers, each around the next, of which the first is
    the machine.
    """
    machine = around[0]
    assert isinstance(machine, StateMachine)
    levels = tuple(states_by_name(each) for each in reversed(around))
    linker = _MachineLinker(scope, report)
    linker.link_tests_of(expression, levels, around[-1], StateNesting(machine))


class _MachineLinker:
    """Links one machine. What is inside a container is looked up in it once, and kept."""

    def __init__(self, scope: FileScope, report: Diagnostics) -> None:
        self._scope = scope
        self._report = report
        self._level_of = cache(states_by_name)
        self._regions_of = cache(lambda state: _by_name(regions(state)))
        self._finals_of = cache(
            lambda container: _by_name(
                each for each in vertices(container) if isinstance(each, FinalState)
            )
        )

    def link(
        self, container: Container, outer: tuple[Level, ...], beside: tuple[Level, ...]
    ) -> None:
        """Link the contents of a container.

        `outer` are the levels around it, the nearest first, `beside` the levels of all regions
        of the parallel states around it.
        """
        inside = self._level_of(container)
        for item in container.items:
            match item:
                case Transition():
                    assert isinstance(container, (State, Parallel))
                    if item.target is not None:
                        self._link_vertex(item.target, (*outer, inside, *beside))
                    for trigger in item.triggers:
                        if isinstance(trigger, DoneTrigger):
                            self._link_done(trigger, container)
                case Initial() if inside or not isinstance(container, State):
                    # A check reports an initial state in a state without states.
                    self._link_inside(item, item.target, container, inside, (*outer, *beside))
                case Choice():
                    for branch in item.branches:
                        self._link_vertex(branch.target, (inside, *outer, *beside))
                case History(target=None):
                    initials = (each for each in container.items if isinstance(each, Initial))
                    item.initial = next((each.target for each in initials), None)
                case History(target=Ref() as target):
                    self._link_inside(item, target, container, inside, (*outer, *beside))
                case Region():
                    self.link(item, outer, (inside, *beside))
                case State() | Parallel():
                    self.link(item, (inside, *outer), beside)

    def link_tests(
        self,
        container: Container,
        outer: tuple[Level, ...],
        beside: tuple[Level, ...],
        nesting: StateNesting,
    ) -> None:
        """Resolve the states that the expressions in a container test or measure.

        A path is looked up like the target of a transition from there.
        """
        inside = self._level_of(container)
        for item in container.items:
            match item:
                case Region():
                    self.link_tests(item, outer, (inside, *beside), nesting)
                case State() | Parallel():
                    self.link_tests(item, (inside, *outer), beside, nesting)
                case Param() | Variable():
                    pass  # no state is active when they get their values
                case Choice():
                    for branch in item.branches:
                        levels = (inside, *outer, *beside)
                        self.link_tests_of(branch, levels, container, nesting)
                        _find_known(branch.guard, item, nesting)
                case _:
                    levels = (*outer, inside, *beside)
                    self.link_tests_of(item, levels, container, nesting)
                    if isinstance(item, Transition):
                        _find_known(item.guard, container, nesting)

    def link_tests_of(
        self, item: Node, levels: tuple[Level, ...], container: Container, nesting: StateNesting
    ) -> None:
        """Resolve the states that the expressions in a node test or measure."""
        for node in walk(item):
            if isinstance(node, InState):
                self._link_vertex(node.state, levels)
            elif isinstance(node, Elapsed):
                self._link_elapsed(node, levels, nesting.around(container)[:-1])

    def _link_elapsed(
        self, node: Elapsed, levels: tuple[Level, ...], around: Sequence[Node]
    ) -> None:
        """Resolve the state whose time an expression asks for; it is one around it."""
        if node.state is None:
            node.owner = next(iter(around), None)
            if node.owner is None:
                help_ = "use it in a state: a choice beside all states is in none"
                self._report.report("no-active-state", node.span, help=help_)
            return
        self._link_vertex(node.state, levels)
        if node.state.target in around:
            node.owner = node.state.target
        elif node.state.target is not None:
            report_state_not_around(node.state, around, self._report)

    def _link_inside(
        self,
        arrow: Initial | History,
        target: Ref[Vertex],
        container: Container,
        inside: Level,
        around: tuple[Level, ...],
    ) -> None:
        """Resolve the target of an initial state or a history: a state inside its container."""
        name = target.name
        outside = next((level[name][0] for level in around if name in level), None)
        if outside is None or name in inside:
            self._link_vertex(target, (inside,))
            return
        report_state_outside(arrow, target, container, outside, self._report)

    def _link_vertex(self, ref: Ref[Vertex], levels: tuple[Level, ...]) -> None:
        """Resolve a path to a state, its first name in the nearest level that has it."""
        outer: Vertex | None = None
        start = ref.span.start
        path = ref.name.split(".")
        for index, name in enumerate(path):
            if outer is not None:
                levels = (self._level_of(outer),)
            found = next((level[name] for level in levels if name in level), ())
            if len(found) != 1:
                at = Span(ref.span.source, start, start + len(name))
                if found:
                    report_ambiguous_state(name, at, found, self._report)
                elif outer is not None and name in self._regions_of(outer):
                    report_region_in_path(index, at, path, outer, self._report)
                else:
                    report_missing_state(name, at, outer, levels, self._scope, self._report)
                return
            outer = found[0]
            start += len(name) + 1
        ref.target = outer

    def _link_done(self, trigger: DoneTrigger, owner: State | Parallel) -> None:
        """Resolve the region and the final state of a `done` trigger."""
        container = content(owner)
        if trigger.region is not None:
            self._link_among(trigger.region, "region", self._regions_of(owner))
            container = trigger.region.target
            if container is None:
                return
        if trigger.final is not None and container is not None:
            self._link_among(trigger.final, "final state", self._finals_of(container))

    def _link_among(self, ref: Ref[V], kind: str, candidates: Mapping[str, V]) -> None:
        ref.target = candidates.get(ref.name)
        if ref.target is None:
            names = [*candidates]
            report_missing_inside(kind, ref.name, ref.span, names, self._scope, self._report)


class StateNesting:
    """Containers around each state of a machine."""

    def __init__(self, machine: StateMachine) -> None:
        self._parents: dict[Node, Node] = {}
        ahead: list[Node] = [machine]
        while ahead:
            outer = ahead.pop()
            for inner in children(outer):
                if isinstance(inner, (State, Parallel, Region, Choice, History, FinalState)):
                    self._parents[inner] = outer
                    ahead.append(inner)

    def around(self, state: Node) -> list[Node]:
        """Return a state and the containers around it, the nearest first."""
        found = [state]
        while found[-1] in self._parents:
            found.append(self._parents[found[-1]])
        return found

    def known(self, tested: Vertex, owner: Node) -> bool | None:
        """Return whether a state is active whenever `owner` is; None if it may be."""
        around, chain = self.around(owner), self.around(tested)
        if tested in around:
            return True
        if isinstance(tested, (Choice, History)):
            return False
        meeting = next(each for each in chain if each in around)
        return None if meeting is owner or isinstance(meeting, Parallel) else False


def _find_known(guard: Expression | None, owner: Node, nesting: StateNesting) -> None:
    """Note the tests in a guard that are always true or always false."""
    for node in walk(guard) if guard is not None else ():
        if isinstance(node, InState) and node.state.target is not None:
            node.known = nesting.known(node.state.target, owner)


def _by_name(nodes: Iterable[V]) -> Mapping[str, V]:
    """Return nodes by name, of several with one name the first."""
    found: dict[str, V] = {}
    for node in nodes:
        found.setdefault(str(node.name), node)
    return found
