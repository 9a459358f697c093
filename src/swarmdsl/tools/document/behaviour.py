"""Entries of state machines and of the states in them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Choice,
    Effect,
    Exit,
    FinalState,
    History,
    Initial,
    Node,
    Parallel,
    Param,
    Region,
    State,
    StateMachine,
    Transition,
    Variable,
    Vertex,
)
from swarmdsl.syntax.ast import Entry as OnEntry
from swarmdsl.tools.document.book import Book, link, listed
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.page import Cell, Entry, Inline, Prose, Row, Table

_N = TypeVar("_N", bound=Node)
_COLUMNS = ("on", "guard", "effects", "to", "description")


def machine(element: Element, book: Book) -> Entry:
    """A state machine with all its states, the inner ones beside those that they are in."""
    node = element.node
    assert isinstance(node, StateMachine)
    states = [each for each in element.walk() if isinstance(each.node, (Vertex, Region))]
    ends = [each for each in element.inside if isinstance(each.node, FinalState)]
    variables = []
    for item in node.items:
        inner = book.elements.of(item)
        if isinstance(item, Variable) and inner is not None:
            cells = (
                book.type(item.type, inner),
                book.code(item.initial, inner),
                book.used_by(inner),
            )
            variables.append(book.row(inner, cells))
    columns = ("name", "type", "first value", "used by", "description")
    facts: list[tuple[str, Cell]] = [
        ("begins in", _initial(node.items, element, book)),
        ("outcomes", listed(ends) or (("none: it never ends",) if node.endless else ())),
        ("used by", book.used_by(element)),
    ]
    blocks = (
        book.figures.get(element),
        book.params(element, (item for item in node.items if isinstance(item, Param))),
        Table("Variables", columns, tuple(variables)),
    )
    return book.entry(element, facts, blocks, (_state(each, book) for each in states))


def _state(element: Element, book: Book) -> Entry:
    node = element.node
    inside = [each for each in element.inside if isinstance(each.node, (Vertex, Region))]
    parent = element.parent
    facts: list[tuple[str, Cell]] = []
    if parent is not None and parent.parent is not None:
        facts.append(("in", (link(parent),)))
    rows: Iterable[Row] = ()
    match node:
        case State() | Parallel():
            rows = [_transition(each, element, book) for each in _all(node.items, Transition)]
            facts += _behaviour(node, element, book)
        case Region():
            facts.append(("begins in", _initial(node.items, element, book)))
        case Choice():
            rows = [_transition(each, element, book) for each in node.branches]
        case History():
            facts.append(("else to", (book.names.code(node.target.span, element),)))
    facts.append(("regions" if isinstance(node, Parallel) else "states", listed(inside)))
    facts.append(("reached from", book.used_by(element)))
    tables = (Table("Transitions", _COLUMNS, tuple(rows)),)
    return book.entry(element, facts, tables, has_code=False)


def _behaviour(node: State | Parallel, element: Element, book: Book) -> Iterable[tuple[str, Cell]]:
    """What a state does, and when."""
    if isinstance(node, State) and node.machine is not None:
        values: list[Inline] = []
        for binding in node.bindings:
            values += [", " if values else " with ", *book.code(binding, element)]
        yield "runs", (book.names.code(node.machine.span, element), *values)
    for entry in _all(node.items, OnEntry):
        yield "entry", (*_effects(entry.effects, element, book), *_doc(entry.doc))
    for activity in _all(node.items, Activity):
        yield "activity", (*book.code(activity, element), *_doc(activity.doc))
    for exit_ in _all(node.items, Exit):
        yield "exit", (*_effects(exit_.effects, element, book), *_doc(exit_.doc))
    if isinstance(node, State):
        yield "begins in", _initial(node.items, element, book)


def _transition(item: Transition | Branch, element: Element, book: Book) -> Row:
    triggers: list[Inline] = []
    if isinstance(item, Transition):
        for trigger in item.triggers:
            triggers += [", "] if triggers else []
            triggers += book.code(trigger, element)
        stays = "stays, and leaves no state" if item.target is None else ""
        if item.internal and item.target is not None:
            triggers += [" (internal)"]
    else:
        triggers, stays = ["else"] if item.otherwise else [], ""
    target = item.target
    cells: tuple[Cell, ...] = (
        tuple(triggers) or ("at once",),
        book.code(item.guard, element),
        _effects(item.effects, element, book),
        (book.names.code(target.span, element),) if target is not None else (stays,),
        (Prose(item.doc),) if item.doc else (),
    )
    return Row(cells)


def _initial(items: Iterable[object], element: Element, book: Book) -> Cell:
    for item in _all(items, Initial):
        return (book.names.code(item.target.span, element), *_doc(item.doc))
    return ()


def _effects(effects: Iterable[Effect], element: Element, book: Book) -> Cell:
    found: list[Inline] = []
    for effect in effects:
        found += [", "] if found else []
        found += book.code(effect, element)
    return tuple(found)


def _all(items: Iterable[object], kind: type[_N]) -> list[_N]:
    return [item for item in items if isinstance(item, kind)]


def _doc(text: str) -> Cell:
    return (" ", Prose(text)) if text else ()
