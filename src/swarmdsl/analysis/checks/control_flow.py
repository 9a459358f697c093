"""Control-flow graph of a state machine, with the accesses to variables at its nodes.

All guards and all events are assumed to be possible. Writes that may happen between two nodes
are assumed to happen: leaving a state runs the exit actions of all states inside it, active
or not.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.analysis.checks.accesses import (
    Access,
    Write,
    accesses_on_activation,
    action_accesses,
    effect_accesses,
    reads,
    result_accesses,
)
from swarmdsl.analysis.checks.livelock import completes_at_once
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
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
    Region,
    State,
    StateMachine,
    Transition,
    Trigger,
    Vertex,
    nodes_of,
)

# Nested vertices and containers, the outermost first.
_Path = Sequence[Vertex | Container]


@dataclass(slots=True, eq=False)
class Node:
    """Accesses in order, and the nodes that may follow.

    `transition` is the transition or branch that the node stands for. A node with `joined`
    nodes is reached when all of them are.
    """

    accesses: list[Access] = field(default_factory=list)
    successors: list[Node] = field(default_factory=list)
    transition: Span | None = None
    joined: Sequence[Node] = ()


class ControlFlowGraph:
    """Graph of a machine whose names are all resolved. `entry` is its first node."""

    def __init__(self, hierarchy: StateHierarchy) -> None:
        self._hierarchy = hierarchy
        self._active = {
            vertex: Node(accesses_on_activation(vertex)) for vertex in hierarchy.vertices
        }
        self._on_entry = _actions(Entry, hierarchy)
        self._on_exit = _actions(Exit, hierarchy)
        self._exits: dict[Vertex | Container, list[tuple[State | Parallel, list[Write]]]] = {}
        for state, accesses in self._on_exit.items():
            writes = [access for access in accesses if isinstance(access, Write)]
            for outer in hierarchy.ancestors(state) if writes else ():
                self._exits.setdefault(outer, []).append((state, writes))
        self._left = {
            state
            for state, transitions in hierarchy.transitions.items()
            if any(transition.target is not None for transition in transitions)
        }
        self.entry = Node()
        self._enter(self.entry, hierarchy.machine, ())
        for vertex in self._active:
            self._add_exits(vertex)

    def clear(self) -> None:
        """Remove all edges, so that reference counting frees the nodes."""
        ahead = [self.entry, *self._active.values()]
        while ahead:
            node = ahead.pop()
            ahead += node.successors
            node.successors = []

    def _add_exits(self, vertex: Vertex) -> None:
        """Add the edges from an active state."""
        here = self._active[vertex]
        around = self._hierarchy.ancestors(vertex)
        outer = [each for each in around if isinstance(each, (State, Parallel))]
        if outer and not self._is_left_at_once(vertex):
            here.successors.append(self._active[outer[0]])
        match vertex:
            case Choice(branches=branches):
                origins = [here]
                for branch in branches:
                    origins = _evaluate(branch.guard, origins)
                    self._add_arrow(origins, branch, vertex)
            case State() | Parallel():
                if vertex in self._on_exit and not self._left.isdisjoint(outer):
                    here.successors.append(Node(self._on_exit[vertex]))
                # By trigger: guards are evaluated in order until one holds.
                waiting: dict[str, list[Node]] = {}
                for transition in self._hierarchy.transitions[vertex]:
                    origins = []
                    triggers: list[Trigger | None] = [*transition.triggers]
                    for trigger in triggers or [None]:
                        word = trigger.span.text if trigger is not None else ""
                        if word not in waiting:
                            waiting[word] = self._fired(trigger, vertex)
                        waiting[word] = _evaluate(transition.guard, waiting[word])
                        origins += waiting[word]
                    self._add_arrow(origins, transition, vertex)

    def _fired(self, trigger: Trigger | None, owner: State | Parallel) -> list[Node]:
        """Nodes at which a trigger has fired and its results are stored."""
        origins = self._origins(trigger, owner)
        stored = result_accesses(trigger, owner)
        return _connect(origins, Node([*stored])) if stored else origins

    def _origins(self, trigger: Trigger | None, owner: State | Parallel) -> list[Node]:
        """Nodes at which a trigger can fire."""
        if not isinstance(trigger, DoneTrigger):
            return [self._active[owner]]
        if trigger.final is not None and trigger.final.target in self._active:
            return [self._active[trigger.final.target]]
        if trigger.region is not None:
            return self._finals(trigger.region.target)
        if isinstance(owner, Parallel):
            return [self._join(owner)]
        return self._finals(owner) or [self._active[owner]]

    def _join(self, parallel: Parallel) -> Node:
        """Node that is reached when each region has reached a final state."""
        ends = [Node() for _ in regions(parallel)]
        joined = Node(joined=ends)
        for region, end in zip(regions(parallel), ends, strict=True):
            end.successors.append(joined)
            for final in self._finals(region):
                final.successors.append(end)
        return joined

    def _finals(self, container: Container | None) -> list[Node]:
        inside = self._hierarchy.children[container] if container is not None else ()
        return [self._active[state] for state in inside if isinstance(state, FinalState)]

    def _add_arrow(self, origins: list[Node], arrow: Transition | Branch, source: Vertex) -> None:
        """Add the edge of a transition or a branch."""
        target = arrow.target.target if arrow.target is not None else None
        node = Node(transition=arrow.span if target is not None else None)
        _connect(origins, node)
        if target is None:
            node.accesses += effect_accesses(arrow.effects)
            return
        sources, path = self._hierarchy.path(source), self._hierarchy.path(target)
        stay = self._kept(arrow, source, target)
        left = sources[stay:]
        around = left[0] if left else source
        for state, writes in self._exits.get(around, ()):
            if state not in left and state is not source:
                node.accesses += writes
        for outer in reversed(left):
            if isinstance(outer, (State, Parallel)):
                node.accesses += self._on_exit.get(outer, ())
        node.accesses += effect_accesses(arrow.effects)
        stays = path[stay - 1]
        assert isinstance(stays, (StateMachine, State, Region))
        self._enter(node, stays, path[stay:])

    def _kept(self, arrow: Transition | Branch, source: Vertex, target: Vertex) -> int:
        """Count the common ancestors that stay active; the last is not parallel (SCXML 3.13)."""
        sources, path = self._hierarchy.path(source), self._hierarchy.path(target)
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

    def _enter(self, node: Node, container: Container, path: _Path) -> None:
        """Connect a node with the states on a path and all states that are entered with them."""
        if isinstance(container, Parallel):
            for region in regions(container):
                self._enter(node, region, path[1:] if region in path else ())
            return
        if not path:
            initials = self._hierarchy.initials[container]
            path = self._below(container, initials[0].target.target) if initials else ()
        for vertex in path[:1]:
            assert not isinstance(vertex, (StateMachine, Region))
            self._enter_state(node, vertex, path[1:])

    def _enter_state(self, node: Node, vertex: Vertex, path: _Path) -> None:
        """Connect a node with a state and the states on a path inside it."""
        if isinstance(vertex, History) and not isinstance(vertex.default, History):
            # The states that a history restores were reached before, with fewer writes.
            container = self._hierarchy.parent[vertex]
            self._enter(node, container, self._below(container, vertex.default))
            return
        if isinstance(vertex, (State, Parallel)):
            node.accesses += self._on_entry.get(vertex, ())
            if self._hierarchy.children[vertex]:
                self._enter(node, vertex, path)
                return
        node.successors.append(self._active[vertex])

    def _is_left_at_once(self, vertex: Vertex) -> bool:
        """Return True if a vertex is left before the states around it react to an event."""
        return isinstance(vertex, (Choice, History)) or (
            isinstance(vertex, State)
            and any(
                transition.guard is None
                and any(
                    completes_at_once(each, vertex, self._hierarchy) for each in transition.triggers
                )
                for transition in self._hierarchy.transitions[vertex]
            )
        )

    def _below(self, container: Container, inside: Vertex | None) -> _Path:
        """Path from a container to a state in it, without the container."""
        path = self._hierarchy.path(inside) if inside is not None else ()
        return path[path.index(container) + 1 :] if container in path else ()


def _actions(
    kind: type[Entry] | type[Exit], hierarchy: StateHierarchy
) -> Mapping[State | Parallel, list[Access]]:
    """Return the accesses of the entry or exit actions of all states."""
    if not nodes_of(hierarchy.machine, kind):
        return {}
    return {state: found for state in hierarchy.states if (found := action_accesses(kind, state))}


def _evaluate(guard: Expression | None, origins: list[Node]) -> list[Node]:
    """Add the reads of a guard; return the nodes after it."""
    found: list[Access] = [*reads(guard, test=True)]
    return _connect(origins, Node(found)) if found else origins


def _connect(origins: Sequence[Node], node: Node) -> list[Node]:
    """Add edges from several nodes to another one; return that one."""
    for origin in origins:
        origin.successors.append(node)
    return [node]
