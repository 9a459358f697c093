"""Random properties and runs, and their comparison with the slow evaluator."""

from __future__ import annotations

import random
import sys
from collections import Counter

from swarmdsl.execution.monitor import FALSE, Automaton, Monitor, Sentence, Verdict

from .random_lines import check_lines
from .slow import Step, verdict

KINDS = {
    "never": 1,
    "always": 1,
    "eventually": 1,
    "leads": 2,
    "only": 2,
    "times": 1,
    "then": 3,
    "again": 1,
    "possible": 1,
}
SCOPES = {None: 0, "after": 1, "before": 1, "between": 2, "until": 2}


def random_sentence(dice: random.Random) -> Sentence:
    """Make a property of any kind and scope."""
    kind = dice.choice(list(KINDS))
    timed = kind in ("eventually", "leads") and dice.random() < 0.7
    return Sentence(
        kind,
        dice.choice(list(SCOPES)),
        dice.randrange(8) if timed else None,
        dice.randrange(4) if kind == "times" else None,
        momentary=dice.random() < 0.5,
    )


def random_run(sentence: Sentence, dice: random.Random) -> list[Step]:
    """Make a run; several steps can be at one time."""
    often, time, run = dice.choice((0.1, 0.3, 0.5, 0.9)), 0, []
    wanted = dice.choice((2, 3)) if sentence.kind == "then" else KINDS[sentence.kind]
    for _ in range(dice.randrange(10)):
        claims = tuple(dice.random() < often for _ in range(wanted))
        scope = tuple(dice.random() < 0.3 for _ in range(SCOPES[sentence.scope]))
        run.append(Step(time, claims, scope))
        time += dice.choice((0, 0, 1, 2, 5))
    return run


def check_one(dice: random.Random) -> Verdict:
    """Compare the verdicts on a run and on each of its beginnings."""
    sentence = random_sentence(dice)
    run = random_run(sentence, dice)
    monitor = Monitor(sentence)
    for number, step in enumerate(run):
        monitor.step(step.time, step.claims, step.scope)
        so_far = verdict(sentence, run[: number + 1], step.time, ended=False)
        assert (monitor.violated is not None) == (so_far == FALSE), (sentence, run[: number + 1])
    ended = dice.random() < 0.3
    end = (run[-1].time if run else 0) + dice.randrange(10)
    found = monitor.finish(end, ended=ended)
    assert by_automaton(sentence, run, end, ended=ended) == (found, monitor.violated)
    assert found == verdict(sentence, run, end, ended=ended), (sentence, run, end, ended, found)
    return found


def by_automaton(
    sentence: Sentence, run: list[Step], end: int, *, ended: bool
) -> tuple[Verdict, int | None]:
    """Return the verdict of the automaton, and the time of the violation."""
    claims = len(run[0].claims) if run else KINDS[sentence.kind]
    automaton = Automaton(sentence, claims, SCOPES[sentence.scope])
    state, due = automaton.first, 0
    violated: int | None = None
    for step in [*run, None]:
        time = end if step is None else step.time
        if state.is_timed and time > due:
            state = automaton.late(state)
            violated = due if state.is_violated and violated is None else violated
        if step is not None:
            target, begins = automaton.step(state, (*step.claims, *step.scope))
            assert target is state or not automaton.is_final(state)
            due = time + automaton.within if begins else due
            violated = time if target.is_violated and violated is None else violated
            state = target
    found, last = automaton.end(state, ended=ended)
    return found, end if last.is_violated and violated is None else violated


def check_many(count: int, seed: int = 0) -> Counter[Verdict]:
    """Compare many runs; return the number of each verdict."""
    dice = random.Random(seed)
    return Counter(check_one(dice) for _ in range(count))


if __name__ == "__main__":
    many = int(sys.argv[1])
    # Half of the runs are lines of robots, and the claims are about messages.
    verdicts = check_many(many - many // 2, seed=1) + check_lines(many // 2, seed=1)
    counts = ", ".join(f"{number} {name}" for name, number in sorted(verdicts.items()))
    sys.stdout.write(f"{many} pairs of a property and a run: all verdicts agree ({counts})\n")
