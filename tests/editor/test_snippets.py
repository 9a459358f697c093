"""What a snippet inserts is the language, where it is meant to stand."""

from __future__ import annotations

import json
import re
from itertools import product
from pathlib import Path
from typing import Any

import pytest

PATH = Path(__file__).resolve().parents[2] / "editors/vscode/snippets/swarm.json"
SNIPPETS: dict[str, dict[str, Any]] = json.loads(PATH.read_text(encoding="utf-8"))

MACHINE = "statemachine M {{ {} }}"
STATE = "statemachine M {{ state S {{ {} }} }}"
OPTIMIZATION = "optimize W {{ {} }}"
# Where a snippet stands, of those that do not stand at the top of a file.
PLACES = {
    "Topic of a function": "function f : swarm {{ {} }}",
    "Port": "sensor S {{ {} }}",
    "Operation": "sensor S {{ {} }}",
    "Behaviour": "sensor S {{ {} }}",
    "Parameter": "sensor S {{ {} }}",
    "Communication": "member R {{ {} }}",
    "Connector": "member R {{ {} }}",
    "Variable": MACHINE,
    "State": MACHINE,
    "State with an activity": MACHINE,
    "Composite state": MACHINE,
    "Submachine state": MACHINE,
    "Submachine state with params": MACHINE,
    "Parallel state": MACHINE,
    "Choice": MACHINE,
    "Final state": MACHINE,
    "History": STATE,
    "Deep history": STATE,
    "Entry": STATE,
    "Exit": STATE,
    "Transition": STATE,
    "Transition with guard and effect": STATE,
    "Transition that sends": STATE,
    "Transition without a target": STATE,
    "Transition without an event": STATE,
    "Internal transition": STATE,
    "Monitor": STATE,
    "Timeout": STATE,
    "Activity": STATE,
    "Activity of a component": STATE,
    "Activity with callbacks": STATE,
    "Fitness of a swarm": "swarm W {{ {} }}",
    "Range of a count": OPTIMIZATION,
    "Range of a param": OPTIMIZATION,
}
STOP = re.compile(r"\$(?:(\d+)|\{(\d+)(?::([^}]*)|\|([^}]*)\|)\})")


def insertions(name: str) -> list[str]:
    """Return what a snippet inserts, with each of its choices."""
    body = "\n".join(SNIPPETS[name]["body"])
    choices = {n: options.split(",") for _, n, _, options in STOP.findall(body) if options}
    return [
        STOP.sub(lambda stop, taken=taken: taken.get(stop[2]) or stop[3] or "", body)
        for taken in (
            dict(zip(choices, options, strict=True)) for options in product(*choices.values())
        )
    ]


def test_places_are_of_snippets() -> None:
    assert set(PLACES) - set(SNIPPETS) == set()


def test_choices_are_all_inserted() -> None:
    assert insertions("Timeout") == [
        f"after 30 {unit} -> Target\n" for unit in ("s", "ms", "us", "min", "h")
    ]


@pytest.mark.parametrize("name", SNIPPETS)
def test_snippet_is_the_language(name: str, language: Any) -> None:
    for text in insertions(name):
        assert "$" not in text
        language.parse(PLACES.get(name, "{}").format(text))


@pytest.mark.parametrize("name", SNIPPETS)
def test_stops_are_numbered_from_one_and_the_cursor_ends_at_the_end(name: str) -> None:
    body = "\n".join(SNIPPETS[name]["body"])
    stops = [int(plain or braced) for plain, braced, _, _ in STOP.findall(body)]
    assert body.endswith("$0")
    assert sorted(set(stops)) == list(range(max(stops) + 1))


def test_prefixes_are_unique() -> None:
    prefixes = []
    for snippet in SNIPPETS.values():
        prefix = snippet["prefix"]
        prefixes += [prefix] if isinstance(prefix, str) else prefix
    assert len(prefixes) == len(set(prefixes))


def test_every_construct_has_a_snippet(language: Any) -> None:
    inserted = {
        terminal.value
        for name in SNIPPETS
        for text in insertions(name)
        for terminal in language.parse(PLACES.get(name, "{}").format(text))
        if language.is_keyword(terminal.rule)
    }
    in_expressions = {"and", "false", "not", "or", "true"}
    assert language.keywords - inserted == in_expressions | {"preempted"}
