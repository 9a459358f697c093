"""Lower a state machine to states and containers of a library, with bound outcomes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum

from swarmdsl.codegen import Diagnostics, FreshNames, camel_case, dataclass, field
from swarmdsl.ir import State, StateKind, StateMachine

from .library import Library
from .outcome_table import OutcomeTable, OutcomeTransition

# Names in the generated module other than the classes of its states.
_RESERVED = (
    *("ActionState", "Chart", "Concurrence", "Fsm", "Junction", "ServiceState", "State"),
    *("StateMachine", "Way", "False", "None", "True"),
)


class Kind(Enum):
    """Kind of a node, by its class in the library."""

    STATE = "State"
    JUNCTION = "Junction"
    MACHINE = "StateMachine"
    CONCURRENCE = "Concurrence"


@dataclass(frozen=True)
class Node:
    """A state or container in the library.

    `path` is its id in the chart, `python_name` its class or the function that builds it.
    `transitions` bind its outcomes to states or outcomes of the machine around it. A machine begins
    in `start`; `outcome_map` of a concurrence has the required outcomes of regions, by outcome.
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
    """The nodes of a machine, from `root` on; `transitions` and `entries` are for its chart.

    `entries` are the names of the junctions in which containers begin, by their ids.
    """

    def __init__(self, machine: StateMachine, library: Library, report: Diagnostics) -> None:
        self._table = OutcomeTable(machine, library, report)
        self._stopped = library.stopped
        self._classes = FreshNames(_RESERVED)
        self._functions = FreshNames(["build", "main"])
        self.entries: dict[str, str] = {}
        self.transitions: Mapping[str, tuple[OutcomeTransition | None, ...]] = (
            self._table.transitions
        )
        _check(machine, library, report)
        finals = [
            state.name
            for state in machine.states
            if state.kind is StateKind.FINAL and state.id in self._table.reach.states
        ]
        nodes, start = self._inside("", machine)
        self.root = Node(
            Kind.MACHINE, machine.name, "", "build", (*finals, library.stopped), {}, nodes, start
        )

    def _inside(self, path: str, around: State | StateMachine) -> tuple[tuple[Node, ...], str]:
        """Return the nodes in a container, and the name of the node in which it begins."""
        reach = self._table.reach
        firsts = sorted(reach.firsts.get(path, ()))
        nodes = []
        start = self._table.junction(path)
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
        targets = self._table.outcomes[state.id]
        outcomes = (*targets, self._stopped)
        bound = {
            outcome: target.label if target.container == around else outcome
            for outcome, target in targets.items()
        }
        bound[self._stopped] = self._stopped
        if state.kind is StateKind.REGION:
            bound = {}  # a concurrence has an outcome map instead
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
        """Make the node of a parallel state, whose regions end together with the same outcome."""
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
        return self._classes.new(name if name.isidentifier() else f"State{name}")

    def _function(self, path: str) -> str:
        return self._functions.new(f"build_{path.replace('.', '_').lower()}")


def _check(machine: StateMachine, library: Library, report: Diagnostics) -> None:
    """Report states that the library cannot have."""
    by_id = {state.id: state for state in machine.walk()}
    if by_id[machine.initial].kind is StateKind.FINAL:
        report.report(
            "unsupported-construct",
            machine.origin,
            target=library.target,
            construct="an initial state that is final",
            help="start in a state that is not final, or remove the machine",
        )
    for state in by_id.values():
        if state.name == library.stopped:
            report.report(
                "bad-identifier",
                state.origin,
                target=library.target,
                name=state.name,
                use=f"a state: it is the outcome of stopped machines in {library.name}",
            )
