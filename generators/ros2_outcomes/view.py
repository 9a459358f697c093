"""Views for the templates of all libraries: charts, and functions that build containers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.python import Call, comments, layout
from swarmdsl.ir import StateKind, System

from ..ros2.imports import WIDTH, Imports
from .outcome_table import OutcomeTransition
from .structure import Kind, Node, Structure

STEP = "    "
_OWN = (
    *(("following", "Chart"), ("node", "run")),
    *(("runner", "Fsm"), ("runner", "in_node_of_its_own")),
)


@dataclass(frozen=True)
class Statement:
    """A statement of a function, and the comments above it."""

    text: str
    comments: tuple[str, ...] = ()


@dataclass(frozen=True)
class ContainerView:
    """A function that builds a machine or a concurrence."""

    function: str
    doc: str
    comments: tuple[str, ...]
    lines: tuple[Statement, ...]


@dataclass(frozen=True)
class ChartView:
    """The arguments `entries` and `ways` of a chart, in Python."""

    entries: str
    ways: str


def imports_of(chart: str, structure: Structure) -> Imports:
    """Return the imports of a module whose chart is in the module of that name."""
    imports = Imports({})
    for own, name in _OWN:
        imports.own(own, name)
    if any(each for found in structure.transitions.values() for each in found):
        imports.own("following", "Way")
    imports.own(chart, "BEHAVIOR")
    return imports


def chart_view(structure: Structure) -> ChartView:
    """Return the arguments of the chart of a machine."""
    ways = {state: tuple(map(_way, each)) for state, each in structure.transitions.items()}
    return ChartView(
        entries=layout(structure.entries, 1, f"{STEP}entries=", ",", WIDTH),
        ways=layout(ways, 1, f"{STEP}ways=", ",", WIDTH),
    )


def _way(transition: OutcomeTransition | None) -> object:
    if transition is None:
        return None
    outcomes = {outcome for _, outcome in transition.outcomes}
    outcome = outcomes.pop() if len(outcomes) == 1 else dict(transition.outcomes)
    history = [transition.history] if transition.history else []
    return Call("Way", (outcome, transition.left, *history))


def class_of(node: Node, system: System) -> tuple[str, str]:
    """Return the class or base class of a state, and its docstring."""
    if node.kind is Kind.JUNCTION:
        kept = "was active last" if node.state is not None else "is entered first"
        return "Junction", f"Leads to the state that {kept}."
    assert node.state is not None
    if node.state.activity is not None:
        call = system.function(node.state.activity.function).communication
        base = "ActionState" if call.paradigm == "action" else "ServiceState"
        return base, f"Calls {call.paradigm} {call.name}."
    words = {
        StateKind.FINAL: "Waits until the complete state around it is left.",
        StateKind.CHOICE: "Ends at once, with the outcome of its guards.",
    }
    return "State", words.get(node.state.kind, "Waits for a transition.")


def containers(node: Node, lines: Callable[[Node], Iterable[Statement]]) -> Iterator[ContainerView]:
    """Yield the functions that build a node and all inside, outer ones first.

    `lines` returns the body of a function.
    """
    if node.kind in (Kind.MACHINE, Kind.CONCURRENCE):
        yield _container(node, lines(node))
    for inside in node.nodes:
        yield from containers(inside, lines)


def _container(node: Node, lines: Iterable[Statement]) -> ContainerView:
    state = node.state
    doc, said = f"Build state machine {node.name}.", tuple[str, ...]()
    if state is not None:
        words = {StateKind.REGION: "region", StateKind.PARALLEL: "the regions of state"}
        doc = f"Build {words.get(state.kind, 'state')} {node.path}."
        said = comments(state.origin, state.doc)
    return ContainerView(node.python_name, doc, said, tuple(lines))
