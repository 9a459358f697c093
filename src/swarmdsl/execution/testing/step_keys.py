"""Names and keys in the tables of test steps."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.testing.names import Names

# Words of other tools and languages.
_OTHER_WORDS = {
    **dict.fromkeys(("wait", "sleep", "delay", "after", "advance", "elapse"), "pass"),
    **dict.fromkeys(("event", "raise", "emit", "publish", "trigger"), "send"),
    **dict.fromkeys(("finish", "complete", "outcome", "succeed", "abort"), "end"),
    **dict.fromkeys(("kill", "lost", "crash", "fail"), "lose"),
    **dict.fromkeys(("arrive", "receive", "hears", "deliver"), "hear"),
    **dict.fromkeys(("drops", "loss", "discard"), "drop"),
    **dict.fromkeys(("expect", "state", "active", "assert", "is"), "in"),
    **dict.fromkeys(("variable", "variables", "var", "values", "where"), "has"),
    **dict.fromkeys(("every", "each"), "all"),
    **dict.fromkeys(("none", "not", "never"), "no"),
    **dict.fromkeys(("timeout", "before", "eventually"), "within"),
    **dict.fromkeys(("during", "always", "lasting"), "for"),
    **dict.fromkeys(("member", "by", "robot"), "who"),
}


def check_keys(table: Table, known: Iterable[str], owner: str, report: Diagnostics) -> None:
    """Report unknown keys, some with a hint."""
    known = list(known)
    for key in table.values:
        if key not in known:
            word = _OTHER_WORDS.get(key)
            help_ = f"write `{word}`" if word in known else suggest(key, known, "keys")
            place = table.key_place(key)
            report.report("unknown-key", place, name=key, owner=owner, help=help_)


def listed_names(table: Table, key: str, what: str) -> list[tuple[str, Span]]:
    """Read a name or a list of names, each with its place."""
    given = table.values[key]
    each = given if isinstance(given, list) else [given]
    ways: list[tuple[str | int, ...]]
    ways = [(key, i) for i in range(len(each))] if isinstance(given, list) else [(key,)]
    if not each or not all(isinstance(name, str) for name in each):
        table.wrong((key,), what, given)
        return []
    return [(name, table.value_place(way)) for name, way in zip(each, ways, strict=True)]


def named_machines(table: Table, key: str, names: Names) -> list[int]:
    """Return the machines of the robots that a key names."""
    word = table.text(key, "the name of a member, of a role or of a type of member")
    return names.members(word, table.value_place((key,))) if word is not None else []
