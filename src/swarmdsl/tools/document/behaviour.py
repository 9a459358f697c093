"""Entries of state machines and their states."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Choice,
    Defer,
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
    nodes_of,
)
from swarmdsl.syntax.ast import Entry as OnEntry
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link, links
from swarmdsl.tools.document.page import Cell, Entry, Inline, Prose, Row, Table

_NodeType = TypeVar("_NodeType", bound=Node)
_COLUMNS = ("on", "guard", "effects", "to", "description")


def machine(element: Element, builder: EntryBuilder) -> Entry:
    """Entry of a state machine with all its states in a flat list."""
    node = element.node
    assert isinstance(node, StateMachine)
    states = [each for each in element.walk() if isinstance(each.node, (Vertex, Region))]
    ends = [each for each in element.children if isinstance(each.node, FinalState)]
    variables = []
    for item in nodes_of(node, Variable):
        inner = builder.elements.of(item)
        if inner is not None:
            cells = (
                builder.type(item.type, inner),
                builder.code(item.initial, inner),
                builder.used_by(inner),
            )
            variables.append(builder.row(inner, cells))
    columns = ("name", "type", "initial value", "used by", "description")
    facts: list[tuple[str, Cell]] = [
        ("initial state", _initial(node.items, element, builder)),
        ("outcomes", links(ends) or (("none (endless)",) if node.endless else ())),
        ("used by", builder.used_by(element)),
    ]
    blocks = (
        builder.figures.get(element),
        builder.params(element, (item for item in node.items if isinstance(item, Param))),
        Table("Variables", columns, tuple(variables)),
    )
    return builder.entry(element, facts, blocks, (_state(each, builder) for each in states))


def _state(element: Element, builder: EntryBuilder) -> Entry:
    node = element.node
    inside = [each for each in element.children if isinstance(each.node, (Vertex, Region))]
    parent = element.parent
    facts: list[tuple[str, Cell]] = []
    if parent is not None and parent.parent is not None:
        facts.append(("parent", (link(parent),)))
    rows: Iterable[Row] = ()
    match node:
        case State() | Parallel():
            rows = [
                _transition(each, element, builder) for each in _of_type(node.items, Transition)
            ]
            facts += _behaviour(node, element, builder)
        case Region():
            facts.append(("initial state", _initial(node.items, element, builder)))
        case Choice():
            rows = [_transition(each, element, builder) for each in node.branches]
        case History():
            default = node.target or node.initial
            assert default is not None
            facts.append(("default", (builder.names.code(default.span, element),)))
    facts.append(("regions" if isinstance(node, Parallel) else "states", links(inside)))
    facts.append(("reached from", links(builder.names.sources(element))))
    tables = (Table("Transitions", _COLUMNS, tuple(rows)),)
    return builder.entry(element, facts, tables, has_code=False)


def _behaviour(
    node: State | Parallel, element: Element, builder: EntryBuilder
) -> Iterable[tuple[str, Cell]]:
    """Yield the submachine, effects, activity and initial state of a state."""
    if isinstance(node, State) and node.machine is not None:
        values: list[Inline] = []
        for binding in node.bindings:
            values += [", " if values else " with ", *builder.code(binding, element)]
        yield "submachine", (builder.names.code(node.machine.span, element), *values)
    for entry in _of_type(node.items, OnEntry):
        yield "entry", (*_effects(entry.effects, element, builder), *_doc(entry.doc))
    for activity in _of_type(node.items, Activity):
        yield "activity", (*builder.code(activity, element), *_doc(activity.doc))
    for defer in _of_type(node.items, Defer):
        yield "defers", (*_deferred(defer, element, builder), *_doc(defer.doc))
    for exit_ in _of_type(node.items, Exit):
        yield "exit", (*_effects(exit_.effects, element, builder), *_doc(exit_.doc))
    if isinstance(node, State):
        yield "initial state", _initial(node.items, element, builder)


def _transition(item: Transition | Branch, element: Element, builder: EntryBuilder) -> Row:
    triggers: list[Inline] = []
    if isinstance(item, Transition):
        for trigger in item.triggers:
            triggers += [", "] if triggers else []
            triggers += builder.code(trigger, element)
        no_target = "none (internal)" if item.target is None else ""
        if item.internal and item.target is not None:
            triggers += [" (internal)"]
    else:
        triggers, no_target = ["else"] if item.otherwise else [], ""
    target = item.target
    cells: tuple[Cell, ...] = (
        tuple(triggers) or ("immediately",),
        builder.code(item.guard, element),
        _effects(item.effects, element, builder),
        (builder.names.code(target.span, element),) if target is not None else (no_target,),
        (Prose(item.doc),) if item.doc else (),
    )
    return Row(cells)


def _initial(items: Iterable[object], element: Element, builder: EntryBuilder) -> Cell:
    for item in _of_type(items, Initial):
        return (builder.names.code(item.target.span, element), *_doc(item.doc))
    return ()


def _effects(effects: Iterable[Effect], element: Element, builder: EntryBuilder) -> Cell:
    found: list[Inline] = []
    for effect in effects:
        found += [", "] if found else []
        found += builder.code(effect, element)
    return tuple(found)


def _deferred(defer: Defer, element: Element, builder: EntryBuilder) -> Cell:
    found: list[Inline] = []
    for event in defer.events:
        found += [", "] if found else []
        found += builder.code(event, element)
    return tuple(found)


def _of_type(items: Iterable[object], kind: type[_NodeType]) -> list[_NodeType]:
    return [item for item in items if isinstance(item, kind)]


def _doc(text: str) -> Cell:
    return (" ", Prose(text)) if text else ()
