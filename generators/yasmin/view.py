"""View of each machine for the templates: its states and containers in YASMIN."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen import Diagnostics, Span, dataclass
from swarmdsl.codegen.python import Call, comments, layout
from swarmdsl.ir import StateMachine, System

from ..ros2.imports import WIDTH
from ..ros2_outcomes.structure import Kind, Node, Structure
from ..ros2_outcomes.view import (
    STEP,
    ChartView,
    ContainerView,
    Statement,
    chart_view,
    class_of,
    containers,
    imports_of,
)
from .library import YASMIN
from .state_machine_xml import document

_CONTAINERS = (Kind.CONCURRENCE, Kind.MACHINE)


@dataclass(frozen=True)
class StateView:
    """The class of a state: its base class, docstring and attributes."""

    name: str
    base: str
    doc: str
    comments: tuple[str, ...]
    path: str
    outcomes: str


@dataclass(frozen=True)
class FsmView:
    """The module of a machine in YASMIN, and its XML."""

    name: str
    chart: str
    module: str
    imports: tuple[str, ...]
    arguments: ChartView
    states: tuple[StateView, ...]
    containers: tuple[ContainerView, ...]
    xml: str
    origin: Span | None


def fsm_view(
    machine: StateMachine, chart: str, package: str, system: System, report: Diagnostics
) -> FsmView:
    """Return the view of a machine whose chart is in the module `chart`."""
    structure = Structure(machine, YASMIN, report)
    module = f"{chart}{YASMIN.suffix}"
    imports = imports_of(chart, structure)
    states = []
    for node in structure.root.walk():
        if node.kind in _CONTAINERS:
            imports.name("yasmin", node.kind.value)
        else:
            states.append(_state(node, system))
            imports.own("states", states[-1].base)
    return FsmView(
        name=machine.name,
        chart=chart,
        module=module,
        imports=tuple(imports.lines()),
        arguments=chart_view(structure),
        states=tuple(states),
        containers=tuple(containers(structure.root, _lines)),
        xml=document(structure.root, machine, f"{package}.{module}"),
        origin=machine.origin,
    )


def _state(node: Node, system: System) -> StateView:
    base, doc = class_of(node, system)
    state = node.state
    said = comments(state.origin, state.doc) if state is not None else ()
    outcomes = layout(node.outcomes, 1, f"{STEP}outcomes = ", "", WIDTH)
    return StateView(node.python_name, base, doc, said, repr(node.path), outcomes)


def _lines(node: Node) -> Iterator[Statement]:
    """Yield the statements that build a container."""
    if node.kind is Kind.CONCURRENCE:
        yield Statement(_concurrence(node))
        return
    yield Statement(f"{STEP}machine = {_outcomes(node)}")
    for inside in node.nodes:
        arguments = (inside.name, Call(inside.python_name), dict(inside.transitions))
        call = Call("machine.add_state", arguments)
        at = inside.state.origin if inside.state is not None else None
        yield Statement(layout(call, 1, STEP, "", WIDTH), comments(at))
    yield Statement(f"{STEP}machine.set_start_state({node.start!r})")
    yield Statement(f"{STEP}machine.set_name({node.name!r})")
    yield Statement(f"{STEP}return machine")


def _outcomes(node: Node) -> str:
    """Return the construction with a set of outcomes.

    With a list, some versions of YASMIN handle signals.
    """
    names = list(map(repr, node.outcomes))
    flat = f"StateMachine({{{', '.join(names)}}})"
    if len(flat) + 14 <= WIDTH:
        return flat
    lines = [f"{STEP * 2}{name}," for name in names]
    return "\n".join(["StateMachine({", *lines, f"{STEP}}})"])


def _concurrence(node: Node) -> str:
    states = {region.name: Call(region.python_name) for region in node.nodes}
    keywords = (
        ("states", states),
        ("default_outcome", node.outcomes[-1]),
        ("outcome_map", {name: dict(needs) for name, needs in node.outcome_map.items()}),
    )
    return layout(Call("Concurrence", (), keywords), 1, f"{STEP}return ", "", WIDTH)
