"""Align columns of similar neighbouring lines, and trailing comments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.syntax.ast import (
    AliasType,
    Area,
    Branch,
    Communication,
    Connector,
    Constant,
    Contract,
    CountRange,
    EnumValue,
    Equipment,
    Event,
    Field,
    FitnessInput,
    Function,
    FunctionPort,
    Node,
    Obstacle,
    Param,
    ParamRange,
    Part,
    PartValue,
    Port,
    Role,
    Sight,
    Targets,
    Transition,
    Variable,
    Word,
    Zone,
)
from swarmdsl.syntax.formatter.lines import WIDTH, Line
from swarmdsl.syntax.formatter.tokens import Token

# What is longer than this does not push the column of its neighbours away.
_WIDEST_CELL = 40

# Where columns begin, by the kind of the item: at the name or at a symbol.
_NAME = "name"
_COLUMNS: dict[type[Node], tuple[str, ...]] = {
    AliasType: ("=",),
    Area: (":",),
    Branch: ("->",),
    Communication: (_NAME, ":"),
    Connector: ("->",),
    Contract: (":",),
    Constant: (":", "="),
    CountRange: ("in",),
    EnumValue: ("=",),
    Equipment: ("{",),
    Event: (_NAME, ":"),
    Field: (":",),
    FitnessInput: (":", "="),
    Function: (":", "{"),
    FunctionPort: (_NAME, ":"),
    Obstacle: (":",),
    Param: (":", "="),
    ParamRange: ("in",),
    Part: (":",),
    PartValue: ("=",),
    Port: (_NAME, ":"),
    Role: (":",),
    Sight: ("{",),
    Targets: ("at",),
    Transition: ("->",),
    Variable: (":", "="),
    Zone: (":",),
}
_SECTION: tuple[str, ...] = ("{",)
_SAME_GROUP: dict[type[Node], type[Node]] = {ParamRange: CountRange, Zone: Area, Obstacle: Area}


def set_cells(line: Line, node: Node | None, tokens: Sequence[Token], starts: list[int]) -> None:
    """Find the columns of a line that holds a whole item."""
    if node is None:
        line.group, columns = "section", _SECTION
    else:
        kind = type(node)
        line.group, columns = _SAME_GROUP.get(kind, kind).__name__, _COLUMNS.get(kind, ())
    if isinstance(node, (Transition, Branch)) and (
        node.effects or (isinstance(node, Transition) and node.guard is not None)
    ):
        return  # too long before the arrow
    named = node.topic if isinstance(node, FunctionPort) else getattr(node, "name", None)
    name_start = named.span.start if isinstance(named, Word) else None
    depth = 0
    for token, start in zip(tokens, starts, strict=True):
        if token.text in ("(", "["):
            depth += 1
        elif token.text in (")", "]"):
            depth -= 1
        elif depth == 0 and start:
            column = _NAME if token.start == name_start else token.text
            if column in columns:
                line.cells.setdefault(column, start)


def align(lines: Sequence[Line]) -> None:
    """Align the columns of groups of lines, then their trailing comments."""
    for run in _runs(lines):
        for column in dict.fromkeys(column for line in run for column in line.cells):
            _align_column(run, column)
    for run in _commented_runs(lines):
        widest = max(line.width for line in run)
        for line in run:
            line.trailing = " " * (widest - line.width) + line.trailing


def _runs(lines: Iterable[Line]) -> Iterator[list[Line]]:
    """Yield groups of consecutive lines of a kind; comments between them do not count."""
    run: list[Line] = []
    for line in lines:
        if run and (line.blank_above or line.indent != run[0].indent):
            yield run
            run = []
        if line.is_comment:
            continue
        if run and line.group != run[0].group:
            yield run
            run = []
        if line.group is not None:
            run.append(line)
    if run:
        yield run


def _commented_runs(lines: Iterable[Line]) -> Iterator[list[Line]]:
    """Yield groups of consecutive lines with trailing comments."""
    run: list[Line] = []
    for line in lines:
        if run and (line.blank_above or not line.trailing or line.indent != run[0].indent):
            yield run
            run = []
        if line.trailing:
            run.append(line)
    if run:
        yield run


def _align_column(run: list[Line], column: str) -> None:
    rows = [
        line for line in run if column in line.cells and _cell_width(line, column) <= _WIDEST_CELL
    ]
    widest = max((line.cells[column] for line in rows), default=0)
    for line in rows:
        at = line.cells[column]
        padding = widest - at
        if line.indent + len(line.text) + padding <= WIDTH:
            line.text = line.text[:at] + " " * padding + line.text[at:]
            for other, start in line.cells.items():
                if start >= at:
                    line.cells[other] = start + padding


def _cell_width(line: Line, column: str) -> int:
    """Return the width of the text between the previous column and this one."""
    at = line.cells[column]
    return at - max((start for start in line.cells.values() if start < at), default=0)
