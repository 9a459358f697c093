"""`swarmc serve`: a line with a candidate in, a line with its fitness out."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.engines import engine_of
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.measured import check_properties, measured_fitness
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.evaluation import Aim, Together
from swarmdsl.execution.experiments.serving.parameters import Names
from swarmdsl.execution.experiments.serving.responder import Responder, Trial
from swarmdsl.execution.experiments.shipment import Conditions, pack
from swarmdsl.execution.experiments.store import FILE, Store
from swarmdsl.execution.experiments.task import NO_SCENARIO

Tell = Callable[[Diagnostics], None]


class Answers(Protocol):
    """Takes answers, one for each line: standard output, or a connection."""

    def write(self, text: str, /) -> object:
        """Take an answer."""

    def flush(self) -> None:
        """Send it."""


@dataclass(frozen=True)
class Request:
    """Arguments of the command; `seeds` is the number of runs of a candidate in a scenario."""

    paths: tuple[Path, ...]
    swarm: str | None = None
    scenarios: tuple[Path, ...] = ()
    together: Together = "mean"
    properties: tuple[str, ...] = ()
    seeds: int = 1
    until: int | None = None
    world: str | None = None
    limit: float | None = None
    jobs: int = 1
    cluster: str | None = None


def serve(request: Request, lines: Iterable[str], out: Answers, tell: Tell) -> bool:
    """Answer each line with a line, until there are no more; return True without errors.

    A message that is not understood, and a candidate without a fitness, is no error of the
    service: it is reported, and answered.
    """
    report = Diagnostics()
    try:
        with _responder(request, report, tell) as responder:
            if responder is None:
                return False
            for line in lines:
                if not line.strip():
                    continue
                found = Diagnostics()
                answer = responder.answer(line.rstrip("\n"), found)
                tell(found)
                out.write(f"{answer}\n")
                out.flush()
    except BrokenPipeError:
        # Nobody reads the answers any more: it ends as without further messages.
        pass
    except StoppedError as stopped:
        stopped.report(report)
        tell(report)
        return False
    return True


@contextmanager
def _responder(request: Request, report: Diagnostics, tell: Tell) -> Iterator[Responder | None]:
    """Load the model, start the engine, and yield what answers; None if something is wrong."""
    conditions = Conditions(request.until, request.world, request.properties)
    packed = pack(request.paths, request.swarm, request.scenarios, report, conditions)
    if packed is None:
        tell(report)
        yield None
        return
    shipment, subject = packed
    system, swarm, fitness = subject.system, subject.swarm, measured_fitness(subject, report)
    assert system is not None
    assert swarm is not None
    check_properties(request.properties, subject, report)
    tell(report)
    if report.has_errors or fitness is None:
        yield None
        return
    trial = Trial(
        shipment.digest,
        tuple(map(str, request.scenarios)) or (NO_SCENARIO,),
        Aim(fitness.goal, request.together, request.properties),
        request.seeds,
    )
    engine = engine_of(request.cluster, request.jobs, is_apart=shipment.may_crash)
    with (
        tempfile.TemporaryDirectory(prefix="swarmdsl-") as folder,
        Store(Path(folder) / FILE) as store,
        engine,
    ):
        runs = Runs({shipment.digest: shipment}, engine, store, limit=request.limit)
        yield Responder(runs, Names(system, swarm), trial)
