"""Entries of swarms, members, components, and what is around them."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.resolve.inheritance import all_items, lineage
from swarmdsl.base.naming import snake_case
from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    CountRange,
    Environment,
    EnvironmentUse,
    Fitness,
    FitnessInput,
    FitnessUse,
    Member,
    Node,
    Objective,
    Optimization,
    Param,
    Parameter,
    ParamRange,
    Part,
    Port,
    Role,
    Setting,
    Size,
    Swarm,
    World,
)
from swarmdsl.tools.document.book import Book, link, listed
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.names import doc_of
from swarmdsl.tools.document.page import Cell, Code, Entry, Prose, Row, Table


def swarm(element: Element, book: Book) -> Entry:
    """A swarm: its roles, and where and how well it works."""
    node = element.node
    assert isinstance(node, Swarm)
    roles = []
    for role in node.items:
        inner = book.elements.of(role)
        if isinstance(role, Role) and inner is not None:
            many = role.multiplicity
            count = _count(many.lower, many.upper) if many is not None else "one"
            roles.append(book.row(inner, (_target(book, role.member.target), (count,))))
    facts = [
        *_uses(element, book, EnvironmentUse, "environment"),
        *_uses(element, book, FitnessUse, "fitness"),
        ("used by", book.used_by(element)),
    ]
    tables = (Table("Roles", ("role", "member", "number", "description"), tuple(roles)),)
    return book.entry(element, facts, (book.figures.get(element), *tables))


def member(element: Element, book: Book) -> Entry:
    """A member: what it is built of, how it behaves, and what it shows to the outside."""
    node = element.node
    assert isinstance(node, Member)
    parts = []
    for part in all_items(node, Part):
        inner = book.elements.of(part)
        if inner is not None:
            values = [book.code(value, inner) for value in part.values]
            parts.append(
                book.row(inner, (_target(book, part.component.target), _joined(values)), element)
            )
    blocks = (
        book.figures.get(element),
        Table("Parts", ("part", "component", "values", "description"), tuple(parts)),
        _connectors(element, node, book),
        _ports(element, node, book),
        book.params(element, all_items(node, Param)),
    )
    facts = [
        *_heritage(element, node, book),
        *_communication(element, node, book),
        ("used by", book.used_by(element)),
    ]
    return book.entry(element, facts, blocks)


def component(element: Element, book: Book) -> Entry:
    """A component: its ports, params and operations."""
    node = element.node
    assert isinstance(node, Component)
    inherited = [book.elements.of(each) for base in lineage(node)[1:] for each in base.items]
    facts = [
        *_heritage(element, node, book),
        ("inherits", listed([each for each in inherited if each and each.kind == "operation"])),
        ("used by", book.used_by(element)),
    ]
    blocks = (_ports(element, node, book), book.params(element, all_items(node, Param)))
    operations = [_operation(each, book) for each in element.inside if each.kind == "operation"]
    return book.entry(element, facts, blocks, operations)


def _operation(element: Element, book: Book) -> Entry:
    """What a component can be asked, and the servers that are asked for it."""
    servers = [
        (Code(((each.communication.name, None),)),) for each in book.functions.get(element, ())
    ]
    rows = []
    for inner in element.inside:
        assert isinstance(inner.node, Parameter)
        cells = ((inner.node.direction or "in",), book.type(inner.node.type, inner))
        rows.append(book.row(inner, cells))
    facts = [("servers", _joined(servers)), ("used by", book.used_by(element))]
    columns = ("parameter", "direction", "type", "description")
    return book.entry(element, facts, (Table("Parameters", columns, tuple(rows)),))


def environment(element: Element, book: Book) -> Entry:
    """An environment: its world and its size."""
    assert isinstance(element.node, Environment)
    facts: list[tuple[str, Cell]] = []
    for item in element.node.items:
        doc: Cell = (" ", Prose(item.doc)) if item.doc else ()
        if isinstance(item, World):
            facts.append(("world", (Code(((str(item.file), None),)), *doc)))
        elif isinstance(item, Size):
            lengths = filter(None, (item.width, item.depth, item.height))
            facts.append(("size", (" x ".join(lengths), *doc)))
    return book.entry(element, [*facts, ("used by", book.used_by(element))])


def fitness(element: Element, book: Book) -> Entry:
    """A fitness: what is measured, and what is to be as great or small as possible."""
    node = element.node
    assert isinstance(node, Fitness)
    facts: list[tuple[str, Cell]] = []
    inputs = []
    for item in node.items:
        inner = book.elements.of(item)
        if isinstance(item, Objective):
            doc: Cell = (" ", Prose(item.doc)) if item.doc else ()
            facts.append((item.goal, (*book.code(item.value, element), *doc)))
        elif isinstance(item, FitnessInput) and inner is not None:
            inputs.append(book.row(inner, (book.type(item.type, inner),)))
    blocks = (
        Table("Inputs", ("measured", "type", "description"), tuple(inputs)),
        book.params(element, (item for item in node.items if isinstance(item, Param))),
    )
    return book.entry(element, [*facts, ("used by", book.used_by(element))], blocks)


def optimization(element: Element, book: Book) -> Entry:
    """A search for the best swarm: what is varied, and for how long."""
    node = element.node
    assert isinstance(node, Optimization)
    facts: list[tuple[str, Cell]] = [("swarm", _target(book, node.swarm.target))]
    rows = []
    for item in node.items:
        doc: Cell = (Prose(item.doc),) if item.doc else ()
        if isinstance(item, Setting):
            facts.append((item.name, (*book.code(item.value, element), *doc)))
            continue
        first, step = book.code(item.lower, element), None
        if isinstance(item, CountRange):
            what: Cell = ("number of ", *_target(book, item.role.target, item.role.name))
        elif isinstance(item, ParamRange):
            what = _target(book, item.param.target, f"{item.role.name}.{item.param.name}")
            step = item.step
        cells = (what, first, book.code(item.upper, element), book.code(step, element), doc)
        rows.append(Row(cells))
    columns = ("varied", "lowest", "highest", "step", "description")
    return book.entry(element, facts, (Table("Ranges", columns, tuple(rows)),))


def _ports(element: Element, node: Component | Member, book: Book) -> Table:
    rows = []
    for port in all_items(node, Port):
        inner = book.elements.of(port)
        if inner is not None:
            topic = str(port.topic) if port.topic is not None else snake_case(port.name)
            cells = ((port.direction,), book.type(port.type, inner), (Code(((topic, None),)),))
            rows.append(book.row(inner, cells, element))
    return Table("Ports", ("port", "direction", "type", "topic", "description"), tuple(rows))


def _connectors(element: Element, node: Member, book: Book) -> Table:
    rows = []
    for item in all_items(node, Connector):
        owner = book.elements.at(item.span) or element
        doc: Cell = (Prose(item.doc),) if item.doc else ()
        carried = book.elements.of(item.source.port.target)
        type_ = item.source.port.target.type if item.source.port.target is not None else None
        cells = (
            book.code(item.source, owner),
            book.code(item.target, owner),
            book.type(type_, carried) if type_ is not None and carried is not None else (),
            doc,
        )
        rows.append(Row(cells))
    return Table("Connectors", ("from", "to", "type", "description"), tuple(rows))


def _heritage(element: Element, node: Component | Member, book: Book) -> Iterable[tuple[str, Cell]]:
    bases = [book.elements.of(base) for base in lineage(node)[1:]]
    yield "extends", listed([base for base in bases if base is not None])
    for use in all_items(node, BehaviorUse):
        owner = book.elements.at(use.span) or element
        doc: Cell = (" ", Prose(use.doc)) if use.doc else ()
        yield "behavior", (book.names.code(use.machine.span, owner), *doc)


def _communication(element: Element, node: Member, book: Book) -> Iterable[tuple[str, Cell]]:
    for item in all_items(node, CommunicationSettings):
        owner = book.elements.at(item.span) or element
        values = _joined([book.code(value, owner) for value in item.values])
        yield "communication", (str(item.technology), *((": ", *values) if values else ()))


def _uses(
    element: Element, book: Book, kind: type[EnvironmentUse] | type[FitnessUse], term: str
) -> Iterable[tuple[str, Cell]]:
    assert isinstance(element.node, Swarm)
    for item in element.node.items:
        if isinstance(item, kind):
            ref = item.environment if isinstance(item, EnvironmentUse) else item.fitness
            doc = doc_of(item)
            yield term, (book.names.code(ref.span, element), *((" ", Prose(doc)) if doc else ()))


def _target(book: Book, node: Node | None, text: str | None = None) -> Cell:
    element = book.elements.of(node)
    return (link(element, text),) if element is not None else (text or "",)


def _joined(cells: Iterable[Cell]) -> Cell:
    """Cells one after the other, with commas."""
    found: list[str | Code | Prose] = []
    for cell in cells:
        found += [", "] if found else []
        found += cell
    return tuple(found)


def _count(lower: str, upper: str) -> str:
    """How many members a role has, in words."""
    if lower == "*" or (lower == "0" and upper == "*"):
        return "any number"
    if upper == "*":
        return f"{lower} or more"
    return f"{lower} to {upper}" if upper and upper != lower else lower
