"""Monitors agree with rtamt, which evaluates formulas of signal temporal logic.

A run has a sample for each tick of a clock, and steps at some of them, the first one at the first
tick. When it is over, nothing more can happen.
"""

from __future__ import annotations

import random
import warnings
from collections import Counter
from collections.abc import Sequence

import pytest

from swarmdsl.execution.monitor import TRUE, Monitor, Sentence

from ..monitor.slow import Step

try:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # its parser imports `typing.io`
        import rtamt
except ImportError:
    rtamt = None

pytestmark = pytest.mark.skipif(rtamt is None, reason="no rtamt: `make agreement`")

PAIRS = 400
TICKS = 20
CLAIMS = {"eventually": 1, "leads": 2, "never": 1, "always": 1, "only": 2}
SCOPES = {None: 0, "after": 1, "before": 1, "between": 2, "until": 2}
# Facts `p` and `q`, scopes from `a` to `b`, and `step` at a step, `first` at the first tick.
FACTS = ("step", "first", *"pqab")
PART = "((not b) since (a and not b))"
INSIDE = {None: "(step or not step)", "after": "once(a)", "before": "(not once(b))"}
INSIDE |= {"between": PART, "until": PART}
START = f"(a and not b and not (prev({PART}) and not first))"
BEGINS = {
    None: "first",
    "after": "(a and not (prev(once(a)) and not first))",
    "before": "first",
}
BEGINS |= {"between": START, "until": START}


def formula(sentence: Sentence) -> str:
    """Return a property in signal temporal logic."""
    scope = sentence.scope
    bound = "" if sentence.within is None else f"[0:{sentence.within}]"

    def comes(fact: str) -> str:
        """Return that a fact holds in time, before the part of the run is over."""
        if scope in ("before", "between", "until"):
            return f"((not b) until{bound} ({fact} and not b))"
        return f"eventually{bound}({fact})"

    inside = INSIDE[scope]
    condition, conclusion = {
        "never": (f"({inside} and p)", "(p and not p)"),
        "always": (f"({inside} and step)", "p"),
        "eventually": (BEGINS[scope], comes("p")),
        "leads": (f"({inside} and p)", comes("q")),
        "only": (f"({inside} and p)", f"({inside} since ({inside} and q))"),
    }[sentence.kind]
    if scope in ("before", "between"):
        condition = f"({condition} and eventually(b))"
    return f"always({condition} implies {conclusion})"


def is_true(text: str, run: Sequence[Step], scope: str | None) -> bool:
    """Return True if rtamt finds that a run is as a formula says."""
    signals = {name: [-1.0] * TICKS for name in FACTS}
    ends = "b" if scope == "before" else "ab"
    for step in run:
        held = {"step": True, "first": step.time == 0, **dict(zip("pq", step.claims, strict=False))}
        for name, holds in {**held, **dict(zip(ends, step.scope, strict=False))}.items():
            signals[name][step.time] = 1.0 if holds else -1.0
    specification = rtamt.StlDiscreteTimeOfflineSpecification()
    for name in signals:
        specification.declare_var(name, "float")
    specification.spec = text
    specification.parse()
    found = specification.evaluate({"time": [*range(TICKS)], **signals})
    return bool(found[0][1] > 0)


def random_sentence(dice: random.Random) -> Sentence:
    kind, scope = dice.choice(list(CLAIMS)), dice.choice(list(SCOPES))
    timed = kind in ("eventually", "leads") and dice.random() < 0.8
    return Sentence(kind, scope, dice.randrange(1, 8) if timed else None)


def random_run(sentence: Sentence, dice: random.Random) -> list[Step]:
    often, rarely = dice.choice((0.2, 0.5, 0.8)), dice.choice((0.1, 0.3))
    ticks = [0, *(tick for tick in range(1, TICKS) if dice.random() < 0.5)]
    return [
        Step(
            tick,
            tuple(dice.random() < often for _ in range(CLAIMS[sentence.kind])),
            tuple(dice.random() < rarely for _ in range(SCOPES[sentence.scope])),
        )
        for tick in ticks
    ]


def test_verdicts_are_those_of_rtamt() -> None:
    dice = random.Random(7)
    counts: Counter[tuple[str, bool]] = Counter()
    for _ in range(PAIRS):
        sentence = random_sentence(dice)
        run = random_run(sentence, dice)
        monitor = Monitor(sentence)
        for step in run:
            monitor.step(step.time, step.claims, step.scope)
        found = monitor.finish(TICKS - 1, ended=True) == TRUE
        text = formula(sentence)
        assert is_true(text, run, sentence.scope) == found, (sentence, text, run)
        counts[sentence.kind, found] += 1
    assert min(counts[kind, verdict] for kind in CLAIMS for verdict in (True, False)) > 5
