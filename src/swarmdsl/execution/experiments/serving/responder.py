"""Answers to messages: their candidates are run, one after the other."""

from __future__ import annotations

import math
from collections.abc import Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation
from swarmdsl.execution.experiments.serving.messages import (
    RunSimulation,
    read_message,
    result_text,
)
from swarmdsl.execution.experiments.serving.parameters import Names
from swarmdsl.execution.experiments.task import Candidate, Task

NOT_UNDERSTOOD = "error"
"""Answer to what is no message; the orchestrator knows this word."""
_SEEDS = 2**31
"""Seeds of runs are below this; those of messages may be any 64 bits."""


@dataclass(frozen=True)
class Trial:
    """Trial of a candidate: with so many seeds from that of the message, in each scenario."""

    digest: str
    scenarios: Sequence[str]
    aim: Aim
    seeds: int = 1


class Responder:
    """Answer messages, as a simulation manager of CPSwarm does."""

    def __init__(self, runs: Runs, names: Names, trial: Trial) -> None:
        self._runs = runs
        self._names = names
        self._trial = trial
        self.answered = 0

    def answer(self, text: str, report: Diagnostics) -> str:
        """Return the answer to a message; report what is wrong with it, or with the candidate.

        Raises StoppedError where no candidate can be run any more.
        """
        self.answered += 1
        source = Source(f"message {self.answered}", text)
        try:
            message = read_message(text)
        except ValueError as error:
            help_ = 'send `{"type": "RunSimulation", "parameters": [...]}` in one line'
            report.report("unfit-message", _all(source), reason=str(error), help=help_)
            return NOT_UNDERSTOOD
        candidate = self._names.candidate(message.parameters, source, report)
        fitness = None if report.has_errors else self._fitness(message, candidate, source, report)
        return result_text(message, fitness)

    def _fitness(
        self, message: RunSimulation, candidate: Candidate, source: Source, report: Diagnostics
    ) -> float | None:
        """Return the fitness of a candidate; more is better, also where the model minimizes."""
        trial, first = self._trial, message.seed % _SEEDS
        seeds = tuple(range(first, first + trial.seeds))
        tasks = [Task(trial.digest, each, candidate, seeds) for each in trial.scenarios]
        found = Evaluation(candidate)
        found.add(self._runs.run(tasks), trial.aim)
        if found.mean is None:
            help_ = "the answer has `success` false"
            report.report("no-fitness", _all(source), reason=found.reason, help=help_)
            return None
        value = -trial.aim.loss(found.mean)
        return value if math.isfinite(value) else None


def _all(source: Source) -> Span:
    return Span(source, 0, len(source.text))
