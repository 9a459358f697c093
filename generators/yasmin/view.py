"""From the IR to what the templates print: for each machine its states and containers in YASMIN."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.ir import StateKind, StateMachine, System
from swarmdsl.python_source import Call, comments, layout
from swarmdsl.source import Span

from ..ros2.imports import WIDTH, Imports
from .state_machine_xml import document
from .structure import Kind, Node, Structure
from .ways import Way

STEP = "    "
_CONTAINERS = (Kind.CONCURRENCE, Kind.MACHINE)
_OWN = (
    *(("following", "Chart"), ("following", "Way"), ("node", "run")),
    *(("runner", "Fsm"), ("runner", "in_node_of_its_own")),
)


@dataclass(frozen=True)
class StateView:
    """A class of a state: what it extends, and the lines of its body."""

    name: str
    base: str
    doc: str
    comments: tuple[str, ...]
    path: str
    outcomes: str


@dataclass(frozen=True)
class Statement:
    """A statement that adds a state, and the comments above it."""

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
class FsmView:
    """The module of a machine in YASMIN, and its XML."""

    name: str
    chart: str
    module: str
    imports: tuple[str, ...]
    entries: str
    ways: str
    states: tuple[StateView, ...]
    containers: tuple[ContainerView, ...]
    xml: str
    origin: Span | None


def fsm_view(
    machine: StateMachine, chart: str, package: str, system: System, report: Diagnostics
) -> FsmView:
    """What is printed of a machine whose chart is in the module `chart`."""
    structure = Structure(machine, report)
    module = f"{chart}_fsm"
    imports = Imports({})
    for own, name in _OWN:
        imports.own(own, name)
    imports.own(chart, "BEHAVIOR")
    states = []
    for node in structure.root.walk():
        if node.kind in _CONTAINERS:
            imports.name("yasmin", node.kind.value)
        else:
            states.append(_state(node, system))
            imports.own("following", states[-1].base)
    return FsmView(
        name=machine.name,
        chart=chart,
        module=module,
        imports=tuple(imports.lines()),
        entries=layout(structure.entries, 1, f"{STEP}entries=", ",", WIDTH),
        ways=layout(_ways(structure), 1, f"{STEP}ways=", ",", WIDTH),
        states=tuple(states),
        containers=tuple(_containers(structure.root)),
        xml=document(structure.root, machine, f"{package}.{module}"),
        origin=machine.origin,
    )


def _ways(structure: Structure) -> dict[str, tuple[object, ...]]:
    return {state: tuple(map(_way, ways)) for state, ways in structure.ways.items()}


def _way(way: Way | None) -> object:
    if way is None:
        return None
    outcomes = {outcome for _, outcome in way.outcomes}
    outcome = outcomes.pop() if len(outcomes) == 1 else dict(way.outcomes)
    return Call("Way", (outcome, way.left, *([way.history] if way.history else [])))


def _state(node: Node, system: System) -> StateView:
    base, doc = _base(node, system)
    state = node.state
    said = comments(state.origin, state.doc) if state is not None else ()
    outcomes = layout(node.outcomes, 1, f"{STEP}outcomes = ", "", WIDTH)
    return StateView(node.python_name, base, doc, said, repr(node.path), outcomes)


def _base(node: Node, system: System) -> tuple[str, str]:
    """The class that a state extends, and what it does."""
    if node.kind is Kind.JUNCTION:
        kept = "was active last" if node.state is not None else "is entered first"
        return "Junction", f"Leads to the state that {kept}."
    assert node.state is not None
    if node.state.activity is not None:
        call = system.function(node.state.activity.function).communication
        base = "ActionState" if call.paradigm == "action" else "ServiceState"
        return base, f"Calls {call.paradigm} {call.name}."
    words = {
        StateKind.FINAL: "Waits until the state around, which is complete, is left.",
        StateKind.CHOICE: "Is left at once, to where its guards say.",
    }
    return "State", words.get(node.state.kind, "Waits for what leads on.")


def _containers(node: Node) -> Iterator[ContainerView]:
    """The functions, the outer ones first."""
    if node.kind is Kind.MACHINE:
        yield _machine(node)
    elif node.kind is Kind.CONCURRENCE:
        yield _concurrence(node)
    for inside in node.nodes:
        yield from _containers(inside)


def _machine(node: Node) -> ContainerView:
    lines = [Statement(f"{STEP}machine = {_outcomes(node)}")]
    for inside in node.nodes:
        arguments = (inside.name, Call(inside.python_name), dict(inside.transitions))
        call = Call("machine.add_state", arguments)
        at = inside.state.origin if inside.state is not None else None
        lines.append(Statement(layout(call, 1, STEP, "", WIDTH), comments(at)))
    lines.append(Statement(f"{STEP}machine.set_start_state({node.start!r})"))
    lines.append(Statement(f"{STEP}machine.set_name({node.name!r})"))
    lines.append(Statement(f"{STEP}return machine"))
    return _container(node, lines)


def _outcomes(node: Node) -> str:
    """The construction with a set of outcomes: with a list, some versions handle signals."""
    names = list(map(repr, node.outcomes))
    flat = f"StateMachine({{{', '.join(names)}}})"
    if len(flat) + 14 <= WIDTH:
        return flat
    lines = [f"{STEP * 2}{name}," for name in names]
    return "\n".join(["StateMachine({", *lines, f"{STEP}}})"])


def _concurrence(node: Node) -> ContainerView:
    states = {region.name: Call(region.python_name) for region in node.nodes}
    keywords = (
        ("states", states),
        ("default_outcome", node.outcomes[-1]),
        ("outcome_map", {name: dict(needs) for name, needs in node.outcome_map.items()}),
    )
    text = layout(Call("Concurrence", (), keywords), 1, f"{STEP}return ", "", WIDTH)
    return _container(node, [Statement(text)])


def _container(node: Node, lines: Iterable[Statement]) -> ContainerView:
    state = node.state
    if state is None:
        return ContainerView(
            node.python_name, f"Build state machine {node.name}.", (), tuple(lines)
        )
    words = {StateKind.REGION: "region", StateKind.PARALLEL: "the regions of state"}
    doc = f"Build {words.get(state.kind, 'state')} {node.path}."
    return ContainerView(node.python_name, doc, comments(state.origin, state.doc), tuple(lines))
