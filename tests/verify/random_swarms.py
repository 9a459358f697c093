"""Random small swarms, as text."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

_PRELUDE = """package test
action Try { result { ok : bool } }
message Word { word : uint8 }
function attempt : abstraction { action "attempt" : Try }
event Go : std_msgs/Empty
event Tick : std_msgs/Empty
swarm event Ask : Word
swarm event Tell : Word
"""
_FACTS = (
    *("in S0", "in S1", "in S2", "sends Ask", "hears Tell", "starts attempt", "hears Go"),
    *("has [n > 0]", "has [ok]", "cancels attempt"),
    *("ends attempt", "ends attempt as succeeded", "ends attempt as aborted"),
)
_SCOPES = (
    "",
    "",
    "",
    "after {p}, ",
    "before {p}, ",
    "between {s} and {t}, ",
    "after {p} until {q}, ",
)
_PATTERNS = (
    *("never {a}", "{a} at all times", "{a} only after {b}", "{a} at most 1 times"),
    # What happens at one step is over at the next.
    *("({a} or in S1) at all times", "never (in S0 and not {b})"),
    *("{a} at most 0 times", "eventually {a}", "{a} leads to {b}", "{a} then {b}"),
)


def ranges(swarms: int, size: int) -> list[range]:
    """Return the seeds of random swarms in ranges of a size; the last one has what is left, too."""
    starts = range(0, max(swarms - size, 0) + 1, size) if swarms else ()
    return [range(n, n + size if n + 2 * size <= swarms else swarms) for n in starts]


def random_swarm(seed: int, *, heartbeat: bool = False) -> str:
    """Return a model of two or three robots, with properties; some ask who is there."""
    chance = Random(seed)
    text = _PRELUDE + _machine(chance, "One")
    members = Random(seed) if heartbeat else None
    roles = "a : A[2]"
    text += "member A { behavior One }\n"
    if chance.random() < 0.3:
        text += _machine(chance, "Two") + "member B { behavior Two }\n"
        roles = "a : A[1]\n b : B[1]\n"
    if members is not None:
        text = asking(text, members, _effects, _target)
        roles += "\n heartbeat 1 s lost after 5 s\n"
    text += f"swarm S {{ {roles} }}\n"
    messages = Random(seed)
    for number in range(6):
        text += f"property P{number} of S : {_about_messages(_sentence(chance), messages)}\n"
    return text


def asking(
    text: str, chance: Random, effects: Callable[[Random], str], target: Callable[[Random], str]
) -> str:
    """Let some states react to the loss of robots, and some guards count those that are there."""
    lines = []
    for line in text.splitlines():
        lines.append(line)
        if line.startswith("  state S") and chance.random() < 0.6:
            guard = chance.choice(("", ' [event.role == "a"]', " [present(a) < 2]"))
            lines.append(f"    on member_lost{guard}{effects(chance)} -> {target(chance)}")
        elif line.startswith("    on Go") and "[" not in line and chance.random() < 0.4:
            lines[-1] = line.replace("on Go", "on Go [present() > 1]")
    return "\n".join(lines) + "\n"


def _about_messages(sentence: str, chance: Random) -> str:
    """Add conditions on messages to some facts."""
    for event in ("sends Ask", "hears Tell"):
        if chance.random() < 0.4:
            limit = chance.choice(("> 0", "== 0", "> n"))
            sentence = sentence.replace(event, f"{event} [event.word {limit}]")
    return sentence


def _machine(chance: Random, name: str) -> str:
    body = f"statemachine {name} {{\n  var n : uint8 = 0\n  var ok : bool\n  initial S0\n"
    for number in range(3):
        lines = []
        if chance.random() < 0.5:
            lines.append("do attempt gives (ok => ok)")
            if guard := _guard(chance):
                lines.append(f"on succeeded{guard}{_effects(chance)} -> {_target(chance)}")
            lines.append(f"on succeeded{_effects(chance)} -> {_target(chance)}")
            lines.append(f"on aborted, preempted{_effects(chance)} -> {_target(chance)}")
        if chance.random() < 0.15:
            lines.append(f"defer {chance.choice(('Ask', 'Tell'))}")
        for _ in range(chance.randint(1, 3)):
            event = chance.choice(("Ask", "Tell", "Go", "Ask", "Tell"))
            guard = chance.choice(("", "", " [event.word > 0]")) if event != "Go" else ""
            guard = guard or _guard(chance)
            lines.append(f"on {event}{guard}{_effects(chance)} -> {_target(chance)}")
        if chance.random() < 0.3:
            # No property is about it: it may change no fact.
            lines.append(f"on Tick -> {_target(chance)}")
        if chance.random() < 0.2:
            lines.append(f"after 2 s{_effects(chance)} -> {_target(chance)}")
        if chance.random() < 0.2:
            lines.append(f"entry / {_send(chance)}")
        inner = "\n    ".join(lines)
        body += f"  state S{number} {{\n    {inner}\n  }}\n"
    return body + "  final End\n}\n"


def _guard(chance: Random) -> str:
    return chance.choice(("", "", "", " [n < 2]", " [n == 0]", " [ok]", " [not ok]"))


def _effects(chance: Random) -> str:
    found = []
    if chance.random() < 0.25:
        found.append(chance.choice(("n = min(n + 1, 2)", "n = 0", "ok = false")))
    if chance.random() < 0.35:
        found.append(_send(chance))
    return f" / {', '.join(found)}" if found else ""


def _send(chance: Random) -> str:
    event = chance.choice(("Ask", "Tell"))
    return f"send {event}(word = {chance.choice(('n', '0', '1'))})"


def _target(chance: Random) -> str:
    return chance.choice(("S0", "S1", "S2", "S1", "S2", "End"))


def _sentence(chance: Random) -> str:
    each = chance.random() < 0.5
    head = "each a : " if each else ""
    words = {letter: _fact(chance, each=each) for letter in "abpqst"}
    for letter in "abpq":
        if chance.random() < 0.2:
            word = chance.choice(("and", "or"))
            words[letter] = f"({words[letter]} {word} {_fact(chance, each=each)})"
    pattern = chance.choice(_PATTERNS)
    if not each:
        pattern = pattern.replace("in S", "some a in S")
    return head + chance.choice(_SCOPES).format(**words) + pattern.format(**words)


def _fact(chance: Random, *, each: bool) -> str:
    if chance.random() < 0.12:
        return "Go"
    fact = chance.choice(_FACTS)
    if each and chance.random() < 0.6:
        return fact
    if chance.random() < 0.15:
        return f"count(a in {chance.choice(('S0', 'S1', 'S2'))}) {chance.choice(('==', '>'))} 1"
    who = chance.choice(("some a", "all a", "no a", "a[0]", "1 a", "2..* a"))
    if each and chance.random() < 0.5:
        who = chance.choice(("some other a", "no other a", "all other a"))
    return f"{who} {fact}"
