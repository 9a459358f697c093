"""From a machine to what a library has: states and containers, each bound to what comes next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum

from swarmdsl.codegen import Diagnostics, camel_case, dataclass, field, fresh
from swarmdsl.ir import State, StateKind, StateMachine

from .library import Library
from .ways import Way, Ways

# What the generated module has besides the classes of its states.
_RESERVED = (
    *("ActionState", "Chart", "Concurrence", "Fsm", "Junction", "ServiceState", "State"),
    *("StateMachine", "Way", "False", "None", "True"),
)


class Kind(Enum):
    """What a node is in the library."""

    STATE = "State"
    JUNCTION = "Junction"
    MACHINE = "StateMachine"
    CONCURRENCE = "Concurrence"


@dataclass(frozen=True)
class Node:
    """A state of the library.

    `path` is its id in the chart, `python_name` its class or the function that builds it.
    `transitions` bind its outcomes in the machine around: to a state in that, or an outcome of it.
    A machine begins in `start`; `outcome_map` says for each outcome of a concurrence what it takes.
    """

    kind: Kind
    name: str
    path: str
    python_name: str
    outcomes: tuple[str, ...]
    transitions: Mapping[str, str] = field(default_factory=dict)
    nodes: tuple[Node, ...] = ()
    start: str = ""
    outcome_map: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    state: State | None = None

    def walk(self) -> Iterator[Node]:
        """Yield the node and all inside it."""
        yield self
        for node in self.nodes:
            yield from node.walk()


class Structure:
    """The nodes of a machine, `root` being the whole; `ways` and `entries` for its chart.

    `entries` are the names of the junctions at the beginning of containers, by their ids.
    """

    def __init__(self, machine: StateMachine, library: Library, report: Diagnostics) -> None:
        self._ways = Ways(machine, library, report)
        self._stopped = library.stopped
        self._classes = {*_RESERVED}
        self._functions = {"build", "main"}
        self.entries: dict[str, str] = {}
        self.ways: Mapping[str, tuple[Way | None, ...]] = self._ways.of
        _check(machine, library, report)
        finals = [
            state.name
            for state in machine.states
            if state.kind is StateKind.FINAL and state.id in self._ways.reach.states
        ]
        nodes, start = self._inside("", machine)
        self.root = Node(
            Kind.MACHINE, machine.name, "", "build", (*finals, library.stopped), {}, nodes, start
        )

    def _inside(self, path: str, around: State | StateMachine) -> tuple[tuple[Node, ...], str]:
        """The nodes in a container, and the name of the one that it begins in."""
        reach = self._ways.reach
        firsts = sorted(reach.firsts.get(path, ()))
        nodes = []
        start = self._ways.junction(path)
        if start:
            self.entries[path] = start
            nodes.append(self._junction(path, start, firsts))
        for child in around.states:
            if child.kind is StateKind.HISTORY:
                if child.id in reach.histories:
                    labels = [each.name for each in reach.inside(around)]
                    nodes.append(self._junction(path, child.name, labels, child))
            elif child.id in reach.states and (path or child.kind is not StateKind.FINAL):
                nodes.append(self._node(path, child))
        return tuple(nodes), start or (firsts[0] if firsts else "")

    def _junction(
        self, around: str, name: str, labels: list[str], state: State | None = None
    ) -> Node:
        path = f"{around}.{name}" if around else name
        bound = {**{label: label for label in labels}, self._stopped: self._stopped}
        python_name = self._class(path)
        return Node(Kind.JUNCTION, name, path, python_name, tuple(bound), bound, state=state)

    def _node(self, around: str, state: State) -> Node:
        meanings = self._ways.outcomes[state.id]
        outcomes = (*meanings, self._stopped)
        bound = {
            outcome: meaning.label if meaning.domain == around else outcome
            for outcome, meaning in meanings.items()
        }
        bound[self._stopped] = self._stopped
        if state.kind is StateKind.REGION:
            bound = {}  # a concurrence has a map of outcomes instead
        if state.kind is StateKind.PARALLEL:
            return self._concurrence(state, outcomes, bound)
        if state.kind in (StateKind.COMPOSITE, StateKind.REGION):
            nodes, start = self._inside(state.id, state)
            name = self._function(state.id)
            return Node(
                Kind.MACHINE, state.name, state.id, name, outcomes, bound, nodes, start, state=state
            )
        name = self._class(state.id)
        return Node(Kind.STATE, state.name, state.id, name, outcomes, bound, state=state)

    def _concurrence(
        self, state: State, outcomes: tuple[str, ...], bound: Mapping[str, str]
    ) -> Node:
        """All regions end together, with the same outcome."""
        name = self._function(state.id)
        regions = tuple(self._node(state.id, each) for each in state.states)
        outcome_map = {
            outcome: {region.name: outcome for region in regions if outcome in region.outcomes}
            for outcome in outcomes
            if outcome != self._stopped
        }
        return Node(
            Kind.CONCURRENCE,
            state.name,
            state.id,
            name,
            outcomes,
            bound,
            regions,
            outcome_map=outcome_map,
            state=state,
        )

    def _class(self, path: str) -> str:
        name = "".join(map(camel_case, path.split(".")))
        name = fresh(name if name.isidentifier() else f"State{name}", self._classes)
        self._classes.add(name)
        return name

    def _function(self, path: str) -> str:
        name = fresh(f"build_{path.replace('.', '_').lower()}", self._functions)
        self._functions.add(name)
        return name


def _check(machine: StateMachine, library: Library, report: Diagnostics) -> None:
    """Report what the library cannot have."""
    by_id = {state.id: state for state in machine.walk()}
    if by_id[machine.initial].kind is StateKind.FINAL:
        report.report(
            "unsupported-construct",
            machine.origin,
            target=library.target,
            construct="an initial state that is final",
            help="a machine that ends as soon as it begins needs no node",
        )
    for state in by_id.values():
        if state.name == library.stopped:
            report.report(
                "bad-identifier",
                state.origin,
                target=library.target,
                name=state.name,
                use=f"a state: machines of {library.name} end with it",
            )
