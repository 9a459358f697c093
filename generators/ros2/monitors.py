"""Monitors of swarms: what is watched and measured of whom, for a node of each swarm."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from swarmdsl.codegen import Diagnostics, Span, code_cell, dataclass, fresh
from swarmdsl.codegen.python import Call, Source, comments, layout, source_place
from swarmdsl.codegen.shared import (
    condition_text,
    constant,
    envelopes_of,
    facts_of,
    measure_text,
    reads_envelope,
    sentence_text,
)
from swarmdsl.ir import (
    DURATION,
    Claim,
    Count,
    Expression,
    Fact,
    Fitness,
    FitnessInput,
    Junction,
    Measure,
    ParamRef,
    Property,
    Robots,
    StateMachine,
    System,
    bound_of_any,
    reads_values,
    subexpressions,
)

from .imports import WIDTH, Imports
from .launch import Launch
from .names import TARGET
from .package import sent_events

_STEP = "    "
_SECOND = 1_000_000_000


@dataclass(frozen=True)
class Entry:
    """Item of a table, and the comments above it."""

    comments: tuple[str, ...]
    text: str


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


@dataclass(frozen=True)
class _Subject:
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
            yield from _facts_of_input(input_)


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
        subject = _subject(launch, machines, system, report)
        if subject.properties or subject.of_machines or subject.inputs:
            taken = (*modules.values(), *(each.module for each in found))
            module = fresh(f"{launch.name}_monitor", taken)
            found.append(_watched(subject, module, _local_names(system)))
            _check_senders(subject.facts, system, report)
    _report_unwatched(system, launched, machines, report)
    return tuple(found)


def conditions(machine: StateMachine, system: System) -> dict[str, Fact]:
    """Return the facts with conditions that robots with a machine tell, by their text.

    A machine of a part tells only conditions on messages alone: variables are those of the robot.
    """
    found: list[Fact] = []
    for swarm in system.swarms:
        members = {role.name: system.members_by_name[role.member] for role in swarm.roles}
        own = {name for name, member in members.items() if member.behavior == machine.name}
        parts = {
            name
            for name, member in members.items()
            for part in member.parts
            if system.components_by_name[part.component].behavior == machine.name
        }
        for each, fact in _facts_about(swarm.name, system):
            if isinstance(fact, Fact) and fact.guard is not None:
                of_message = fact.act != "has" and not reads_values(fact.guard)
                roles = own | parts if of_message else own
                role = fact.robots.role if fact.robots is not None else each
                if role in roles or (fact.act == "arrives" and roles):
                    found.append(fact)
    found += [
        fact
        for property_ in system.properties
        if property_.subject == machine.name
        for fact in facts_of(property_)
        if isinstance(fact, Fact)
    ]
    return {
        told_text(fact): fact
        for fact in found
        if fact.guard is not None
        and _unknown_param(fact.guard, machine) is None
        and not _needs_sender(fact, system)
    }


def told_text(fact: Fact) -> str:
    """Return what nodes call a condition: `load > 3`, `hears Take [event.data > 3]`."""
    assert fact.guard is not None
    text = condition_text(fact.guard)
    return text if fact.act == "has" else f"{heard_or_sent(fact)} {fact.name} [{text}]"


def heard_or_sent(fact: Fact) -> str:
    """Return the act by which a node knows the message of an event."""
    return "sends" if fact.act == "sends" else "hears"


def _facts_about(swarm: str, system: System) -> Iterator[tuple[str | None, Fact | Count]]:
    """Yield the facts in properties and measures of a swarm, each with the role of `each`."""
    for property_ in system.properties:
        if property_.subject == swarm:
            for fact in facts_of(property_):
                yield property_.each, fact
    fitness = _fitness_of(swarm, system)
    for input_ in fitness.inputs if fitness is not None else ():
        if input_.measure is not None:
            for fact in _facts_of_input(input_):
                yield input_.measure.each, fact


def _facts_of_input(input_: FitnessInput) -> Iterable[Fact | Count]:
    return facts_of(input_.measure) if input_.measure is not None else ()


def _fitness_of(swarm: str, system: System) -> Fitness | None:
    (name,) = (each.fitness for each in system.swarms if each.name == swarm)
    return next((each for each in system.fitness if each.name == name), None)


def _subject(
    launch: Launch, machines: Mapping[str, StateMachine], system: System, report: Diagnostics
) -> _Subject:
    nodes = [(role, node) for role in launch.roles for node in role.nodes]
    behaviors = {r.name: machines[n.executable] for r, n in nodes if n.part is None}
    run = {node.executable: machines[node.executable] for _, node in nodes}
    fitness = _fitness_of(launch.swarm, system)
    return _Subject(
        launch,
        machines,
        tuple(
            each
            for each in system.properties
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
                [*_facts_of_input(each)],
                behaviors,
                system,
                report,
            )
        ),
    )


def _of_machine(machine: StateMachine, system: System, report: Diagnostics) -> Iterator[Property]:
    """Yield the properties of a machine that its nodes can tell."""
    for each in system.properties:
        what = f"property `{each.name}`"
        if each.subject == machine.name and _tells_senders(what, facts_of(each), system, report):
            yield each


def _report_unwatched(
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
    for each in system.properties:
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
    if not system.properties and not measured:
        what = "option `monitors`, because the model has no property and no measure"
        report.report("no-place", target=TARGET, what=what)


def _watched(subject: _Subject, module: str, named: Callable[[str], str]) -> WatchedSwarm:
    imports = Imports({})
    imports.own("node", "run_node")
    imports.own("robot_lines", "Machine")
    imports.name("functools", "partial")
    for name in ("MonitorNode", "Swarm"):
        imports.own("swarm_monitor", name)
    written = _Writer(imports, named)
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
        machines=tuple(_machines(launch, subject.machines, tables)),
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


def _about(subject: _Subject, module: str, named: Callable[[str], str]) -> str:
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
{_rows({each.name: code_cell(_measure_text(each, named)) for each in subject.inputs})}

It tells these inputs of fitness {subject.fitness.name} on `/diagnostics`, and on `~/measures` as
a line of JSON, which the script of target `fitness` reads in a bag or in the trace of the node.
"""
    return f"""{about}
Its parameters are `members` (the robots that are to be heard), `wait` (seconds that a line may be
on its way), `wait.start`, `diagnostics.period`, `swarm` and `trace.file`.
"""


