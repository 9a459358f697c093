"""Lines of the result, before they are aligned, and their text in the end."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.records import dataclass, field

WIDTH = 100
INDENT = 2


@dataclass(slots=True)
class Line:
    """A line without its indentation and the comments behind it.

    Where `text` is a block comment or has one in it, it may be several lines. `group` says
    with which neighbours its `cells` are aligned: offsets in the text by the name of the
    column that begins there. Lines without group are aligned with none.
    """

    indent: int
    text: str
    behind: str = ""
    blank_above: bool = False
    is_comment: bool = False
    group: str | None = None
    cells: dict[str, int] = field(default_factory=dict)

    @property
    def width(self) -> int:
        """The width of the text, of the last line of it where it has several."""
        return len(self.text) - (self.text.rfind("\n") + 1)


def as_text(lines: Iterable[Line]) -> str:
    """The text of a file with these lines."""
    written = []
    for line in lines:
        if line.blank_above:
            written.append("\n")
        text = f"{' ' * line.indent}{line.text}{line.behind}".rstrip()
        written.append(f"{text}\n")
    return "".join(written)
