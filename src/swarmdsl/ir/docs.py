"""Documentation of model lines that are only values in the IR.

Examples are the first state of a machine and the effects on entry of a state.
"""

from __future__ import annotations

# By the name of the attribute or, if the node is a list of values, of the value; sorted by name.
Docs = tuple[tuple[str, str], ...]


def doc_of(docs: Docs, name: str) -> str:
    """Return the documentation of one of them, or the empty string."""
    return dict(docs).get(name, "")
