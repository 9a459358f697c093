"""Keys of test files, and of the steps of tests."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from swarmdsl.driver.config.keys import (
    ANY,
    TEXT,
    Key,
    Shape,
    list_of,
    one_of,
    one_or_several,
    table,
    table_of,
    whole,
)
from swarmdsl.execution.simulate.inputs.scenario_keys import DURATION, SHARE
from swarmdsl.execution.simulate.inputs.scenario_keys import TABLES as SCENARIO
from swarmdsl.execution.simulate.machines.table import OUTCOMES
from swarmdsl.execution.testing.measures import COMPARISON

# Upper limit that is reasonable for a test.
MOST_SEEDS = 10_000
COUNT = re.compile(r"([0-9]{1,9})(?:\.\.([0-9]{1,9}|\*))?")
IMPOSSIBLE = ("fail", "skip")
_MEMBERS = "robot, a role, a type of member, or a part with its own behaviour"

_DATA = Key(ANY, "Fields of the message; in a claim, only those that matter.")
_OF = Key(TEXT, f"Machines that are meant: a {_MEMBERS}.")
_BY = Key(TEXT, "Robot to which the event is on its way, or each of a role or type.")
_FROM = Key(TEXT, "Robot that sent it; by default the first one that did.")
_TO = Key(
    one_or_several(TEXT),
    f"Receivers: a {_MEMBERS}, or a list; in a claim, the address with which it is sent.",
)
ACTIONS: Mapping[str, Mapping[str, Key]] = {
    "send": {
        "send": Key(TEXT, "An event arrives from outside."),
        "to": _TO,
        "data": _DATA,
        "sender": Key(TEXT, "Robot in whose name it arrives, which does not hear it."),
    },
    "end": {
        "end": Key(TEXT, "A running call of this function ends."),
        "of": _OF,
        "as": Key(one_of(OUTCOMES), "Outcome of the call; by default `succeeded`."),
        "result": Key(ANY, "Fields of its result."),
    },
    "pass": {"pass": Key(DURATION, "Time passes.")},
    "lose": {"lose": Key(TEXT, "A robot is lost, or each of a role or type.")},
    "hear": {
        "hear": Key(TEXT, "A swarm event that is on its way arrives."),
        "by": _BY,
        "from": _FROM,
    },
    "drop": {
        "drop": Key(TEXT, "A swarm event that is on its way is lost."),
        "by": _BY,
        "from": _FROM,
    },
}
"""Actions by their verbs, each with the keys of its step."""
VERBS: Mapping[str, Key] = {
    "in": Key(one_or_several(TEXT), "State, or states, that must be active."),
    "has": Key(
        {"type": "object", "minProperties": 1}, "Values that variables and params must have."
    ),
    "sends": Key(TEXT, "Event that must be sent."),
    "starts": Key(TEXT, "Function that must be called."),
    "cancels": Key(TEXT, "Function whose call must be left before it has ended."),
    "satisfies": Key(TEXT, "Property that must be true, with nothing left to happen."),
}
"""Verbs of claims about machines; a claim has one of them."""
CLAIM: Mapping[str, Key] = {
    "who": Key(TEXT, f"All of these: a {_MEMBERS}."),
    "all": Key(TEXT, "Each member of a role or type."),
    "any": Key(TEXT, "At least one member of a role or type."),
    "no": Key(TEXT, "No member of a role or type."),
    "count": Key(
        {"anyOf": [whole(0), {"type": "string", "pattern": f"^{COUNT.pattern}$"}]},
        'Number of members, or a range like `"1..3"` or `"2..*"`; with `of`.',
    ),
    "of": _OF,
    **VERBS,
    "data": _DATA,
    "to": _TO,
}
TIMES: Mapping[str, Key] = {
    "within": Key(DURATION, "Time passes until it is so, at most this long."),
    "for": Key(DURATION, "It is so now, and as long as this."),
}


def _step(more: Mapping[str, Key], verbs: Iterable[str]) -> Shape:
    """Shape of a step: one action with its own keys, or one of more verbs with more keys."""
    words = {word: key for keys in ACTIONS.values() for word, key in keys.items()}
    only: dict[str, Shape] = {
        verb: {"propertyNames": one_of(keys)} for verb, keys in ACTIONS.items()
    }
    only.update({"meanwhile": {"required": ["within"]}} if "meanwhile" in more else {})
    kinds = [{"required": [each]} for each in (*ACTIONS, *verbs)]
    return table({**words, **more}, oneOf=kinds, dependencies=only)


WAIT: Mapping[str, Key] = {
    "meanwhile": Key(
        {**list_of(_step({}, ())), "minItems": 1},
        "Actions that happen again and again until it is so, with `within`.",
    ),
}


_NUMBER_OR_TIME = {
    "anyOf": [
        {"type": "number"},
        {"type": "string", "pattern": rf"^\s*({COMPARISON})?\s*[-+]?[0-9].*$"},
    ]
}
_SHARED: Mapping[str, Key] = {
    "swarm": Key(TEXT, "Swarm to run; by default the only one."),
    "machine": Key(TEXT, "State machine to run alone."),
    "scenario": Key(
        {"anyOf": [TEXT, table(SCENARIO)]},
        "Environment of the robots: a file, or a table with the same content.",
    ),
    "seeds": Key(whole(1, MOST_SEEDS), "Number of random seeds with which each test runs."),
    "passing": Key(SHARE, "Share of the runs that must pass; by default all."),
    "properties": Key(one_or_several(TEXT), 'Properties that no run may violate, or `"all"`.'),
    "impossible": Key(
        one_of(IMPOSSIBLE),
        "Treatment of an `end`, `hear` or `drop` that is impossible in a run: `skip` leaves "
        "it out.",
    ),
}
TEST: Mapping[str, Key] = {
    "name": Key({"type": "string", "pattern": r"\S"}, "Name of the test: the fact that it shows."),
    **_SHARED,
    "steps": Key(
        {**list_of(_step({**CLAIM, **TIMES, **WAIT}, VERBS)), "minItems": 1},
        "Actions and expectations, in their order.",
    ),
    "always": Key(
        list_of(table(CLAIM, oneOf=[{"required": [each]} for each in VERBS])),
        "Claims that must hold all the time.",
    ),
    "violates": Key(one_or_several(TEXT), "Properties that each run must violate."),
    "measures": Key(
        table_of(_NUMBER_OR_TIME),
        'Measures of the fitness, or itself, at the end: `"< 10 min"`.',
    ),
}
FILE: Mapping[str, Key] = {
    "model": Key(
        one_or_several(TEXT),
        "Files and folders of the model; by default the sources of the project, or this folder.",
    ),
    **_SHARED,
    "test": Key(
        {**list_of(table(TEST, required=("name", "steps"))), "minItems": 1}, "Tests of the model."
    ),
}
