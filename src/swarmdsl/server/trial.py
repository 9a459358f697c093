"""A word put on trial where somebody types: what the compiler makes of it says what fits there.

The declaration around the place is parsed and linked with the word in it. The compiler mends
what is not finished, as it does everywhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.link import Linker
from swarmdsl.load import File
from swarmdsl.parse import parse_piece
from swarmdsl.scopes import Scopes
from swarmdsl.source import Source
from swarmdsl.syntax import StateMachine, TopLevel
from swarmdsl.workspace import Workspace
from swarmdsl.workspace.occurrences import owners

WORD = "completed_here_"
COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/|\Z)|"(?:[^"\\\n]|\\[^\n])*(?:"|(?=\n)|\Z)'
)
# What the word is to be: a name, or one before a value, a variable or the next argument.
NAME = (WORD,)
ARGUMENT = (f"{WORD} = 0", f"{WORD} => x", f", {WORD} = 0")


def tried(
    workspace: Workspace,
    file: File,
    around: tuple[str, str],
    instead: TopLevel | None,
    words: Sequence[str] = NAME,
) -> Iterator[TopLevel]:
    """The declarations there would be with one of the words between two texts, linked.

    `instead` is the declaration of the file whose place they take.
    """
    head, tail = around
    linker = _linker(workspace, instead)
    for word in words:
        for rest in ("\n" + closers(head), tail):
            source = Source(file.source.name, head + word + rest)
            model = parse_piece(source, Diagnostics()).model
            for owner in (*model.declarations, *model.optimizations):
                if WORD in owner.span.text:
                    linker.link_outside(file, owner, Diagnostics())
                    if isinstance(owner, StateMachine) and isinstance(instead, StateMachine):
                        linker.replace(instead, owner)
                    linker.link_inside(file, owner, Diagnostics())
                    yield owner


def closers(head: str) -> str:
    """The brackets that end what is open behind a text."""
    opened = []
    for bracket in re.findall(r"[][(){}]", COMMENT_OR_TEXT.sub("", head)):
        if bracket in "([{":
            opened.append({"(": ")", "[": "]", "{": "}"}[bracket])
        elif opened and opened[-1] == bracket:
            opened.pop()
    return "\n".join(reversed(opened))


def owner_around(file: File, offset: int) -> TopLevel | None:
    """The declaration at an offset, or the one that ends there."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= offset <= span.end:
            return owner
    return None


def _linker(workspace: Workspace, instead: TopLevel | None) -> Linker:
    """What links a declaration in the place of another one."""
    linker = Linker(workspace.project, Scopes(workspace.project))
    if isinstance(instead, StateMachine):
        linker.gather(workspace.runners(instead))
    return linker
