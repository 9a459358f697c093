"""Speculative parsing: insert a placeholder at the cursor and link the result.

Only the declaration around the cursor is parsed and linked. Several continuations after the
placeholder are tried. If none gives a valid statement, error recovery takes over, which is ten
times slower.
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

PLACEHOLDER = "completed_here_"
COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/|\Z)|"(?:[^"\\\n]|\\[^\n])*(?:"|(?=\n)|\Z)'
)
# Placeholder as a name, or as the name in `name = value`, `name => variable`, `, name = value`.
NAME = (PLACEHOLDER,)
ARGUMENT = (f"{PLACEHOLDER} = 0", f"{PLACEHOLDER} => x", f", {PLACEHOLDER} = 0")
# Possibly missing text: before the placeholder, after it inside the brackets, and after these.
_COMPLETIONS = (
    ("", "", ""),
    ("", "", " -> x"),
    ("", " = 0", ""),
    ("", " => x", ""),
    ("", " : x", ""),
    ("", "", " { }"),
    (", ", " = 0", ""),
)
# Text between the placeholder and the existing rest.
_CONTINUATIONS = ("", " = 0", " = 0,", " => x,")


def parse_with_placeholder(
    workspace: Workspace,
    file: File,
    around: tuple[str, str],
    replaced: TopLevel | None,
    words: Sequence[str] = NAME,
) -> Iterator[TopLevel]:
    """Yield the linked declarations that contain a placeholder between two strings.

    They replace the declaration `replaced` of the file.
    """
    linker = _linker(workspace, replaced)
    name = file.source.name
    for model in _models(name, *around, words):
        for owner in (*model.declarations, *model.optimizations):
            if PLACEHOLDER in owner.span.text:
                linker.link_outside(file, owner, Diagnostics())
                if isinstance(owner, StateMachine) and isinstance(replaced, StateMachine):
                    linker.replace(replaced, owner)
                linker.link_inside(file, owner, Diagnostics())
                yield owner


def _models(name: str, head: str, tail: str, words: Sequence[str]) -> Iterator[Model]:
    """Yield a model for each continuation that parses without errors.

    If there is none, yield the models that error recovery gives for each of the words.
    """
    inside, outside = _split_brackets(closing_brackets(head))
    texts = [f"{head}{PLACEHOLDER}{joint}{tail}" for joint in _CONTINUATIONS if tail]
    texts += [
        f"{head}{before}{PLACEHOLDER}{within}\n{inside}{behind}\n{outside}"
        for before, within, behind in _COMPLETIONS
    ]
    valid = False
    for text in texts:
        parsed = parse_strict(Source(name, text), Diagnostics())
        if parsed is not None:
            valid = True
            yield parsed.model
    if valid:
        return
    ends = [f"\n{inside}{outside}", *([tail] if tail else [])]
    for word in words:
        for end in ends:
            yield parse_segment(Source(name, head + word + end), Diagnostics()).model


def _split_brackets(brackets: str) -> tuple[str, str]:
    """Split closing brackets at the first `}`."""
    inside, brace, outside = brackets.partition("}")
    return inside, brace + outside


def closing_brackets(head: str) -> str:
    """Return the brackets that close all open ones at the end of a text."""
    opened = []
    for bracket in re.findall(r"[][(){}]", COMMENT_OR_STRING.sub("", head)):
        if bracket in "([{":
            opened.append({"(": ")", "[": "]", "{": "}"}[bracket])
        elif opened and opened[-1] == bracket:
            opened.pop()
    return "\n".join(reversed(opened))


def declaration_at(file: File, offset: int) -> TopLevel | None:
    """Return the declaration at an offset, or the one that ends there."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= offset <= span.end:
            return owner
    return None


def _linker(workspace: Workspace, replaced: TopLevel | None) -> Linker:
    """Return a linker for a declaration that replaces another one."""
    linker = Linker(workspace.project, Scopes(workspace.project))
    if isinstance(replaced, StateMachine):
        linker.gather(workspace.runners(replaced))
    return linker
