"""Random small swarms with sentences on what must happen, as text."""

from __future__ import annotations

from random import Random

from .random_swarms import asking

_PRELUDE = """package test
message Word { word : uint8 }
action Try { result { ok : bool } }
function attempt : abstraction { action "attempt" : Try }
event Go : std_msgs/Empty
swarm event Ask : Word
swarm event Tell : Word
"""
_FACTS = ("in S0", "in S1", "in End", "sends Ask", "hears Tell", "starts attempt", "in S0", "in S1")
_PATTERNS = (
    *("eventually {a}", "{a} leads to {b}", "again and again {a}", "{a} then {b}"),
    *("{a} leads to {b}", "again and again {a}", "again and again ({a} or {b})"),
)
_SCOPES = ("", "", "", "after {p}, ", "after {p} until {q}, ")


def random_duties(seed: int, *, heartbeat: bool = False) -> str:
    """Return a model of two robots, or three with two states, with two sentences."""
    chance = Random(seed)
    number = chance.choice((2, 2, 2, 3))
    text = _PRELUDE + _machine(chance, "One", 2)
    beats = ""
    if heartbeat:
        text = asking(text, Random(seed), _effects, _target)
        beats = "\n heartbeat 1 s lost after 5 s\n"
    text += f"member A {{ behavior One }}\nswarm S {{ a : A[{number}]{beats} }}\n"
    for count in range(2):
        text += f"property P{count} of S : {_sentence(chance)}\n"
    return text


def _machine(chance: Random, name: str, states: int) -> str:
    body = f"statemachine {name} {{\n  var n : uint8 = 0\n  initial S0\n"
    for number in range(states):
        lines = []
        what = chance.random()
        if what < 0.4:
            lines.append("do attempt")
            lines.append(f"on succeeded{_effects(chance)} -> {_target(chance)}")
            lines.append(f"on aborted, preempted{_effects(chance)} -> {_target(chance)}")
        elif what < 0.6:
            lines.append(f"after {chance.randint(1, 3)} s{_effects(chance)} -> {_target(chance)}")
        for _ in range(chance.randint(1, 2)):
            event = chance.choice(("Ask", "Tell", "Go", "Ask"))
            guard = "" if event == "Go" else chance.choice(("", "", " [event.word > 0]"))
            guard = guard or chance.choice(("", "", " [n == 0]", " [n > 0]"))
            lines.append(f"on {event}{guard}{_effects(chance)} -> {_target(chance)}")
        if chance.random() < 0.2:
            lines.append(f"entry / {_send(chance)}")
        inner = "\n    ".join(lines)
        body += f"  state S{number} {{\n    {inner}\n  }}\n"
    return body + "  final End\n}\n"


def _effects(chance: Random) -> str:
    found = []
    if chance.random() < 0.2:
        found.append(chance.choice(("n = 1", "n = 0")))
    if chance.random() < 0.35:
        found.append(_send(chance))
    return f" / {', '.join(found)}" if found else ""


def _send(chance: Random) -> str:
    return f"send {chance.choice(('Ask', 'Tell'))}(word = {chance.choice(('n', '0', '1'))})"


def _target(chance: Random) -> str:
    return chance.choice(("S0", "S1", "S0", "S1", "End"))


def _sentence(chance: Random) -> str:
    each = chance.random() < 0.6
    words = {letter: _fact(chance, each=each) for letter in "abpq"}
    pattern = chance.choice(_SCOPES) + chance.choice(_PATTERNS)
    return ("each a : " if each else "") + pattern.format(**words)


def _fact(chance: Random, *, each: bool) -> str:
    if chance.random() < 0.1:
        return "Go"
    fact = chance.choice(_FACTS)
    if each and chance.random() < 0.7:
        return fact
    if chance.random() < 0.15:
        return f"count(a in {chance.choice(('S0', 'S1', 'End'))}) {chance.choice(('==', '>'))} 1"
    who = chance.choice(("some a", "all a", "no a", "a[0]", "1 a"))
    if each and chance.random() < 0.5:
        who = chance.choice(("some other a", "no other a", "all other a"))
    return f"{who} {fact}"
