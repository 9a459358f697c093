"""Semantic actions of a grammar."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Target:
    """Semantic actions: the result of each rule.

    `nodes` are the classes of nodes, with an expression for each field but the span: the value of
    an attribute is its name with a `_`. A rule in `words` becomes a `Word`, by an expression for
    its string. The functions in `written` parse rules of that name by hand. `begin` is the start of
    `parse`, `result` what it returns next to the model.
    """

    nodes: Mapping[str, Mapping[str, str]]
    words: Mapping[str, str]
    written: Mapping[str, str]
    begin: str = ""
    result: str = "0"
