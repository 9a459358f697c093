"""Documentation of what is a line of its own in a model, and here only a value of a node.

The first state of a machine is one, and the effects on entry of a state.
"""

from __future__ import annotations

# By the name of the attribute or, where the node is a list of values, of the value; in the
# order of the names.
Docs = tuple[tuple[str, str], ...]


def doc_of(docs: Docs, name: str) -> str:
    """What is said of one of them; empty where nothing is."""
    return dict(docs).get(name, "")
