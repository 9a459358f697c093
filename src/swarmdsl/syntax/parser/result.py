"""What comes of parsing a file."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import Expression, Model, TopLevel

# Deeper than any model a person writes, and what the parser takes without overflow.
NESTING_LIMIT = 64


@dataclass
class Parsed:
    """The syntax tree of a file, or a piece of one, and what could not be read of it.

    `damaged` holds declarations with a piece missing: checks of what they lack would
    mislead. `lost_names` are the words in statements that could not be parsed; whatever is
    not found under one of these names may well be declared there. `repaired` are the
    expressions that were read otherwise than they are written, `unnamed` the kinds of what has
    no name that could be read.
    """

    model: Model
    damaged: frozenset[TopLevel] = frozenset()
    lost_names: frozenset[str] = frozenset()
    repaired: frozenset[Expression] = frozenset()
    unnamed: frozenset[str] = frozenset()