def _rows(texts: Mapping[str, str]) -> str:
    return "\n".join(f"| {name} | {text} |" for name, text in texts.items())


def _measure_text(input_: FitnessInput, named: Callable[[str], str]) -> str:
    assert input_.measure is not None
    return measure_text(input_.measure, named)


def _machines(
    launch: Launch, machines: Mapping[str, StateMachine], tables: Mapping[str, str]
) -> Iterator[Entry]:
    """Yield the machine of each role and of each part; `tables` of properties by module."""
    for role in launch.roles:
        for node in role.nodes:
            who = role.name if node.part is None else f"{role.name}.{node.part}"
            states = tuple(state.id for state in machines[node.executable].walk())
            keywords: list[tuple[str, object]] = []
            if role.upper is not None:
                keywords.append(("most", role.upper))
            if node.executable in tables:
                keywords.append(("properties", Source(tables[node.executable])))
            call = Call("Machine", (node.name, states), tuple(keywords))
            yield Entry((), layout(call, 1, f"{_STEP}{who!r}: ", ",", WIDTH))


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
            param = _unknown_param(fact.guard, machines.get(role or ""))
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
        if isinstance(fact, Fact) and _needs_sender(fact, system):
            what += f": robots do not tell who sent `{fact.name}`"
            help_ = f"let a transition on `{fact.name}` use `event.sender`"
            report.report("no-place", fact.origin, target=TARGET, what=what, help=help_)
            return False
    return True


def _needs_sender(fact: Fact, system: System) -> bool:
    """Return True if a condition asks who sent an event, or when, and its message does not tell."""
    return (
        fact.guard is not None
        and reads_envelope([fact.guard])
        and fact.name not in envelopes_of(system)
    )


def _unknown_param(condition: Expression, machine: StateMachine | None) -> str | None:
    """Return a param of the robot that its machine does not have, or None."""
    known = {param.name for param in machine.params} if machine is not None else set()
    for part in subexpressions(condition):
        if isinstance(part, ParamRef) and part.name not in known:
            return part.name
    return None


def _check_senders(facts: Iterable[Fact | Count], system: System, report: Diagnostics) -> None:
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


