"""Result of parsing a file."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import Expression, Model, TopLevel

# Deeper than hand-written models, and safe for the recursion of the parser.
NESTING_LIMIT = 64


@dataclass
class Parsed:
    """Syntax tree of a file or segment, and what could not be parsed of it.

    `incomplete` are declarations with a part missing; checks of missing parts would mislead.
    `skipped_names` are the words in statements that could not be parsed: an unresolved name may be
    declared there. `repaired` are expressions that differ from the source, `anonymous_kinds` the
    kinds of elements whose name could not be parsed.
    """

    model: Model
    incomplete: frozenset[TopLevel] = frozenset()
    skipped_names: frozenset[str] = frozenset()
    repaired: frozenset[Expression] = frozenset()
    anonymous_kinds: frozenset[str] = frozenset()
