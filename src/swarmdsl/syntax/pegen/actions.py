"""Semantic actions of a grammar."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass, field


@dataclass(frozen=True)
class Target:
    """Semantic actions: the result of each rule.

    `nodes` are the classes of nodes, with an expression for each field but the span: the value of
    an attribute is its name with a `_`. A rule in `words` becomes a `Word`, by an expression for
    its string. The functions in `written` parse rules of that name by hand. `items` are rules with
    what separates them on one line: where there is no line break before one, that is stored in
    `inline` by the index of its first token. `begin` is the start of `parse`, `finish` its end,
    `result` what it returns next to the model.
    """

    nodes: Mapping[str, Mapping[str, str]]
    words: Mapping[str, str]
    written: Mapping[str, str]
    items: Mapping[str, str] = field(default_factory=dict)
    begin: str = ""
    finish: str = ""
    result: str = "0"
