"""Random small swarms with delays, and properties about time, as text."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

_PRELUDE = """package test
function attempt : abstraction { service "attempt" : std_srvs/Empty }
event Go : std_msgs/Empty
swarm event Ask : std_msgs/Empty
"""
_PATTERNS = (
    *("{a} leads to {b} within {n} s", "eventually {b} within {n} s"),
    *("after {a}, eventually {b} within {n} s", "after {a}, {b} leads to {c} within {n} s"),
    *("between {s} and {t}, eventually {b} within {n} s", "never {a}"),
    *("after {a} until {c}, eventually {b} within {n} s", "{a} only after {b}"),
    *("before {a}, eventually {b} within {n} s", "after {a}, never {b}"),
)
_FACTS = ("in S0", "in S1", "in S2", "hears Ask", "sends Ask", "starts attempt", "hears Go")
STATES = ("in S0", "in S1", "in S2", "in End")


def random_timed_swarm(seed: int, facts: Sequence[str] = _FACTS) -> str:
    """Return a model of one or two robots, with properties."""
    chance = Random(seed)
    text = _PRELUDE + _machine(chance)
    text += f"member A {{ behavior M }}\nswarm S {{ a : A[{chance.choice((1, 2, 2))}] }}\n"
    for number in range(6):
        text += f"property P{number} of S : {_sentence(chance, facts)}\n"
    return text


def _machine(chance: Random) -> str:
    body = "statemachine M {\n  initial S0\n"
    for number in range(3):
        lines = []
        if chance.random() < 0.4:
            lines += ["do attempt", f"on succeeded{_effect(chance)} -> {_target(chance)}"]
            lines.append(f"on aborted -> {_target(chance)}")
        if chance.random() < 0.6:
            lines.append(f"after {chance.randint(1, 3)} s{_effect(chance)} -> {_target(chance)}")
        if chance.random() < 0.4 or not lines:
            lines.append(f"on Ask -> {_target(chance)}")
        if chance.random() < 0.25:
            lines.append(f"on Go{_effect(chance)} -> {_target(chance)}")
        inner = "\n    ".join(lines)
        body += f"  state S{number} {{\n    {inner}\n  }}\n"
    return body + "  final End\n}\n"


def _effect(chance: Random) -> str:
    return " / send Ask" if chance.random() < 0.4 else ""


def _target(chance: Random) -> str:
    return chance.choice(("S0", "S1", "S2", "S1", "S2", "End"))


def _sentence(chance: Random, facts: Sequence[str]) -> str:
    each = chance.random() < 0.5
    words = {letter: _fact(chance, facts, each=each) for letter in "abcst"}
    text = chance.choice(_PATTERNS).format(n=chance.randint(1, 4), **words)
    return f"each a : {text}" if each else text


def _fact(chance: Random, facts: Sequence[str], *, each: bool) -> str:
    fact = chance.choice(facts)
    return fact if each else f"{chance.choice(('some', 'all', 'some'))} a {fact}"
