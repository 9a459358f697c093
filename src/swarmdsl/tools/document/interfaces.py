"""Entries of functions, of events, and of the data that they carry."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.event_topics import topic_of
from swarmdsl.analysis.types.enum_values import numbers, underlying
from swarmdsl.base.naming import incoming_topic
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    AliasType,
    Communication,
    Constant,
    EnumType,
    Event,
    Field,
    Function,
    FunctionPort,
    Interface,
    MessageType,
    OutcomeTrigger,
    Param,
    ServiceType,
    State,
    StructType,
    Transition,
)
from swarmdsl.tools.document.book import Book, link, listed
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.page import Cell, Code, Entry, Inline, Prose, Row, Table
from swarmdsl.tools.document.traffic import States

_OUTCOMES = ("succeeded", "aborted", "preempted")


def function(element: Element, book: Book) -> Entry:
    """A function as an API: how it is called, with what, what it hears and tells, who calls it."""
    node = element.node
    assert isinstance(node, Function)
    call = next(item for item in node.items if isinstance(item, Communication))
    interface = book.names.type(call.type.type)
    ports = tuple(
        Row(
            (
                (item.direction,),
                (Code(((str(item.topic), None),)),),
                book.type(item.type, element),
                (Prose(item.doc),) if item.doc else (),
            )
        )
        for item in node.items
        if isinstance(item, FunctionPort)
    )
    facts: list[tuple[str, Cell]] = [
        ("category", (node.category,)),
        ("paradigm", (call.paradigm,)),
        (
            "server",
            (Code(((str(call.name), None),)), *((" ", Prose(call.doc)) if call.doc else ())),
        ),
        ("interface", book.type(call.type, element)),
    ]
    blocks = (
        *(_parts(interface, book, linked=True) if interface is not None else ()),
        Table("Topics", ("direction", "topic", "type", "description"), ports),
        book.params(element, (item for item in node.items if isinstance(item, Param))),
        _calls(element, book),
    )
    return book.entry(element, facts, blocks)


def functions_table(book: Book) -> Table:
    """Every function, and every operation of a component, as others call it."""
    rows = []
    for each in book.system.functions:
        element = book.elements.at(each.origin)
        if element is None:
            continue
        call = each.communication
        interface = book.names.type(call.type)
        shown = link(interface, str(call.type)) if interface else Code(((str(call.type), None),))
        cells: tuple[Cell, ...] = (
            (link(element),),
            (each.category,),
            (call.paradigm,),
            (Code(((call.name, None),)),),
            (shown,),
            _states(book.traffic.called.get(each.name, {})),
        )
        rows.append(Row(cells))
    columns = ("function", "category", "paradigm", "server", "interface", "used by")
    return Table("Who uses which function", columns, tuple(rows))


def event(element: Element, book: Book) -> Entry:
    """An event: what it carries, on which topics, and between whom."""
    node = element.node
    assert isinstance(node, Event)
    topic = topic_of(node)
    (name,) = {each.name for each in book.events[element]}
    message = book.names.type(node.type.type)
    heard = incoming_topic(topic, node.swarm)
    facts: list[tuple[str, Cell]] = [
        ("message", book.type(node.type, element)),
        ("sent on", (Code(((topic, None),)),)),
        ("heard on", (Code(((heard, None),)),) if heard != topic else ()),
        ("sent by", _states(book.traffic.sent.get(name, {})) or ("no state machine",)),
        ("handled by", _states(book.traffic.handled.get(name, {})) or ("no state machine",)),
    ]
    tables = _parts(message, book, linked=True) if message is not None else ()
    return book.entry(element, facts, tables)


def interface(element: Element, book: Book) -> Entry:
    """A struct, message, service or action: its fields."""
    return book.entry(element, [("used by", book.used_by(element))], _parts(element, book))


def enum(element: Element, book: Book) -> Entry:
    """An enum: its values, and the numbers behind them."""
    node = element.node
    assert isinstance(node, EnumType)
    known = numbers(node)
    rows = [
        book.row(inner, ((Code(((str(known[inner.name]), None),)),), book.used_by(inner)))
        for inner in element.inside
    ]
    facts: list[tuple[str, Cell]] = [
        ("type of the numbers", (Code(((str(underlying(node)), None),)),)),
        ("used by", book.used_by(element)),
    ]
    columns = ("value", "number", "used by", "description")
    return book.entry(element, facts, (Table("Values", columns, tuple(rows)),))


def constant(element: Element, book: Book) -> Entry:
    """A constant: its type and value."""
    node = element.node
    assert isinstance(node, Constant)
    facts = [
        ("type", book.type(node.type, element)),
        ("value", book.code(node.value, element)),
        ("used by", book.used_by(element)),
    ]
    return book.entry(element, facts)


def alias(element: Element, book: Book) -> Entry:
    """Another name of a type."""
    node = element.node
    assert isinstance(node, AliasType)
    stands_for: Cell = (Code(((str(node.type.type), None),)),)
    facts = [("stands for", stands_for), ("used by", book.used_by(element))]
    return book.entry(element, facts)


def _parts(element: Element, book: Book, linked: bool = False) -> tuple[Table, ...]:
    """The fields of an interface by its parts; `linked` ones are described elsewhere."""
    node = element.node
    assert isinstance(node, Interface)

    def fields(title: str, nodes: Iterable[Field]) -> Table:
        rows = []
        for each in nodes:
            inner = book.elements.of(each)
            if inner is not None:
                row = book.row(inner, (book.type(each.type, inner),))
                name: Cell = (link(inner, inner.name),)
                rows.append(Row((name, *row.cells[1:])) if linked else row)
        return Table(title, ("field", "type", "description"), tuple(rows))

    match node:
        case StructType():
            return (fields("Fields", node.fields),)
        case MessageType():
            return (fields("Fields", node.fields), _constants(node, book, linked))
        case ServiceType():
            return (fields("Request", node.request), fields("Response", node.response))
        case ActionType():
            titles = {"Goal": node.goal, "Result": node.result, "Feedback": node.feedback}
            return tuple(fields(title, nodes) for title, nodes in titles.items())
    return ()


def _constants(node: MessageType, book: Book, linked: bool) -> Table:
    rows = []
    for each in node.constants:
        inner = book.elements.of(each)
        if inner is not None and not linked:
            cells = (book.type(each.type, inner), book.code(each.value, inner))
            rows.append(book.row(inner, cells))
    return Table("Constants", ("name", "type", "value", "description"), tuple(rows))


def _calls(element: Element, book: Book) -> Table:
    """The states that call a function, and what follows each outcome there."""
    rows = []
    for state in book.names.users(element):
        node = state.node
        activity = None
        if isinstance(node, State):
            activity = next((item for item in node.items if isinstance(item, Activity)), None)
        if activity is None or not isinstance(node, State):
            continue
        ends: dict[str, list[Inline]] = {outcome: [] for outcome in _OUTCOMES}
        for item in node.items:
            if not isinstance(item, Transition):
                continue
            for trigger in item.triggers:
                if isinstance(trigger, OutcomeTrigger):
                    told = ends[trigger.outcome]
                    told += [", "] if told else []
                    if item.target is not None:
                        told.append(book.names.code(item.target.span, state))
                    else:
                        told.append("stays")
                    if item.guard is not None:
                        told += [" if ", *book.code(item.guard, state)]
        rows.append(Row(((link(state),), book.code(activity, state), *map(tuple, ends.values()))))
    return Table("Used by", ("state", "call", *_OUTCOMES), tuple(rows))


def _states(by_machine: dict[Element, States]) -> Cell:
    """States by their machines: those of a reused machine are named with it."""
    return listed(list(dict.fromkeys(state for found in by_machine.values() for state in found)))
