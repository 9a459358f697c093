"""Find the insertion point of a new element and indent it."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Source
from swarmdsl.driver.line_insertion import above, below, below_head
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    Component,
    Constant,
    Declaration,
    EnumType,
    Environment,
    Event,
    FinalState,
    Fitness,
    Function,
    Member,
    MessageType,
    Node,
    Property,
    Region,
    ServiceType,
    State,
    StateMachine,
    StructType,
    Swarm,
    Vertex,
)
from swarmdsl.syntax.formatter import format_source

# Usual order of declarations in a file.
_ORDER: Sequence[tuple[type, ...]] = (
    (MessageType, ServiceType, ActionType, StructType, EnumType, AliasType, Constant),
    (Event,),
    (Function,),
    (Component,),
    (Member,),
    (StateMachine,),
    (Swarm,),
    (Environment, Fitness),
    (Property,),
)
CONTAINERS = (StateMachine, State, Region)
Container = StateMachine | State | Region


def rank(kind: type) -> int:
    """Position of declarations of a kind in the usual order."""
    return next(place for place, kinds in enumerate(_ORDER) if kind in kinds)


def best_file(files: Sequence[File], kind: type) -> File:
    """File with most declarations of a kind, else of neighboring kinds."""

    def fit(file: File) -> tuple[int, ...]:
        counts = [0] * len(_ORDER)
        for declared in file.model.declarations:
            counts[rank(type(declared))] += 1
        near = sorted(range(len(_ORDER)), key=lambda each: abs(each - rank(kind)))
        return tuple(counts[each] for each in near)

    return max(files, key=fit)


def declaration(file: File, kind: type, text: str) -> Change:
    """Insert a declaration below the last of its kind or of a kind usually before it."""
    formatted = format_source(Source("new", text), Diagnostics())
    assert formatted is not None  # it was parsed without errors
    lines = formatted.strip("\n")
    declared: Sequence[Declaration] = file.model.declarations
    before = [each for each in declared if rank(type(each)) <= rank(kind)]
    same = [each for each in before if rank(type(each)) == rank(kind)]
    neighbors = same or before
    if neighbors:
        last = max(neighbors, key=lambda each: each.span.absolute.start)
        return below(file, last.span.absolute.end, f"\n{lines}")
    if file.model.package is not None or file.model.imports:
        return below_head(file, lines)
    if declared:
        first = min(each.span.absolute.start for each in declared)
        return above(file, _with_documentation(file, first), f"{lines}\n")
    return below(file, len(file.source.text), lines)


def line_in(file: File, owner: Node, items: Sequence[Node], text: str) -> Change:
    """Insert a line below the last of `items` in a block, or first in the block."""
    indent = _indent(file, owner.span.absolute.start) + "  "
    lines = textwrap.indent(text, indent)
    if items:
        return below(file, max(each.span.absolute.end for each in items), lines)
    return below(file, _brace(file, owner) + 1, lines)


def state(file: File, container: Container, name: str, text: str) -> Change:
    """Insert a state below the last state of a container, but above its final states.

    A final state goes below the final states.
    """
    indent = _indent(file, container.span.absolute.start) + "  "
    wrapped = f"statemachine M {{\n  initial S\n\n{text}\n}}\n"
    formatted = format_source(Source("new", wrapped), Diagnostics())
    assert formatted is not None  # it was parsed without errors
    inner = textwrap.dedent(formatted.partition("\n\n")[2].rpartition("\n}")[0])
    vertices = [each for each in container.items if isinstance(each, Vertex)]
    finals = [each for each in vertices if isinstance(each, FinalState)]
    states = [each for each in vertices if each not in finals]
    if not vertices:
        inner = f"initial {name}\n{inner}"
    is_final = inner.splitlines()[-1].startswith("final ")
    neighbors: Sequence[Node] = (finals if is_final and finals else states) or container.items
    separator = "\n" if neighbors is states and _is_separated(file, states) else ""
    lines = separator + textwrap.indent(inner.strip("\n"), indent, lambda line: line.strip() != "")
    if neighbors:
        return below(file, max(each.span.absolute.end for each in neighbors), lines)
    return below(file, _brace(file, container) + 1, lines)


def _with_documentation(file: File, at: int) -> int:
    """Return the start of the comments that document a declaration, or its own."""
    text = file.source.text
    start = text.rfind("\n", 0, at) + 1
    while (above := text.rfind("\n", 0, max(start - 1, 0)) + 1) < start:
        if not text[above:start].lstrip().startswith("///"):
            break
        at = start = above
    return at


def _is_separated(file: File, states: Sequence[Node]) -> bool:
    """Return True if a blank line precedes the last state."""
    start = file.source.text.rfind("\n", 0, states[-1].span.absolute.start)
    return file.source.text[:start].endswith("\n")


def _brace(file: File, node: Node) -> int:
    return file.source.text.index("{", node.span.absolute.start)


def _indent(file: File, at: int) -> str:
    text = file.source.text
    line = text[text.rfind("\n", 0, at) + 1 :]
    return line[: len(line) - len(line.lstrip(" \t"))]
