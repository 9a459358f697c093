"""Diagram of a swarm: members, events between them, and environment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl import ir
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.codegen.diagram.labels import param_line, type_name, value_lines
from swarmdsl.codegen.shared.property_texts import measure_text
from swarmdsl.codegen.swarm_printer.composition import heartbeat
from swarmdsl.codegen.swarm_printer.contracts import contract_text
from swarmdsl.codegen.swarm_printer.expressions import expression, with_names
from swarmdsl.codegen.swarm_printer.layout import quoted
from swarmdsl.codegen.swarm_printer.space import space_items, space_measure, start, text


def composition(swarm: ir.Swarm, system: ir.System) -> Diagram:
    """Return the diagram of a swarm: a box for each role, with its behaviour."""
    members = system.members_by_name
    machines = system.machines_by_name
    uses = {
        name: _Uses(machines.get(name), system)
        for name in dict.fromkeys(members[role.member].behavior or "" for role in swarm.roles)
    }
    roles = [
        _Role(role, members[role.member], uses[members[role.member].behavior or ""])
        for role in swarm.roles
    ]
    head = Node(
        "swarm",
        "swarm",
        swarm.name,
        "swarm",
        (*_heartbeat(swarm), *_optimizations(swarm, system)),
        doc=swarm.doc,
        origin=swarm.origin,
    )
    around = [*_environment(swarm, system), *_fitness(swarm, system)]
    frame = Node(
        "",
        "frame",
        swarm.name,
        "composition",
        nodes=(head, *(role.node() for role in roles), *(node for node, _ in around)),
        doc=swarm.doc,
        origin=swarm.origin,
    )
    edges = (
        *(role.edge() for role in roles),
        *(edge for _, edge in around),
        *_flows(roles, system),
    )
    return Diagram("composition", swarm.name, frame, edges)


class _Uses:
    """Events and functions that a behaviour uses."""

    def __init__(self, machine: ir.StateMachine | None, system: ir.System) -> None:
        states = list(machine.walk()) if machine is not None else []
        effects = [
            effect
            for state in states
            for effect in (
                *state.entry,
                *state.exit,
                *(each for transition in state.transitions for each in transition.effects),
            )
        ]
        self.sent = {each.event for each in effects if isinstance(each, ir.Send)}
        self.heard = {
            trigger.event
            for state in states
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, ir.EventTrigger)
        }
        used = {state.activity.function for state in states if state.activity is not None}
        self.functions = system.functions_of(used)


class _Role:
    """Role in the swarm, with what its behaviour uses."""

    def __init__(self, role: ir.Role, member: ir.Member, uses: _Uses) -> None:
        self.role, self.member, self.uses = role, member, uses

    @property
    def id(self) -> str:
        return f"role.{self.role.name}"

    def node(self) -> Node:
        member = self.member
        groups: list[tuple[str, ...]] = []
        if member.behavior is not None:
            groups.append((f"behavior {member.behavior}",))
        groups.append(tuple(map(param_line, self.role.configured(member).params)))
        for robot in self.role.robots:
            lines = [*filter(None, [start(robot.start).strip()]), *value_lines(robot.values)]
            groups.append(tuple(f"{self.role.name}[{robot.index}] {line}" for line in lines))
        groups.append(tuple(f"{part.name} : {part.component}" for part in member.parts))
        promises = (f"contract {each.name} : {contract_text(each)}" for each in member.contracts)
        groups.append(tuple(promises))
        groups.append(tuple(f"«{each.category}» {each.name}" for each in self.uses.functions))
        return Node(
            self.id,
            "member",
            member.name,
            "member",
            tuple(filter(None, groups)),
            doc=member.doc,
            origin=member.origin,
        )

    def edge(self) -> Edge:
        role = self.role
        return Edge(
            f"{self.id}.composition",
            "composition",
            "swarm",
            self.id,
            (f"{role.name} [{role.multiplicity}]{start(role.start)}",),
            doc=role.doc,
            origin=role.origin,
        )


def _flows(roles: list[_Role], system: ir.System) -> Iterator[Edge]:
    """Yield an edge for each pair of roles that exchange swarm events."""
    hearing: dict[str, list[int]] = {}
    for number, receiver in enumerate(roles):
        for name in receiver.uses.heard:
            hearing.setdefault(name, []).append(number)
    for sender in roles:
        heard: dict[int, list[str]] = {}
        for event in system.events_of(sender.uses.sent):
            for number in hearing.get(event.name, ()) if event.swarm else ():
                heard.setdefault(number, []).append(event.name)
        for number, (*others, last) in sorted(heard.items()):
            receiver = roles[number]
            alone = sender is receiver and sender.role.multiplicity.upper == 1
            if not alone:
                label = (*(f"{each}," for each in others), last)
                yield Edge(f"{sender.id}=>{receiver.id}", "flow", sender.id, receiver.id, label)


def _heartbeat(swarm: ir.Swarm) -> Iterator[tuple[str, ...]]:
    beat = swarm.heartbeat
    if beat is not None:
        yield (heartbeat(beat),)


def _environment(swarm: ir.Swarm, system: ir.System) -> Iterator[tuple[Node, Edge]]:
    for each in system.environments:
        if each.name == swarm.environment:
            lines = [f"world {quoted(each.world)}"] if each.world is not None else []
            if each.size is not None:
                lines.append("size " + " x ".join(f"{side:g} m" for side in each.size))
            space = map(text, space_items(each))
            yield _around(swarm, "environment", each, _groups(lines, space))


def _fitness(swarm: ir.Swarm, system: ir.System) -> Iterator[tuple[Node, Edge]]:
    for each in system.fitness:
        if each.name == swarm.fitness:
            data = [_input(field) for field in each.inputs]
            data += map(param_line, each.params)
            goal = f"{each.goal} {expression(with_names(each.value))}"
            yield _around(swarm, "fitness", each, _groups(data, [goal]))


def _input(field: ir.FitnessInput) -> str:
    declared = f"in {field.name} : {type_name(field.type)}"
    if field.space is not None:
        return f"{declared} = {space_measure(field.space)}"
    if field.measure is None:
        return declared
    return f"{declared} = {measure_text(field.measure)}"


def _around(
    swarm: ir.Swarm,
    kind: Literal["environment", "fitness"],
    thing: ir.Environment | ir.Fitness,
    compartments: tuple[tuple[str, ...], ...],
) -> tuple[Node, Edge]:
    node = Node(
        kind,
        kind,
        thing.name,
        kind,
        compartments,
        doc=thing.doc,
        origin=thing.origin,
    )
    return node, Edge(f"swarm.{kind}", "association", "swarm", kind, origin=swarm.origin)


def _optimizations(swarm: ir.Swarm, system: ir.System) -> Iterator[tuple[str, ...]]:
    """Yield a compartment for each optimization of the swarm."""
    for each in system.optimizations:
        if each.swarm != swarm.name:
            continue
        lines = [f"{name} {expression(with_names(value))}" for name, value in each.settings]
        for param in each.params:
            step = f" step {expression(with_names(param.step))}" if param.step is not None else ""
            span = f"{expression(with_names(param.lower))} .. {expression(with_names(param.upper))}"
            lines.append(f"{param.role}.{param.param} in {span}{step}")
        for count in each.counts:
            span = f"{expression(with_names(count.lower))} .. {expression(with_names(count.upper))}"
            lines.append(f"count of {count.role} in {span}")
        lines += (f"subject to {kept.property}" for kept in each.constraints)
        yield ("«optimize»", *lines)


def _groups(*groups: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    return tuple(lines for group in groups if (lines := tuple(group)))
