"""What the rules of a grammar become."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Target:
    """What the rules become.

    `nodes` are the classes of nodes, with an expression for each field but the place: what an
    attribute of the rule was found to be has its name and a `_`. A rule in `words` becomes a
    `Word`, by an expression for its text. The functions in `written` are not generated: they
    parse rules of that name. `begin` is what `parse` does first, `result` what it returns with
    the model.
    """

    nodes: Mapping[str, Mapping[str, str]]
    words: Mapping[str, str]
    written: Mapping[str, str]
    begin: str = ""
    result: str = "0"
