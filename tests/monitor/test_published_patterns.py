"""Sentences for published patterns are true of the runs that their formulas are true of.

The formulas are those of the papers, in linear temporal logic over runs that end. They and the
sentences are held against each other on all short runs. Facts happen: a stay is a step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import pytest

from swarmdsl.execution.monitor import TRUE, Monitor, Sentence

Moment = frozenset[str]
Run = Sequence[Moment]
Formula = Callable[[Run, int], bool]
"""Truth of a formula at a step of a run."""
LENGTH = 4


def fact(name: str) -> Formula:
    return lambda run, at: name in run[at]


P, Q, R = fact("p"), fact("q"), fact("r")


def anything(_run: Run, _at: int) -> bool:
    return True


def no(one: Formula) -> Formula:
    return lambda run, at: not one(run, at)


def both(*all_: Formula) -> Formula:
    return lambda run, at: all(each(run, at) for each in all_)


def either(*any_: Formula) -> Formula:
    return lambda run, at: any(each(run, at) for each in any_)


def implies(one: Formula, other: Formula) -> Formula:
    return either(no(one), other)


def until(one: Formula, other: Formula) -> Formula:
    return lambda run, at: any(
        other(run, end) and all(one(run, step) for step in range(at, end))
        for end in range(at, len(run))
    )


def eventually(one: Formula) -> Formula:
    return until(anything, one)


def always(one: Formula) -> Formula:
    return no(eventually(no(one)))


def weakly_until(one: Formula, other: Formula) -> Formula:
    return either(until(one, other), always(one))


def then(one: Formula) -> Formula:
    """There is a next step, at which it holds."""
    return lambda run, at: at + 1 < len(run) and one(run, at + 1)


def is_true(
    sentence: str, claims: Sequence[Formula], scope: Sequence[Formula], run: Run, times: int = 1
) -> bool:
    kind, _, part = sentence.partition(" ")
    monitor = Monitor(Sentence(kind, part or None, None, times, momentary=True))
    for at in range(len(run)):
        monitor.step(at, [each(run, at) for each in claims], [each(run, at) for each in scope])
    return monitor.finish(len(run), ended=True) == TRUE


# Of each pattern, the formula, and sentences: a pattern and a scope, with their facts.
Said = tuple[str, Sequence[Formula], Sequence[Formula]]
DWYER: dict[str, tuple[Formula, list[Said]]] = {
    "absence": (always(no(P)), [("never", [P], [])]),
    "universality": (always(P), [("always", [P], [])]),
    "existence": (eventually(P), [("eventually", [P], [])]),
    "precedence": (weakly_until(no(P), Q), [("only", [P, Q], [])]),
    "response": (always(implies(P, eventually(Q))), [("leads", [P, Q], [])]),
    "absence before": (implies(eventually(R), until(no(P), R)), [("never before", [P], [R])]),
    "existence before": (
        weakly_until(no(R), both(P, no(R))),
        [("eventually before", [P], [R])],
    ),
    "existence after": (
        either(always(no(Q)), eventually(both(Q, eventually(P)))),
        [("eventually after", [P], [Q])],
    ),
    "absence between": (
        always(implies(both(Q, no(R), eventually(R)), until(no(P), R))),
        [("never between", [P], [Q, R])],
    ),
    "absence after until": (
        always(implies(both(Q, no(R)), weakly_until(no(P), R))),
        [("never until", [P], [Q, R])],
    ),
    # With both causes at one moment: a moment of ours can have several events.
    "precedence chain": (
        implies(eventually(P), until(no(P), both(R, until(no(P), Q)))),
        [("only", [P, R], []), ("only after", [P, Q], [R])],
    ),
}
MISSIONS: dict[str, tuple[Formula, list[Said]]] = {
    "visit": (
        both(eventually(P), eventually(Q)),
        [("eventually", [P], []), ("eventually", [Q], [])],
    ),
    "sequenced visit": (eventually(both(P, eventually(Q))), [("then", [P, Q], [])]),
    "ordered visit": (
        both(eventually(both(P, eventually(Q))), until(no(Q), P)),
        [("then", [P, Q], []), ("only", [Q, P], [])],
    ),
    "strict ordered visit": (
        both(
            eventually(both(P, eventually(Q))),
            until(no(Q), P),
            until(no(P), both(P, then(until(no(P), Q)))),
        ),
        [("then", [P, Q], []), ("only", [Q, P], []), ("times before", [P], [Q])],
    ),
    "fair visit": (
        both(
            *(eventually(each) for each in (P, Q, R)),
            *(
                always(implies(one, either(no(then(anything)), then(weakly_until(no(one), other)))))
                for one, other in ((P, Q), (Q, R), (R, P))
            ),
        ),
        [
            *(("eventually", [each], []) for each in (P, Q, R)),
            *(("times until", [one], [one, other]) for one, other in ((P, Q), (Q, R), (R, P))),
        ],
    ),
    "past avoidance": (until(no(P), Q), [("only", [P, Q], []), ("eventually", [Q], [])]),
    "future avoidance": (always(implies(Q, always(no(P)))), [("never after", [P], [Q])]),
    "upper restricted avoidance": (
        no(eventually(both(P, then(eventually(P))))),
        [("times", [P], [])],
    ),
    "instantaneous reaction": (always(implies(P, Q)), [("never", [both(P, no(Q))], [])]),
    "delayed reaction": (always(implies(P, eventually(Q))), [("leads", [P, Q], [])]),
    "bound reaction": (
        always(both(implies(P, Q), implies(Q, P))),
        [("never", [both(P, no(Q))], []), ("never", [both(Q, no(P))], [])],
    ),
    "wait": (until(P, Q), [("always before", [P], [Q]), ("eventually", [Q], [])]),
}
NAMED = {**DWYER, **MISSIONS}


def runs(apart: bool) -> list[Run]:
    """Return all runs; a robot is in one place at a time."""
    moments = [
        frozenset(name for name, there in zip("pqr", one, strict=True) if there)
        for one in product((False, True), repeat=3)
    ]
    moments = [each for each in moments if not apart or len(each) <= 1]
    return [run for length in range(1, LENGTH + 1) for run in product(moments, repeat=length)]


@pytest.mark.parametrize("pattern", NAMED)
def test_a_sentence_is_its_formula(pattern: str) -> None:
    formula, sentences = NAMED[pattern]
    verdicts = set()
    for run in runs(apart="visit" in pattern):
        expected = formula(run, 0)
        found = all(is_true(*sentence, run) for sentence in sentences)
        assert found == expected, run
        verdicts.add(found)
    assert verdicts == {True, False}
