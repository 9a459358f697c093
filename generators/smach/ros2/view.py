"""View of each machine for the templates: its states and containers in SMACH."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen import Diagnostics, Span, dataclass
from swarmdsl.codegen.python import Call, Source, comments, layout
from swarmdsl.ir import StateMachine, System

from ...ros2.imports import WIDTH
from ...ros2_outcomes.structure import Kind, Node, Structure
from ...ros2_outcomes.view import (
    STEP,
    ChartView,
    ContainerView,
    Statement,
    chart_view,
    class_of,
    containers,
    imports_of,
)
from .library import SMACH


@dataclass(frozen=True)
class SmachView:
    """The module of a machine in SMACH."""

    name: str
    chart: str
    module: str
    imports: tuple[str, ...]
    arguments: ChartView
    containers: tuple[ContainerView, ...]
    origin: Span | None


def smach_view(machine: StateMachine, chart: str, system: System, report: Diagnostics) -> SmachView:
    """Return the view of a machine whose chart is in the module `chart`."""
    structure = Structure(machine, SMACH, report)
    imports = imports_of(chart, structure)
    imports.own("states", "Machine")
    imports.name("smach", "StateMachine")
    for node in structure.root.walk():
        if node.kind is Kind.CONCURRENCE:
            imports.name("smach", "Concurrence")
        elif node.kind is not Kind.MACHINE:
            imports.own("states", class_of(node, system)[0])
    return SmachView(
        name=machine.name,
        chart=chart,
        module=f"{chart}{SMACH.suffix}",
        imports=tuple(imports.lines()),
        arguments=chart_view(structure),
        containers=tuple(containers(structure.root, lambda node: _lines(node, system))),
        origin=machine.origin,
    )


def _lines(node: Node, system: System) -> Iterator[Statement]:
    """Yield the statements that build a container."""
    variable = "concurrence" if node.kind is Kind.CONCURRENCE else "machine"
    yield Statement(layout(_container(node), 1, f"{STEP}{variable} = ", "", WIDTH))
    yield Statement(f"{STEP}with {variable}:")
    for inside in node.nodes:
        add = Call(f"{node.kind.value}.add", *_added(inside, system))
        text = layout(add, 2, STEP * 2, "", WIDTH)
        yield Statement(text, tuple(_comments(inside, system)))
    first = next((each.name for each in node.nodes), "")
    if node.kind is Kind.MACHINE and node.start != first:
        yield Statement(f"{STEP}machine.set_initial_state([{node.start!r}])")
    yield Statement(f"{STEP}return {variable}")


def _container(node: Node) -> Call:
    outcomes = [*node.outcomes]
    if node.state is None:
        return Call("Machine", (Source("CHART"), outcomes))
    if node.kind is Kind.MACHINE:
        return Call("StateMachine", (outcomes,))
    keywords = (
        ("default_outcome", SMACH.stopped),
        ("outcome_map", {name: dict(needs) for name, needs in node.outcome_map.items()}),
    )
    return Call("Concurrence", (outcomes,), keywords)


def _added(node: Node, system: System) -> tuple[tuple[object, ...], tuple[tuple[str, object], ...]]:
    """Return the arguments that add a node to a container; the outcome map binds regions."""
    if node.kind in (Kind.MACHINE, Kind.CONCURRENCE):
        state = Call(node.python_name)
    else:
        arguments = (Source("CHART"), node.path, [*node.outcomes])
        state = Call(class_of(node, system)[0], arguments)
    bound = dict(node.transitions)
    return (node.name, state), ((("transitions", bound),) if bound else ())


def _comments(node: Node, system: System) -> Iterable[str]:
    """Return the place and documentation of a state, where no function has them."""
    if node.state is None:
        return (class_of(node, system)[1],)
    if node.kind in (Kind.MACHINE, Kind.CONCURRENCE):
        return comments(node.state.origin)
    said = comments(node.state.origin, node.state.doc)
    calls = node.state.activity is not None
    return (*said, class_of(node, system)[1]) if calls else said
