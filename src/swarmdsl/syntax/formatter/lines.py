"""Lines of the output, before alignment."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.records import dataclass, field

WIDTH = 100
INDENT = 2


@dataclass(slots=True)
class Line:
    """Line without its indentation and trailing comment.

    A `text` with a block comment may have several lines. `cells` are offsets of columns in the
    text, by name; they are aligned with those of neighbours of the same `group`, if it has one.
    """

    indent: int
    text: str
    trailing: str = ""
    blank_above: bool = False
    is_comment: bool = False
    group: str | None = None
    cells: dict[str, int] = field(default_factory=dict)

    @property
    def width(self) -> int:
        """Width of the last line of the text."""
        return len(self.text) - (self.text.rfind("\n") + 1)


def render_lines(lines: Iterable[Line]) -> str:
    """Render lines as the text of a file."""
    written = []
    for line in lines:
        if line.blank_above:
            written.append("\n")
        text = f"{' ' * line.indent}{line.text}{line.trailing}".rstrip()
        written.append(f"{text}\n")
    return "".join(written)
