"""Monitors of swarms: a node for each swarm, with its properties and measures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from swarmdsl.codegen import Diagnostics, Span, code_cell, dataclass, fresh
from swarmdsl.codegen.python import Call, Source, layout
from swarmdsl.codegen.shared import sentence_text
from swarmdsl.ir import Fact, System

from .imports import WIDTH, Imports
from .launch import Launch
from .monitor_source import STEP, Entry, MonitorSource, input_text
from .monitor_subjects import Subject, check_senders, find_subject, report_unwatched
from .names import MODULES


@dataclass(frozen=True)
class WatchedSwarm:
    """Swarm with its properties; `machines` are those of its roles and parts, with their nodes.

    `of_machines` are the properties of each machine, by the name of their table; `measures` are
    inputs of the `fitness`. `about` is a section for the README of the package.
    """

    swarm: str
    launch: str
    module: str
    imports: tuple[str, ...]
    machines: tuple[Entry, ...]
    properties: tuple[Entry, ...]
    of_machines: tuple[tuple[str, tuple[Entry, ...]], ...]
    fitness: str
    measures: tuple[Entry, ...]
    about: str
    origin: Span | None


def watched_swarms(
    system: System, launches: Iterable[Launch], modules: Mapping[str, str], report: Diagnostics
) -> tuple[WatchedSwarm, ...]:
    """Return the swarms to watch: they have nodes, and properties or measures.

    Report what cannot be watched.
    """
    found: list[WatchedSwarm] = []
    launched = {each.swarm: each for each in launches}
    machines = {module: system.machines_by_name[name] for name, module in modules.items()}
    for launch in launched.values():
        subject = find_subject(launch, machines, system, report)
        if subject.properties or subject.of_machines or subject.inputs:
            taken = (*MODULES, *modules.values(), *(each.module for each in found))
            module = fresh(f"{launch.name}_monitor", taken)
            found.append(_watched(subject, module, _local_names(system)))
            check_senders(subject.facts, system, report)
    report_unwatched(system, launched, machines, report)
    return tuple(found)


def _watched(subject: Subject, module: str, named: Callable[[str], str]) -> WatchedSwarm:
    imports = Imports({})
    imports.own("node", "run_node")
    imports.own("robot_lines", "Machine")
    imports.name("functools", "partial")
    for name in ("MonitorNode", "Swarm"):
        imports.own("swarm_monitor", name)
    written = MonitorSource(imports, named)
    launch = subject.launch
    tables = {each: f"OF_{each.upper()}" for each in subject.of_machines}
    of_machines = tuple(
        (tables[each], tuple(map(written.entry, found)))
        for each, found in subject.of_machines.items()
    )
    return WatchedSwarm(
        swarm=launch.swarm,
        launch=launch.name,
        module=module,
        machines=tuple(_machines(subject, tables)),
        properties=tuple(map(written.entry, subject.properties)),
        of_machines=of_machines,
        fitness=subject.fitness.name if subject.fitness is not None and subject.inputs else "",
        measures=tuple(map(written.measure_entry, subject.inputs)),
        imports=tuple(imports.lines()),
        about=_about(subject, module, named),
        origin=launch.origin,
    )


def _local_names(system: System) -> Callable[[str], str]:
    """Return a function that gives variables of states their names in the model."""
    variables = (each for machine in system.machines for each in machine.variables)
    local = {each.name: each.local for each in variables if each.local}
    return lambda name: local.get(name, name)


def _about(subject: Subject, module: str, named: Callable[[str], str]) -> str:
    launch = subject.launch
    of_machines = [each for found in subject.of_machines.values() for each in found]
    properties = (*subject.properties, *of_machines)
    texts = {each.name: code_cell(sentence_text(each, named)) for each in properties}
    about = f"""## Monitor of {launch.swarm}

Node `{module}` watches the swarm in its namespace. The launch file starts it.
"""
    if texts:
        about += f"""
| property | |
|---|---|
{_rows(texts)}

It tells verdicts on `/diagnostics`, and on `~/verdicts` as lines of JSON.
"""
    if subject.inputs and subject.fitness is not None:
        about += f"""
| measure | |
|---|---|
{_rows({each.name: code_cell(input_text(each, named)) for each in subject.inputs})}

It tells these inputs of fitness {subject.fitness.name} on `/diagnostics`, and on `~/measures` as
a line of JSON, which the script of target `fitness` reads in a bag or in the trace of the node.
"""
    return f"""{about}
Its parameters are `members` (the robots that are to be heard), `wait` (seconds that a line may be
on its way), `wait.start`, `diagnostics.period`, `swarm` and `trace.file`.
"""


def _rows(texts: Mapping[str, str]) -> str:
    return "\n".join(f"| {name} | {text} |" for name, text in texts.items())


def _machines(subject: Subject, tables: Mapping[str, str]) -> Iterator[Entry]:
    """Yield the machine of each role and of each part; `tables` of properties by module."""
    ended = {fact.name for fact in subject.facts if isinstance(fact, Fact) and fact.act == "ends"}
    for role in subject.launch.roles:
        for node in role.nodes:
            who = role.name if node.part is None else f"{role.name}.{node.part}"
            walked = [*subject.machines[node.executable].walk()]
            states = tuple(state.id for state in walked)
            keywords: list[tuple[str, object]] = []
            if role.upper is not None:
                keywords.append(("most", role.upper))
            if node.executable in tables:
                keywords.append(("properties", Source(tables[node.executable])))
            called = [(s.id, s.activity.function) for s in walked if s.activity is not None]
            if functions := tuple(each for each in called if each[1] in ended):
                keywords.append(("functions", functions))
            call = Call("Machine", (node.name, states), tuple(keywords))
            yield Entry((), layout(call, 1, f"{STEP}{who!r}: ", ",", WIDTH))
