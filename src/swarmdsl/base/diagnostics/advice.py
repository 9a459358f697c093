"""Help whose change a program can make as well as a person."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import listed


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


def meant(name: str) -> Advice:
    """Ask for a similar name: "did you mean `name`?"."""
    return Advice(f"did you mean `{name}`?", "rename", name)


def write(*texts: str, before: str = "", after: str = "") -> Advice:
    """Name all that can stand at the place: "write `a` or `b`"."""
    return Advice(f"{before}write {listed([*texts])}{after}", "write", *texts)


def add_import(*statements: str) -> Advice:
    """Name the imports that declare what is missing: "add `import "file.swarm"`"."""
    return Advice(f"add {listed([*statements])}", "import", *statements)
