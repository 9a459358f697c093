"""A word put on trial where somebody types: what the compiler makes of it says what fits there.

The declaration around the place is parsed and linked with the word in it. What makes a statement
of the word is put behind it; where nothing does, the compiler mends what is not finished, as it
does everywhere, which takes ten times as long.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from swarmdsl.analysis.resolve.linker import Linker
from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Model, StateMachine, TopLevel
from swarmdsl.syntax.parse import parse_segment, parse_strict

WORD = "completed_here_"
COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/|\Z)|"(?:[^"\\\n]|\\[^\n])*(?:"|(?=\n)|\Z)'
)
# What the word is to be: a name, or one before a value, a variable or the next argument.
NAME = (WORD,)
ARGUMENT = (f"{WORD} = 0", f"{WORD} => x", f", {WORD} = 0")
# What can be missing before it, behind it in the brackets around it, and behind these.
_ENDS = (
    ("", "", ""),
    ("", "", " -> x"),
    ("", " = 0", ""),
    ("", " => x", ""),
    ("", " : x", ""),
    ("", "", " { }"),
    (", ", " = 0", ""),
)
# The same where what follows is taken as it is.
_JOINTS = ("", " = 0", " = 0,", " => x,")


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
    linker = _linker(workspace, instead)
    name = file.source.name
    for model in _models(name, *around, words):
        for owner in (*model.declarations, *model.optimizations):
            if WORD in owner.span.text:
                linker.link_outside(file, owner, Diagnostics())
                if isinstance(owner, StateMachine) and isinstance(instead, StateMachine):
                    linker.replace(instead, owner)
                linker.link_inside(file, owner, Diagnostics())
                yield owner


def _models(name: str, head: str, tail: str, words: Sequence[str]) -> Iterator[Model]:
    """What is there with the word, for each way to go on behind it that makes no mistake.

    Where there is none, what is there with one of the words after all has been mended.
    """
    inside, outside = _divided(closers(head))
    texts = [f"{head}{WORD}{joint}{tail}" for joint in _JOINTS if tail]
    texts += [
        f"{head}{before}{WORD}{within}\n{inside}{behind}\n{outside}"
        for before, within, behind in _ENDS
    ]
    flawless = False
    for text in texts:
        parsed = parse_strict(Source(name, text), Diagnostics())
        if parsed is not None:
            flawless = True
            yield parsed.model
    if flawless:
        return
    ends = [f"\n{inside}{outside}", *([tail] if tail else [])]
    for word in words:
        for end in ends:
            yield parse_segment(Source(name, head + word + end), Diagnostics()).model


def _divided(brackets: str) -> tuple[str, str]:
    """Closing brackets in two: those of an expression or a list, and those from a block on."""
    inside, brace, outside = brackets.partition("}")
    return inside, brace + outside


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
