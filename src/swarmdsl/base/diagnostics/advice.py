"""Help whose change a program can make as well as a person."""

from __future__ import annotations

import re
from collections.abc import Sequence

from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.base.source import Span


class Advice(str):
    """Help that names its change: `act` is a rule of `driver/fixes`, with its arguments.

    It is a string wherever a person reads it. Spans among the arguments are used as absolute ones.
    """

    __slots__ = ("act", "arguments")
    act: str
    arguments: tuple[object, ...]

    def __new__(cls, text: str, act: str, *arguments: object) -> Advice:
        """Make the help from its text and its change."""
        made = super().__new__(cls, text)
        made.act, made.arguments = act, arguments
        return made

    # A string needs one argument.
    def __getnewargs__(self) -> tuple[object, ...]:  # type: ignore[override]
        """Copy and pickle with the change."""
        return str(self), self.act, *self.arguments

    def prefixed(self, text: str) -> Advice:
        """Return the same change with more text before it."""
        return Advice(f"{text}{self}", self.act, *self.arguments)

    def expanded(self, match: re.Match[str]) -> Advice:
        r"""Return the help of a template with the groups of a match, as `\1`."""
        texts = (match.expand(each) for each in self.arguments if isinstance(each, str))
        return Advice(match.expand(self), self.act, *texts)


def meant(name: str) -> Advice:
    """Ask for a similar name: "did you mean `name`?"."""
    return Advice(f"did you mean `{name}`?", "rename", name)


def write(*texts: str, before: str = "", after: str = "") -> Advice:
    """Name all that can stand at the place: "write `a` or `b`"."""
    return Advice(f"{before}write {listed([*texts])}{after}", "write", *texts)


def add_import(*statements: str) -> Advice:
    """Name the imports that declare what is missing: "add `import "file.swarm"`"."""
    return Advice(f"add {listed([*statements])}", "import", *statements)


def only(text: str, names: Sequence[str]) -> str:
    """Return help that lists names; with a single one, it is the name to use."""
    return Advice(text, "rename", names[0]) if len(names) == 1 else text


def sizes(*texts: str) -> Advice:
    """Name sizes in brackets: "write `[3]` or `[*]`"."""
    return Advice(f"write {listed([*texts])}", "size", *texts)


def write_before(text: str, found: str) -> Advice:
    """Name a text that is missing before another one: "write `:` before `x`"."""
    return Advice(f"write `{text}` before `{found}`", "prefix", text)


def last_robot(role: str, most: int) -> Advice:
    """Name the last robot of a role: "the last one is `uav[2]`"."""
    return Advice(f"the last one is `{role}[{most - 1}]`", "last robot", f"{role}[{most - 1}]")


def insert(line: str, *names: Span, to: str) -> Advice:
    """Name a line to add to the declarations or states with these names."""
    return Advice(f"add `{line}` to {to}", "insert", line, *names)


def edits(text: str, title: str, *changes: tuple[Span, str]) -> Advice:
    """Name changes of the text, each of a span; `title` says in short what they do."""
    return Advice(text, "edit", title, *(part for change in changes for part in change))


def before(span: Span, text: str) -> tuple[Span, str]:
    """Return the insertion of a text before a span."""
    return span._replace(end=span.start), text


def behind(span: Span, text: str) -> tuple[Span, str]:
    """Return the insertion of a text behind a span."""
    return span._replace(start=span.end), text