class _Writer:
    """Writes properties as plain data, and imports its classes."""

    def __init__(self, imports: Imports, named: Callable[[str], str]) -> None:
        self._imports = imports
        self._named = named

    def entry(self, property_: Property) -> Entry:
        """Return the entry of a property, which says where it is in the model."""
        text = sentence_text(property_, self._named)
        where = f" ({source_place(property_.origin)})" if property_.origin is not None else ""
        scope = property_.scope
        keywords: list[tuple[str, object]] = []
        if scope is not None:
            keywords.append(("scope", tuple(map(self._claim, scope.claims))))
        if property_.each is not None:
            keywords.append(("each", property_.each))
        if property_.chance is not None:
            keywords.append(("chance", property_.chance.probability))
        keywords.append(("origin", f"{text}{where}"))
        claims = tuple(map(self._claim, property_.claims))
        call = self._call("Property", (property_.name, self._sentence(property_), claims), keywords)
        said = comments(property_.origin, property_.doc)
        return Entry(said, layout(call, 1, _STEP, ",", WIDTH))

    def measure_entry(self, input_: FitnessInput) -> Entry:
        """Return the entry of a measure, which says where it is in the model."""
        assert input_.measure is not None
        keywords: list[tuple[str, object]] = []
        if (bound := bound_of_any(input_.type)) is not None:
            keywords.append(("bound", bound))
        if input_.type == DURATION:
            keywords.append(("unit", "s"))
        text = _measure_text(input_, self._named)
        where = f" ({source_place(input_.origin)})" if input_.origin is not None else ""
        measured = self._measure(input_.name, input_.measure)
        class_ = self._imports.own("swarm_measures", "Input")
        call = Call(class_, (measured, f"{text}{where}"), tuple(keywords))
        said = comments(input_.origin, input_.doc)
        return Entry(said, layout(call, 1, _STEP, ",", WIDTH))

    def _measure(self, name: str, each: Measure) -> Call:
        claim = self._claim(each.claim)
        if each.counted_role is not None:
            assert isinstance(each.claim, Fact)
            claim = self._fact(each.claim, self._call("Robots", (each.counted_role, "every")))
        keywords: list[tuple[str, object]] = []
        for key, value in (("over", each.over), ("aggregate", each.aggregate), ("each", each.each)):
            if value is not None:
                keywords.append((key, value))
        return self._call("Measure", (name, each.kind, claim), keywords)

    def _sentence(self, property_: Property) -> Call:
        keywords: list[tuple[str, object]] = []
        if property_.scope is not None:
            keywords.append(("scope", property_.scope.kind))
        if property_.within is not None:
            seconds = constant(property_.within, {})
            assert isinstance(seconds, (int, float))
            keywords.append(("within", Source(f"{round(seconds * _SECOND):_}")))
        if property_.times is not None:
            keywords.append(("times", property_.times))
        return self._call("Sentence", (property_.kind,), keywords)

    def _claim(self, claim: Claim) -> Call:
        if isinstance(claim, Junction):
            inner = tuple(map(self._claim, claim.claims))
            return self._call("Junction", (claim.operator, inner))
        if isinstance(claim, Count):
            numbers = (claim.role, claim.state, claim.comparison, claim.number)
            return self._call("Count", numbers)
        return self._fact(claim, self._robots(claim.robots) if claim.robots is not None else None)

    def _fact(self, fact: Fact, robots: Call | None) -> Call:
        keywords: list[tuple[str, object]] = []
        if robots is not None:
            keywords.append(("robots", robots))
        if fact.guard is not None:
            keywords.append(("condition", told_text(fact)))
        name = (fact.name,) if fact.name else ()
        return self._call("Fact", (fact.act, *name), keywords)

    def _robots(self, robots: Robots) -> Call:
        keywords: list[tuple[str, object]] = []
        if robots.number is not None:
            keywords.append(("least", robots.number.lower))
            if robots.number.upper is not None:
                keywords.append(("most", robots.number.upper))
        if robots.index:
            keywords.append(("number", robots.index))
        if robots.other:
            keywords.append(("other", True))
        return self._call("Robots", (robots.role, robots.quantifier), keywords)

    def _call(
        self,
        name: str,
        arguments: tuple[object, ...],
        keywords: Iterable[tuple[str, object]] = (),
    ) -> Call:
        return Call(self._imports.own("property_monitors", name), arguments, tuple(keywords))
