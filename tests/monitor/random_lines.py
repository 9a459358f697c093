"""Random properties of messages and random lines of robots, held against the definitions.

The truth of a fact at a moment is taken from the lines of this moment alone, and the verdict from
the whole run.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from swarmdsl.execution.monitor import (
    FALSE,
    OPEN,
    TRUE,
    Claim,
    Count,
    Fact,
    Junction,
    Plan,
    Property,
    Robots,
    Sentence,
    Verdict,
    Watch,
)

from .slow import Step, verdict

ROBOTS = tuple(f"robot[{number}]" for number in range(3))
ACTS = ("sends", "hears", "arrives", "ends")
FUNCTIONS = {"Work": "P", "Rest": "Q", "Work.Lift": "P"}
"""Functions that states call."""
ENDS = ("do.Work.succeeded", "do.Work.Lift.aborted", "do.Work.Lift.preempted", "do.Rest.aborted")
KINDS = {"never": 1, "always": 1, "eventually": 1, "leads": 2, "only": 2, "times": 1, "then": 2}
SCOPES = {None: 0, "after": 1, "before": 1, "between": 2, "until": 2}


class Robot(NamedTuple):
    """Robot of the only role."""

    name: str
    role: str = "robot"


class Actor(NamedTuple):
    """Machine of a robot."""

    name: str
    robot: Robot
    states: Sequence[str] = ()
    functions: Sequence[tuple[str, str]] = tuple(FUNCTIONS.items())


class Envelope(NamedTuple):
    """Sender of an event, empty for one from outside."""

    sender: str = ""


OUTSIDE = Envelope()


class Condition(NamedTuple):
    """Condition on a message: `event > least`, and if it reads them, the box and the sender."""

    least: int
    of_box: bool = False
    sender: str = ""


@dataclass(frozen=True)
class Line:
    """Line of a robot; messages are numbers, and so is what is in its box after it."""

    time: int
    actor: Actor
    event: str | None
    data: int = 0
    envelope: Envelope = OUTSIDE
    sent: Sequence[str] = ()
    messages: Sequence[int] = ()
    box: int = 0
    deferred: bool = False
    recalled: bool = False
    configuration: Sequence[str] = ()
    started: Sequence[str] = ()
    cancelled: Sequence[str] = ()


def is_true(condition: Condition, message: int, sender: str, line: Line) -> bool:
    """Return the truth of a condition on a message."""
    limit = line.box if condition.of_box else condition.least
    return message > limit and condition.sender in ("", sender)


def has(line: Line, fact: Fact) -> bool:
    """Return the truth of the condition of a fact, as a run tells it to monitors."""
    condition: Any = fact.condition
    if fact.act == "sends":
        sent = zip(line.sent, line.messages, strict=True)
        return any(is_true(condition, x, "", line) for name, x in sent if name == fact.name)
    return is_true(condition, line.data, line.envelope.sender, line)


# ---- by the definitions


def happens(fact: Fact, line: Line) -> bool:
    """Return True if a fact happens in a line, by its definition."""
    if fact.act == "ends":
        state, _, outcome = (line.event or "").removeprefix("do.").rpartition(".")
        called = state in FUNCTIONS and FUNCTIONS[state] == fact.name and not line.deferred
        return called and fact.outcome in ("", outcome)
    heard = [(line.event, line.data, line.envelope.sender)]
    if fact.act == "sends":
        found = [(name, x, "") for name, x in zip(line.sent, line.messages, strict=True)]
    elif fact.act == "hears":
        found = [] if line.deferred else heard
    else:
        found = [] if line.recalled or line.envelope.sender else heard
    condition: Any = fact.condition
    return any(
        name == fact.name and (condition is None or is_true(condition, x, sender, line))
        for name, x, sender in found
    )


def holds(claim: Claim, moment: Sequence[Line], me: str | None) -> bool:
    """Return the truth of a claim at a moment, for the robot that the sentence is about."""
    if isinstance(claim, Junction):
        found = [holds(each, moment, me) for each in claim.claims]
        return {"and": all(found), "or": any(found), "not": not found[0]}[claim.operator]
    assert not isinstance(claim, Count)
    who = {line.actor.name for line in moment if happens(claim, line)}
    if claim.act == "arrives" or claim.robots is None:
        return bool(who) if me is None or claim.act == "arrives" else me in who
    robots = claim.robots
    others = who - {me} if robots.other else who
    match robots.quantifier:
        case "index":
            return f"robot[{robots.number}]" in who
        case "number":
            return robots.least <= len(who) and (robots.most is None or len(who) <= robots.most)
        case "some":
            return bool(others)
        case "no":
            return not others
    return len(others) == len(ROBOTS) - robots.other


def expected(property_: Property, moments: Sequence[Sequence[Line]], end: int) -> Verdict:
    """Return the worst verdict by the definitions."""
    found = []
    for me in ROBOTS if property_.each else (None,):
        steps = [
            Step(
                moment[0].time,
                tuple(holds(each, moment, me) for each in property_.claims),
                tuple(holds(each, moment, me) for each in property_.scope),
            )
            for moment in moments
        ]
        found.append(verdict(property_.sentence, steps, end, ended=False))
    return next((each for each in (FALSE, OPEN) if each in found), TRUE)


# ---- random ones


def random_fact(dice: random.Random, *, of_each: bool) -> Fact:
    act, robots = dice.choice(ACTS), None
    if act != "arrives" and not (of_each and dice.random() < 0.6):
        quantifier = dice.choice(("some", "some", "no", "all", "index", "number"))
        low = dice.randrange(3)
        robots = Robots(
            "robot",
            quantifier,
            least=low,
            most=dice.choice((None, low)),
            number=low,
            other=of_each and quantifier in ("some", "no", "all") and dice.random() < 0.5,
        )
    condition = None
    if act == "ends":
        outcome = dice.choice(("", "succeeded", "aborted", "preempted"))
        return Fact(act, dice.choice("PQ"), robots, outcome=outcome)
    if dice.random() < 0.8:
        sender = dice.choice(("", *ROBOTS)) if act == "hears" else ""
        of_box = act != "arrives" and dice.random() < 0.3
        condition = Condition(dice.randrange(-1, 4), of_box, sender)
    return Fact(act, dice.choice("PQ"), robots, condition)


def random_claim(dice: random.Random, *, of_each: bool) -> Claim:
    if dice.random() < 0.3:
        operator = dice.choice(("and", "or", "not"))
        count = 1 if operator == "not" else 2
        return Junction(operator, tuple(random_fact(dice, of_each=of_each) for _ in range(count)))
    return random_fact(dice, of_each=of_each)


def random_property(dice: random.Random) -> Property:
    kind, scope, of_each = dice.choice(list(KINDS)), dice.choice(list(SCOPES)), dice.random() < 0.5
    within = dice.randrange(8) if kind in ("eventually", "leads") and dice.random() < 0.5 else None
    claims = tuple(random_claim(dice, of_each=of_each) for _ in range(KINDS[kind]))
    if kind == "times":
        # What happens is counted, not the moments at which nothing does.
        claims = (random_fact(dice, of_each=of_each)._replace(robots=None),)
        if not of_each:
            claims = (claims[0]._replace(robots=Robots("robot", "some")),)
    times = dice.randrange(3) if kind == "times" else None
    sentence = Sentence(kind, scope, within, times, momentary=True)
    around = tuple(random_fact(dice, of_each=of_each) for _ in range(SCOPES[scope]))
    return Property("P", sentence, claims, around, "robot" if of_each else None)


def random_line(dice: random.Random, time: int, actor: Actor, event: str | None) -> Line:
    sent = [dice.choice("PQ") for _ in range(dice.choice((0, 0, 1, 2)))]
    return Line(
        time,
        actor,
        event,
        dice.randrange(5),
        Envelope(dice.choice(("", *ROBOTS)) if event else ""),
        sent,
        [dice.randrange(5) for _ in sent],
        dice.randrange(5),
        deferred=event is not None and dice.random() < 0.1,
        recalled=event is not None and dice.random() < 0.1,
    )


def random_moments(dice: random.Random) -> list[list[Line]]:
    """Make a run: the start of all robots, and lines of one robot each."""
    actors = [Actor(name, Robot(name)) for name in ROBOTS]
    moments = [[random_line(dice, 0, actor, None) for actor in actors]]
    time = 0
    for _ in range(dice.randrange(10)):
        time += dice.choice((0, 0, 1, 2, 5))
        event = dice.choice(("P", "P", "Q", "Q", dice.choice(ENDS)))
        moments.append([random_line(dice, time, dice.choice(actors), event)])
    return moments


def check_one(dice: random.Random) -> Verdict:
    """Compare the verdict on a run of lines."""
    property_, moments = random_property(dice), random_moments(dice)
    watch = Watch(Plan([property_]), has)
    for moment in moments:
        for line in moment:
            watch.see(line)
    end = moments[-1][0].time + dice.randrange(10)
    (found,) = watch.results(end, ended=False)
    assert found.verdict == expected(property_, moments, end), (property_, moments, end)
    return found.verdict


def check_lines(count: int, seed: int = 0) -> Counter[Verdict]:
    """Compare many runs; return the number of each verdict."""
    dice = random.Random(seed)
    return Counter(check_one(dice) for _ in range(count))
