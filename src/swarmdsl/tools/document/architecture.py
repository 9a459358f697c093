"""Entries of swarms, members, components, environments, fitness, properties and optimizations."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.property_words import in_words
from swarmdsl.analysis.resolve.inheritance import all_items, lineage
from swarmdsl.base.naming import snake_case
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    Contract,
    CountRange,
    Environment,
    EnvironmentUse,
    Fitness,
    FitnessInput,
    FitnessUse,
    Heartbeat,
    Member,
    Node,
    Objective,
    Optimization,
    Param,
    Parameter,
    ParamRange,
    Part,
    Port,
    Property,
    RobotValues,
    Role,
    Setting,
    Size,
    SubjectTo,
    Swarm,
    World,
)
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link, links
from swarmdsl.tools.document.names import doc_of
from swarmdsl.tools.document.page import Cell, Code, Entry, Prose, Row, Table
from swarmdsl.tools.document.space import equipment_table, geometry_tables, sights_table, weather


def swarm(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a swarm: its roles, environment and fitness."""
    node = element.node
    assert isinstance(node, Swarm)
    roles = []
    own: dict[str, list[RobotValues]] = {}
    for item in node.items:
        if isinstance(item, RobotValues):
            own.setdefault(item.role.name, []).append(item)
    for role in node.items:
        inner = builder.elements.of(role)
        if isinstance(role, Role) and inner is not None:
            many = role.multiplicity
            count = _count(many.lower, many.upper) if many is not None else "one"
            values = [builder.code(role.start, inner)] if role.start is not None else []
            values += [builder.code(value, inner) for value in role.values]
            values += [_robot(robot, element, builder) for robot in own.get(str(role.name), ())]
            cells = (_target(builder, role.member.target), (count,), _joined(values))
            roles.append(builder.row(inner, cells))
    facts = [
        *_uses(element, builder, EnvironmentUse, "environment"),
        *_uses(element, builder, FitnessUse, "fitness"),
        *_heartbeat(element, builder),
        ("used by", builder.used_by(element)),
    ]
    tables = (
        Table("Roles", ("role", "member", "multiplicity", "values", "description"), tuple(roles)),
    )
    return builder.entry(element, facts, (builder.figures.get(element), *tables))


