"""Properties and measures that the monitor of a swarm can judge."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from swarmdsl.codegen import Diagnostics, dataclass
from swarmdsl.codegen.shared import envelopes_of, facts_of
from swarmdsl.ir import Count, Fact, Fitness, FitnessInput, Property, StateMachine, System

from .launch import Launch
from .names import TARGET
from .package import sent_events
from .told_conditions import facts_of_input, fitness_of, needs_sender, unknown_param


@dataclass(frozen=True)
class Subject:
    """A swarm to watch: its properties, those of its machines by module, and its measures."""

    launch: Launch
    machines: Mapping[str, StateMachine]
    properties: tuple[Property, ...]
    of_machines: Mapping[str, tuple[Property, ...]]
    fitness: Fitness | None
    inputs: tuple[FitnessInput, ...]

    @property
    def facts(self) -> Iterator[Fact | Count]:
        """Facts in all that is watched."""
        of_machines = (each for found in self.of_machines.values() for each in found)
        for each in (*self.properties, *of_machines):
            yield from facts_of(each)
        for input_ in self.inputs:
            yield from facts_of_input(input_)


def find_subject(
    launch: Launch, machines: Mapping[str, StateMachine], system: System, report: Diagnostics
) -> Subject:
    """Return the properties and measures of a swarm that a monitor can judge; report the others."""
    nodes = [(role, node) for role in launch.roles for node in role.nodes]
    behaviors = {r.name: machines[n.executable] for r, n in nodes if n.part is None}
    run = {node.executable: machines[node.executable] for _, node in nodes}
    fitness = fitness_of(launch.swarm, system)
    return Subject(
        launch,
        machines,
        tuple(
            each
            for each in system.judged
            if each.subject == launch.swarm
            and _is_told(
                f"property `{each.name}`",
                each.each,
                [*facts_of(each)],
                behaviors,
                system,
                report,
            )
        ),
        {
            module: found
            for module, machine in run.items()
            if (found := tuple(_of_machine(machine, system, report)))
        },
        fitness,
        tuple(
            each
            for each in (fitness.inputs if fitness is not None else ())
            if each.measure is not None
            and _is_told(
                f"measure `{each.name}`",
                each.measure.each,
                [*facts_of_input(each)],
                behaviors,
                system,
                report,
            )
        ),
    )


def _of_machine(machine: StateMachine, system: System, report: Diagnostics) -> Iterator[Property]:
    """Yield the properties of a machine that its nodes can tell."""
    for each in system.judged:
        what = f"property `{each.name}`"
        if each.subject == machine.name and _tells_senders(what, facts_of(each), system, report):
            yield each


def report_unwatched(
    system: System,
    launched: Mapping[str, Launch],
    machines: Mapping[str, StateMachine],
    report: Diagnostics,
) -> None:
    """Report properties and measures of what runs on no robot of a swarm with nodes."""
    run = {
        machines[node.executable].name
        for launch in launched.values()
        for role in launch.roles
        for node in role.nodes
    }
    watched = {*launched, *run}
    for each in system.judged:
        if each.subject not in watched:
            what = f"property `{each.name}`: monitors watch swarms with nodes, and their machines"
            report.report("no-place", each.origin, target=TARGET, what=what)
    used = {each.fitness for each in system.swarms if each.name in launched}
    measured = [
        (fitness.name, input_)
        for fitness in system.fitness
        for input_ in fitness.inputs
        if input_.measure is not None
    ]
    for name, input_ in measured:
        if name not in used:
            what = f"measure `{input_.name}`: monitors measure the fitness of swarms with nodes"
            report.report("no-place", input_.origin, target=TARGET, what=what)
    if not system.judged and not measured:
        what = "option `monitors`, because the model has no property and no measure"
        report.report("no-place", target=TARGET, what=what)


def _is_told(
    what: str,
    each: str | None,
    facts: Sequence[Fact | Count],
    machines: Mapping[str, StateMachine],
    system: System,
    report: Diagnostics,
) -> bool:
    """Return True if nodes know what facts ask for, with the machine of each role.

    Report it otherwise.
    """
    for fact in facts:
        if isinstance(fact, Fact) and fact.guard is not None:
            role = fact.robots.role if fact.robots is not None else each
            param = unknown_param(fact.guard, machines.get(role or ""))
            if param is not None:
                what += f": the state machine of `{role}` does not have its param `{param}`"
                help_ = "declare a param of this name in the state machine"
                report.report("no-place", fact.origin, target=TARGET, what=what, help=help_)
                return False
    return _tells_senders(what, facts, system, report)


def _tells_senders(
    what: str, facts: Iterable[Fact | Count], system: System, report: Diagnostics
) -> bool:
    """Return True if messages have the senders that conditions ask for; report it otherwise."""
    for fact in facts:
        if isinstance(fact, Fact) and needs_sender(fact, system):
            what += f": robots do not tell who sent `{fact.name}`"
            help_ = f"let a transition on `{fact.name}` use `event.sender`"
            report.report("no-place", fact.origin, target=TARGET, what=what, help=help_)
            return False
    return True


def check_senders(facts: Iterable[Fact | Count], system: System, report: Diagnostics) -> None:
    """Report events from outside that robots cannot tell from those of other robots."""
    sent = {name for machine in system.machines for name in sent_events(machine)}
    unknown = sent - envelopes_of(system).keys()
    for fact in facts:
        if isinstance(fact, Fact) and fact.act == "arrives" and fact.name in unknown:
            what = (
                f"that `{fact.name}` comes from outside: robots send it too, and do not tell "
                "who sent it"
            )
            help_ = f"let a transition on `{fact.name}` use `event.sender`"
            report.report("no-place", fact.origin, target=TARGET, what=what, help=help_)
