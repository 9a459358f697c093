"""Monitors of swarms: what is watched of whom, for a node of each swarm with properties."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from swarmdsl.codegen import Diagnostics, Span, code_cell, dataclass, fresh
from swarmdsl.codegen.python import Call, Source, comments, layout, source_place
from swarmdsl.codegen.shared import (
    condition_text,
    constant,
    envelopes_of,
    facts_of,
    sentence_text,
)
from swarmdsl.ir import (
    Claim,
    Count,
    Expression,
    Fact,
    Junction,
    ParamRef,
    Property,
    Robots,
    StateMachine,
    System,
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

    `about` is a section for the README of the package.
    """

    swarm: str
    launch: str
    module: str
    imports: tuple[str, ...]
    machines: tuple[Entry, ...]
    properties: tuple[Entry, ...]
    about: str
    origin: Span | None


def watched_swarms(
    system: System, launches: Iterable[Launch], modules: Mapping[str, str], report: Diagnostics
) -> tuple[WatchedSwarm, ...]:
    """Return the swarms that have properties and nodes; report what cannot be watched."""
    found: list[WatchedSwarm] = []
    launched = {each.swarm: each for each in launches}
    for name, launch in launched.items():
        about = [
            each
            for each in system.properties
            if each.subject == name and _is_told(each, launch, modules, system, report)
        ]
        if about:
            taken = (*modules.values(), *(each.module for each in found))
            module = fresh(f"{launch.name}_monitor", taken)
            machines = tuple(_machines(launch, modules, system))
            found.append(_watched(about, launch, module, machines, _local_names(system)))
            _check_senders(about, system, report)
    for each in system.properties:
        if each.subject not in launched:
            what = f"property `{each.name}`: monitors watch properties of swarms with nodes"
            report.report("no-place", each.origin, target=TARGET, what=what)
    if not system.properties:
        what = "option `monitors`, because the model has no property"
        report.report("no-place", target=TARGET, what=what)
    return tuple(found)


def conditions(machine: StateMachine, system: System) -> dict[str, Expression]:
    """Return the conditions of properties that robots with a machine tell, by their text."""
    found: dict[str, Expression] = {}
    for swarm in system.swarms:
        roles = {
            role.name
            for role in swarm.roles
            if system.members_by_name[role.member].behavior == machine.name
        }
        for property_ in system.properties:
            for fact in facts_of(property_) if property_.subject == swarm.name else ():
                if isinstance(fact, Fact) and fact.guard is not None:
                    role = fact.robots.role if fact.robots is not None else property_.each
                    if role in roles and _unknown_param(fact.guard, machine) is None:
                        found[condition_text(fact.guard)] = fact.guard
    return found


def _watched(
    properties: Sequence[Property],
    launch: Launch,
    module: str,
    machines: tuple[Entry, ...],
    named: Callable[[str], str],
) -> WatchedSwarm:
    imports = Imports({})
    imports.own("node", "run_node")
    imports.own("robot_lines", "Machine")
    imports.name("functools", "partial")
    for name in ("MonitorNode", "Swarm"):
        imports.own("swarm_monitor", name)
    written = _Writer(imports, named)
    return WatchedSwarm(
        swarm=launch.swarm,
        launch=launch.name,
        module=module,
        machines=machines,
        properties=tuple(map(written.entry, properties)),
        imports=tuple(imports.lines()),
        about=_about(launch, module, properties, named),
        origin=launch.origin,
    )


def _local_names(system: System) -> Callable[[str], str]:
    """Return a function that gives variables of states their names in the model."""
    variables = (each for machine in system.machines for each in machine.variables)
    local = {each.name: each.local for each in variables if each.local}
    return lambda name: local.get(name, name)


def _about(
    launch: Launch, module: str, properties: Iterable[Property], named: Callable[[str], str]
) -> str:
    texts = {each.name: code_cell(sentence_text(each, named)) for each in properties}
    rows = "\n".join(f"| {name} | {text} |" for name, text in texts.items())
    return f"""## Monitor of {launch.swarm}

Node `{module}` watches the properties of the swarm in its namespace. The launch file starts it.

| property | |
|---|---|
{rows}

It tells verdicts on `/diagnostics`, and on `~/verdicts` as lines of JSON. Its parameters are
`members` (the robots that are to be heard), `wait` (seconds that a line may be on its way),
`wait.start`, `diagnostics.period`, `swarm` and `trace.file`.
"""


def _machines(launch: Launch, modules: Mapping[str, str], system: System) -> Iterator[Entry]:
    """Yield the machine of each role and of each part: the name of its node, and its states."""
    machines = {module: system.machines_by_name[name] for name, module in modules.items()}
    for role in launch.roles:
        for node in role.nodes:
            who = role.name if node.part is None else f"{role.name}.{node.part}"
            states = tuple(state.id for state in machines[node.executable].walk())
            call = Call("Machine", (node.name, states))
            yield Entry((), layout(call, 1, f"{_STEP}{who!r}: ", ",", WIDTH))


def _is_told(
    property_: Property,
    launch: Launch,
    modules: Mapping[str, str],
    system: System,
    report: Diagnostics,
) -> bool:
    """Return True if nodes know what a property asks for; report it otherwise."""
    machines = {
        role.name: system.machines_by_name[name]
        for name, module in modules.items()
        for role in launch.roles
        for node in role.nodes
        if node.part is None and node.executable == module
    }
    for fact in facts_of(property_):
        if isinstance(fact, Fact) and fact.guard is not None:
            role = fact.robots.role if fact.robots is not None else property_.each
            param = _unknown_param(fact.guard, machines.get(role or ""))
            if param is not None:
                what = (
                    f"property `{property_.name}`: the state machine of `{role}` does not have "
                    f"its param `{param}`"
                )
                help_ = "declare a param of this name in the state machine"
                report.report("no-place", fact.origin, target=TARGET, what=what, help=help_)
                return False
    return True


def _unknown_param(condition: Expression, machine: StateMachine | None) -> str | None:
    """Return a param of the robot that its machine does not have, or None."""
    known = {param.name for param in machine.params} if machine is not None else set()
    for part in subexpressions(condition):
        if isinstance(part, ParamRef) and part.name not in known:
            return part.name
    return None


def _check_senders(properties: Iterable[Property], system: System, report: Diagnostics) -> None:
    """Report events from outside that robots cannot tell from those of other robots."""
    sent = {name for machine in system.machines for name in sent_events(machine)}
    unknown = sent - envelopes_of(system).keys()
    for property_ in properties:
        for fact in facts_of(property_):
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
        keywords: list[tuple[str, object]] = []
        if claim.robots is not None:
            keywords.append(("robots", self._robots(claim.robots)))
        if claim.guard is not None:
            keywords.append(("condition", condition_text(claim.guard)))
        name = (claim.name,) if claim.name else ()
        return self._call("Fact", (claim.act, *name), keywords)

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
