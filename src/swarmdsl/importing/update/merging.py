"""Merge the items of an existing declaration with those of an import.

Items are matched by name. Changed items are edited in place and new ones are added; everything
else, including comments, stays.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import cached_property
from typing import TypeVar

from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.base.text_edits import Edits
from swarmdsl.importing.update.values import default_change
from swarmdsl.ir import Type
from swarmdsl.syntax.ast import Constant, Documented, Param, TypeRef
from swarmdsl.syntax.formatter.tokens import Tokens
from swarmdsl.syntax.parser.doc_comments import doc_comment as lines_of_doc

Guess = tuple[str, str]
"""An assumed property: name of a declaration and of the property."""

D = TypeVar("D", bound=Documented)


@dataclass(eq=False)
class Merge:
    """Merges declarations of one file with those of an import.

    `plain` converts a type to what the import format can express. `force` also replaces manual
    edits. A trial only tests for changes, ignoring documentation.
    """

    edits: Edits
    plain: Callable[[Type], Type]
    guesses: Collection[Guess]
    report: Diagnostics
    force: bool
    is_trial: bool = False

    @cached_property
    def tokens(self) -> Tokens:
        """Tokens of the unchanged file."""
        return Tokens(self.edits.source.text)

    @cached_property
    def folding(self) -> Folding:
        """Values of constant expressions."""
        return Folding()

    def documentation(self, old: Documented, new: Documented) -> None:
        """Add documentation unless there is some."""
        if new.doc and not old.doc and not self.is_trial:
            self.edits.above(old.span.start, doc_comment(new.doc))

    def type(self, old: TypeRef, new: TypeRef) -> None:
        """Update a type."""
        if old.type is None or new.type is None:
            self.word(old.span, new.span)
        elif self.plain(old.type) != self.plain(new.type):
            self.edits.replace(old.span, new.span.text)

    def word(self, old: Span, new: Span) -> None:
        """Update the text of a span."""
        if old.text != new.text:
            self.edits.replace(old, new.text)

    def word_at(self, at: int, text: str) -> None:
        """Replace the next token after an offset."""
        (old,) = self.tokens.code(at)
        self.edits.replace(Span(self.edits.source, old.start, old.start + len(old.text)), text)

    def items(
        self,
        old: Sequence[D],
        new: Sequence[D],
        key: Callable[[D], object],
        change: Callable[[D, D], None],
        first: Callable[[str], None],
    ) -> None:
        """Update existing items and add each new one below its predecessor.

        `first` adds an item if there are none yet.
        """
        known = {key(item): item for item in reversed(old)}
        done: set[object] = set()
        add: Callable[[str], None] | None = None
        for item in new:
            found = known.get(key(item))
            if key(item) in done:
                continue
            done.add(key(item))
            if found is not None:
                self.documentation(found, item)
                change(found, item)
                add = self.below(found)
            else:
                if add is None:
                    add = self.below(old[-1]) if old else first
                add(node_text(item))

    def below(self, item: Documented) -> Callable[[str], None]:
        """Return a function that adds text below an item."""
        return lambda text: self.edits.below(item.span.end, text)

    def inside(self, at: int) -> Callable[[str], None]:
        """Return a function that adds text at the start of the next block after an offset."""

        def add(text: str) -> None:
            brace = next(token for token in self.tokens.code(at, 64) if token.text == "{")
            self.edits.below(brace.start + 1, text)

        return add

    def last(self, items: Sequence[Documented], at: int) -> Callable[[str], None]:
        """Return a function that adds text below the last item of the next block."""
        return self.below(items[-1]) if items else self.inside(at)

    def kept(self, place: Span, what: str, reason: str, hint: str | None = None) -> None:
        """Report a difference to the import that is not updated."""
        self.report.report("kept", place, what=what, reason=reason, help=hint)

    def default(self, old: Param | Constant, new: Param | Constant) -> None:
        """Update the type and value of a param or constant."""
        change = default_change(old, new, self.folding)
        if change is None:
            return
        if change.computed and not self.force:
            what = f"the value of `{old.name}`"
            reason = f"it is computed here, but `{change.value}` in the import"
            hint = "change the expression, or use `--force`"
            self.kept(change.place, what, reason, hint)
            return
        if change.type is not None:
            self.edits.replace(*change.type)
        if change.value is not None:
            text = change.value if change.place.text else f" = {change.value}"
            self.edits.replace(change.place, text)


def of_class(items: Iterable[object], class_: type[D]) -> list[D]:
    """Items of a class."""
    return [item for item in items if isinstance(item, class_)]


def node_text(node: Documented) -> str:
    """Text of a node with its doc comment."""
    return f"{doc_comment(node.doc)}\n{node.span.text}" if node.doc else node.span.text


def doc_comment(doc: str) -> str:
    """Doc comment with the given text."""
    return "\n".join(lines_of_doc(doc))
