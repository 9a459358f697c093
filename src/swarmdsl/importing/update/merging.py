"""What an update does with the items of a declaration that is in the model already.

Declarations, and what is in them, are found by their names. What the import says is changed where
it stands; what it has and the model has not is added; all else stays, and so do comments.
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

Guess = tuple[str, str]
"""What an import has made up, and does not know: the name of a declaration, and what of it."""

D = TypeVar("D", bound=Documented)


@dataclass(eq=False)
class Merge:
    """Merges declarations of one file with those of an import.

    `plain` is a type as the format of the import can say it. `force` takes over what was written
    by hand too. A trial only asks whether there is something to change, beside documentation.
    """

    edits: Edits
    plain: Callable[[Type], Type]
    guesses: Collection[Guess]
    report: Diagnostics
    force: bool
    is_trial: bool = False

    @cached_property
    def tokens(self) -> Tokens:
        """The tokens of the file as it is."""
        return Tokens(self.edits.source.text)

    @cached_property
    def folding(self) -> Folding:
        """The values of expressions."""
        return Folding()

    def documentation(self, old: Documented, new: Documented) -> None:
        """Say what is said of something, unless somebody has said something of it already."""
        if new.doc and not old.doc and not self.is_trial:
            self.edits.above(old.span.start, commented(new.doc))

    def type(self, old: TypeRef, new: TypeRef) -> None:
        """Change a type."""
        if old.type is None or new.type is None:
            self.word(old.span, new.span)
        elif self.plain(old.type) != self.plain(new.type):
            self.edits.replace(old.span, new.span.text)

    def word(self, old: Span, new: Span) -> None:
        """Change a word."""
        if old.text != new.text:
            self.edits.replace(old, new.text)

    def word_at(self, at: int, text: str) -> None:
        """Change the word that comes next after an offset."""
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
        """Change the items that are there, and add each other one below that before it.

        `first` adds one where there is none yet.
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
                add(written(item))

    def below(self, item: Documented) -> Callable[[str], None]:
        """How to add something below an item."""
        return lambda text: self.edits.below(item.span.end, text)

    def inside(self, at: int) -> Callable[[str], None]:
        """How to add something first in the block that begins next after an offset."""

        def add(text: str) -> None:
            brace = next(token for token in self.tokens.code(at, 64) if token.text == "{")
            self.edits.below(brace.start + 1, text)

        return add

    def last(self, items: Sequence[Documented], at: int) -> Callable[[str], None]:
        """How to add something below the last item of the block that comes next after an offset."""
        return self.below(items[-1]) if items else self.inside(at)

    def kept(self, place: Span, what: str, reason: str, way: str | None = None) -> None:
        """Report what stays, though the import has it otherwise."""
        self.report.report("kept", place, what=what, reason=reason, help=way)

    def default(self, old: Param | Constant, new: Param | Constant) -> None:
        """Change the type and value of a param or constant."""
        change = default_change(old, new, self.folding)
        if change is None:
            return
        if change.computed and not self.force:
            what = f"the value of `{old.name}`"
            reason = f"it is computed here, and `{change.value}` in what is imported"
            way = "change what it is computed from, or use `--force`"
            self.kept(change.place, what, reason, way)
            return
        if change.type is not None:
            self.edits.replace(*change.type)
        if change.value is not None:
            text = change.value if change.place.text else f" = {change.value}"
            self.edits.replace(change.place, text)


def of_class(items: Iterable[object], class_: type[D]) -> list[D]:
    """The items of a class."""
    return [item for item in items if isinstance(item, class_)]


def written(node: Documented) -> str:
    """A node as it is written, with its documentation."""
    return f"{commented(node.doc)}\n{node.span.text}" if node.doc else node.span.text


def commented(doc: str) -> str:
    """The lines of a documentation."""
    return "\n".join(f"/// {line}".rstrip() for line in doc.split("\n"))
