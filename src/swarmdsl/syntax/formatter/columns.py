"""Aligns what neighbouring lines of a kind have in common, and the comments behind lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.syntax.ast import (
    AliasType,
    Branch,
    Communication,
    Connector,
    Constant,
    CountRange,
    EnumValue,
    Event,
    Field,
    FitnessInput,
    Function,
    FunctionPort,
    Node,
    Param,
    ParamRange,
    Part,
    PartValue,
    Port,
    Role,
    Transition,
    Variable,
    Word,
)
from swarmdsl.syntax.formatter.lines import WIDTH, Line
from swarmdsl.syntax.formatter.tokens import Token

# What is longer than this does not push the column of its neighbours away.
_WIDEST_CELL = 40

# Where columns begin, by the kind of the item: at the name or at a symbol.
_NAME = "name"
_COLUMNS: dict[type[Node], tuple[str, ...]] = {
    AliasType: ("=",),
    Branch: ("->",),
    Communication: (_NAME, ":"),
    Connector: ("->",),
    Constant: (":", "="),
    CountRange: ("in",),
    EnumValue: ("=",),
    Event: (_NAME, ":"),
    Field: (":",),
    FitnessInput: (":",),
    Function: (":", "{"),
    FunctionPort: (_NAME, ":"),
    Param: (":", "="),
    ParamRange: ("in",),
    Part: (":",),
    PartValue: ("=",),
    Port: (_NAME, ":"),
    Role: (":",),
    Transition: ("->",),
    Variable: (":", "="),
}
_SECTION: tuple[str, ...] = ("{",)
_SAME_GROUP: dict[type[Node], type[Node]] = {ParamRange: CountRange}


def set_cells(line: Line, node: Node | None, tokens: Sequence[Token], starts: list[int]) -> None:
    """Note which columns a line has that is all of an item."""
    if node is None:
        line.group, columns = "section", _SECTION
    else:
        kind = type(node)
        line.group, columns = _SAME_GROUP.get(kind, kind).__name__, _COLUMNS.get(kind, ())
    if isinstance(node, (Transition, Branch)) and (
        node.effects or (isinstance(node, Transition) and node.guard is not None)
    ):
        return  # too much stands before the arrow
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
    """Pad the texts of lines that belong together, then place the comments behind them."""
    for run in _runs(lines):
        for column in dict.fromkeys(column for line in run for column in line.cells):
            _align_column(run, column)
    for run in _commented_runs(lines):
        widest = max(line.width for line in run)
        for line in run:
            line.behind = " " * (widest - line.width) + line.behind


def _runs(lines: Iterable[Line]) -> Iterator[list[Line]]:
    """Lines of a group that follow each other; comments between them do not matter."""
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
    """Lines with comments behind them that follow each other."""
    run: list[Line] = []
    for line in lines:
        if run and (line.blank_above or not line.behind or line.indent != run[0].indent):
            yield run
            run = []
        if line.behind:
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
    """The width of what stands before a column, from the column before it on."""
    at = line.cells[column]
    return at - max((start for start in line.cells.values() if start < at), default=0)