def member(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a member: its parts, connectors, ports, params and behavior."""
    node = element.node
    assert isinstance(node, Member)
    parts = []
    for part in all_items(node, Part):
        inner = builder.elements.of(part)
        if inner is not None:
            values = [builder.code(value, inner) for value in part.values]
            parts.append(
                builder.row(
                    inner, (_target(builder, part.component.target), _joined(values)), element
                )
            )
    blocks = (
        builder.figures.get(element),
        Table("Parts", ("part", "component", "values", "description"), tuple(parts)),
        _connectors(element, node, builder),
        _ports(element, node, builder),
        builder.params(element, all_items(node, Param)),
        equipment_table(element, node, builder),
        _contracts(element, node, builder),
    )
    facts = [
        *_heritage(element, node, builder),
        *_communication(element, node, builder),
        ("used by", builder.used_by(element)),
    ]
    return builder.entry(element, facts, blocks)


def component(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a component: its ports, params and operations."""
    node = element.node
    assert isinstance(node, Component)
    inherited = [builder.elements.of(each) for base in lineage(node)[1:] for each in base.items]
    facts = [
        *_heritage(element, node, builder),
        ("inherits", links([each for each in inherited if each and each.kind == "operation"])),
        ("used by", builder.used_by(element)),
    ]
    blocks = (
        _ports(element, node, builder),
        builder.params(element, all_items(node, Param)),
        sights_table(element, node, builder),
    )
    operations = [
        _operation(each, builder) for each in element.children if each.kind == "operation"
    ]
    return builder.entry(element, facts, blocks, operations)


def _operation(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of an operation: its parameters and the servers that provide it."""
    servers = [
        (Code(((each.communication.name, None),)),) for each in builder.functions.get(element, ())
    ]
    rows = []
    for inner in element.children:
        assert isinstance(inner.node, Parameter)
        cells = ((inner.node.direction or "in",), builder.type(inner.node.type, inner))
        rows.append(builder.row(inner, cells))
    facts = [("servers", _joined(servers)), ("used by", builder.used_by(element))]
    columns = ("parameter", "direction", "type", "description")
    return builder.entry(element, facts, (Table("Parameters", columns, tuple(rows)),))


def environment(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of an environment: its world, size and geometry."""
    assert isinstance(element.node, Environment)
    facts: list[tuple[str, Cell]] = []
    for item in element.node.items:
        doc: Cell = (" ", Prose(item.doc)) if item.doc else ()
        if isinstance(item, World):
            facts.append(("world", (Code(((str(item.file), None),)), *doc)))
        elif isinstance(item, Size):
            lengths = filter(None, (item.width, item.depth, item.height))
            facts.append(("size", (" x ".join(lengths), *doc)))
    facts += weather(element, builder)
    used = ("used by", builder.used_by(element))
    blocks = (builder.figures.get(element), *geometry_tables(element, builder))
    return builder.entry(element, [*facts, used], blocks)


def fitness(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a fitness: its inputs and objective."""
    node = element.node
    assert isinstance(node, Fitness)
    facts: list[tuple[str, Cell]] = [("about", _target(builder, node.about))]
    inputs = []
    for item in node.items:
        inner = builder.elements.of(item)
        if isinstance(item, Objective):
            doc: Cell = (" ", Prose(item.doc)) if item.doc else ()
            facts.append((item.goal, (*builder.code(item.value, element), *doc)))
        elif isinstance(item, FitnessInput) and inner is not None:
            measure = builder.code(item.measure or item.space, inner)
            inputs.append(builder.row(inner, (builder.type(item.type, inner), measure)))
    blocks = (
        Table("Inputs", ("input", "type", "measure", "description"), tuple(inputs)),
        builder.params(element, (item for item in node.items if isinstance(item, Param))),
    )
    return builder.entry(element, [*facts, ("used by", builder.used_by(element))], blocks)


def property_(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a property: its sentence, what it is about, and its meaning in words."""
    node = element.node
    assert isinstance(node, Property)
    facts: list[tuple[str, Cell]] = [
        ("about", _target(builder, node.about)),
        ("means", (Prose(in_words(node)),)),
    ]
    return builder.entry(element, facts)


def optimization(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of an optimization: its search space and settings."""
    node = element.node
    assert isinstance(node, Optimization)
    facts: list[tuple[str, Cell]] = [("swarm", _target(builder, node.swarm.target))]
    rows = []
    for item in node.items:
        doc: Cell = (Prose(item.doc),) if item.doc else ()
        if isinstance(item, Setting):
            facts.append((item.name, (*builder.code(item.value, element), *doc)))
            continue
        if isinstance(item, SubjectTo):
            kept = _target(builder, item.property.target, item.property.name)
            facts.append(("subject to", (*kept, *doc)))
            continue
        first, step = builder.code(item.lower, element), None
        if isinstance(item, CountRange):
            what: Cell = ("number of ", *_target(builder, item.role.target, item.role.name))
        elif isinstance(item, ParamRange):
            what = _target(builder, item.param.target, f"{item.role.name}.{item.param.name}")
            step = item.step
        cells = (what, first, builder.code(item.upper, element), builder.code(step, element), doc)
        rows.append(Row(cells))
    columns = ("parameter", "minimum", "maximum", "step", "description")
    return builder.entry(element, facts, (Table("Search space", columns, tuple(rows)),))


def _ports(element: Element, node: Component | Member, builder: EntryBuilder) -> Table:
    rows = []
    for port in all_items(node, Port):
        inner = builder.elements.of(port)
        if inner is not None:
            topic = str(port.topic) if port.topic is not None else snake_case(port.name)
            cells = ((port.direction,), builder.type(port.type, inner), (Code(((topic, None),)),))
            rows.append(builder.row(inner, cells, element))
    return Table("Ports", ("port", "direction", "type", "topic", "description"), tuple(rows))


def _connectors(element: Element, node: Member, builder: EntryBuilder) -> Table:
    rows = []
    for item in all_items(node, Connector):
        owner = builder.elements.at(item.span) or element
        doc: Cell = (Prose(item.doc),) if item.doc else ()
        carried = builder.elements.of(item.source.port.target)
        type_ = item.source.port.target.type if item.source.port.target is not None else None
        cells = (
            builder.code(item.source, owner),
            builder.code(item.target, owner),
            builder.type(type_, carried) if type_ is not None and carried is not None else (),
            doc,
        )
        rows.append(Row(cells))
    return Table("Connectors", ("from", "to", "type", "description"), tuple(rows))


def _contracts(element: Element, node: Member, builder: EntryBuilder) -> Table:
    rows = []
    for item in all_items(node, Contract):
        inner = builder.elements.of(item)
        if inner is None:
            continue
        if item.function is not None:
            says: Cell = ("when dead call ", builder.names.code(item.function.span, inner))
        else:
            first, last = item.triggers[0].span, item.states[-1].span
            promise = Span(first.source, first.start, last.end)
            says = ("on ", builder.names.code(promise, inner))
        rows.append(builder.row(inner, (says,), element))
    return Table("Contracts", ("contract", "promise", "description"), tuple(rows))


def _heritage(
    element: Element, node: Component | Member, builder: EntryBuilder
) -> Iterable[tuple[str, Cell]]:
    bases = [builder.elements.of(base) for base in lineage(node)[1:]]
    yield "extends", links([base for base in bases if base is not None])
    for use in all_items(node, BehaviorUse):
        owner = builder.elements.at(use.span) or element
        doc: Cell = (" ", Prose(use.doc)) if use.doc else ()
        yield "behavior", (builder.names.code(use.machine.span, owner), *doc)


def _communication(
    element: Element, node: Member, builder: EntryBuilder
) -> Iterable[tuple[str, Cell]]:
    for item in all_items(node, CommunicationSettings):
        owner = builder.elements.at(item.span) or element
        values = _joined([builder.code(value, owner) for value in item.values])
        yield "communication", (str(item.technology), *((": ", *values) if values else ()))


def _robot(robot: RobotValues, element: Element, builder: EntryBuilder) -> Cell:
    """Values of a robot, with its documentation."""
    doc = doc_of(robot)
    return (*builder.code(robot, element), *((" ", Prose(doc)) if doc else ()))


def _uses(
    element: Element,
    builder: EntryBuilder,
    kind: type[EnvironmentUse] | type[FitnessUse],
    term: str,
) -> Iterable[tuple[str, Cell]]:
    assert isinstance(element.node, Swarm)
    for item in element.node.items:
        if isinstance(item, kind):
            ref = item.environment if isinstance(item, EnvironmentUse) else item.fitness
            doc = doc_of(item)
            yield term, (builder.names.code(ref.span, element), *((" ", Prose(doc)) if doc else ()))


def _heartbeat(element: Element, builder: EntryBuilder) -> Iterable[tuple[str, Cell]]:
    assert isinstance(element.node, Swarm)
    for item in element.node.items:
        if isinstance(item, Heartbeat):
            period = builder.names.code(item.period.span, element)
            timeout = builder.names.code(item.timeout.span, element)
            doc = doc_of(item)
            more = (" ", Prose(doc)) if doc else ()
            yield "heartbeat", (period, ", lost after ", timeout, *more)


def _target(builder: EntryBuilder, node: Node | None, text: str | None = None) -> Cell:
    element = builder.elements.of(node)
    return (link(element, text),) if element is not None else (text or "",)


def _joined(cells: Iterable[Cell]) -> Cell:
    """Join cells with commas."""
    found: list[str | Code | Prose] = []
    for cell in cells:
        found += [", "] if found else []
        found += cell
    return tuple(found)


def _count(lower: str, upper: str) -> str:
    """Multiplicity of a role as text."""
    if lower == "*" or (lower == "0" and upper == "*"):
        return "any number"
    if upper == "*":
        return f"{lower} or more"
    return f"{lower} to {upper}" if upper and upper != lower else lower
