"""Problem of a search: a model with what may change, what is good, and the plan of the search."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Source
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.exchange.search_space import number
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.experiments.measured import (
    FITNESS,
    PROPERTY,
    check_properties,
    measured_fitness,
    measures,
)
from swarmdsl.execution.experiments.search.evaluation import Aim, Goal, Objective, Together
from swarmdsl.execution.experiments.search.methods import Name
from swarmdsl.execution.experiments.search.optimizing import Plan
from swarmdsl.execution.experiments.search.space import SearchSpace, report_narrowed, space_of
from swarmdsl.execution.experiments.settings import apply_candidate
from swarmdsl.execution.experiments.shipment import Conditions, Shipment, pack
from swarmdsl.execution.experiments.task import NO_SCENARIO
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.ir import Fitness, Optimization, System


@dataclass(frozen=True)
class Request:
    """Arguments of the command. Without `output`, nothing is kept."""

    paths: tuple[Path, ...]
    swarm: str | None = None
    scenarios: tuple[Path, ...] = ()
    method: Name = "auto"
    evaluations: int | None = None
    seeds: int = 30
    fresh: int = 100
    seed: int | None = None
    together: Together = "mean"
    properties: tuple[str, ...] = ()
    until: int | None = None
    world: str | None = None
    jobs: int = 1
    cluster: str | None = None
    output: Path | None = None
    resume: bool = False
    apply: bool = False
    feed: Path | None = None
    is_json: bool = False
    limit: float | None = None
    maximize: tuple[str, ...] = ()
    minimize: tuple[str, ...] = ()
    point: int | None = None


@dataclass(frozen=True)
class Problem:
    """The model with its optimization, and the plan of the search."""

    subject: Subject
    system: System
    optimization: Optimization
    fitness: Fitness
    shipment: Shipment
    plan: Plan
    paths: tuple[Path, ...] = ()

    @property
    def objective_name(self) -> str:
        """Name of the first objective."""
        measure = self.plan.aim.measure
        return self.fitness.name if measure == FITNESS else measure


def _check_scenarios(
    shipment: Shipment, subject: Subject, space: SearchSpace, report: Diagnostics
) -> None:
    """Report what is wrong in scenarios with the candidate that has the most members."""
    candidate = space.candidate([1.0] * len(space.dimensions))
    for name, text in shipment.scenarios.items():
        document = parse_toml(Source(name, text, Path(name)), report)
        if document is not None:
            apply_candidate(candidate, document, subject, report)


def _objectives(
    request: Request, subject: Subject, fitness: Fitness, report: Diagnostics
) -> Iterator[Objective]:
    """Yield the objectives: those that are asked for, else that of the fitness."""
    if not request.maximize and not request.minimize:
        yield Objective(FITNESS, fitness.goal)
        return
    known = measures(subject)
    owner = f"`{subject.name}`"
    given: tuple[tuple[Goal, tuple[str, ...]], ...] = (
        ("maximize", request.maximize),
        ("minimize", request.minimize),
    )
    for goal, names in given:
        for name in names:
            if name in known:
                yield Objective(name, goal, known[name] == PROPERTY)
                continue
            help_ = suggest(name, known, "measures")
            if name == fitness.name:
                help_ = f"it is called `{FITNESS}` here"
            report.report("no-such-measure", name=name, owner=owner, help=help_)


def problem_of(request: Request, report: Diagnostics) -> Problem | None:
    """Load the model, and find out what is to be optimized."""
    conditions = Conditions(request.until, request.world, ())
    packed = pack(request.paths, request.swarm, request.scenarios, report, conditions)
    if packed is None:
        return None
    shipment, subject = packed
    system = subject.system
    assert system is not None
    optimization = next((o for o in system.optimizations if o.swarm == subject.name), None)
    if optimization is None:
        roles = subject.swarm.roles if subject.swarm is not None else ()
        role = roles[0].name if roles else "role"
        help_ = f"declare its ranges: `optimize {subject.name} {{ count of {role} in 1 .. 5 }}`"
        report.report("nothing-to-optimize", name=subject.name, reason="no `optimize`", help=help_)
        return None
    fitness = measured_fitness(subject, report)
    if fitness is None:
        return None
    space = space_of(optimization, system)
    if not space.dimensions:
        help_ = "add `role.param in 1.0 .. 5.0` or `count of role in 1 .. 5`"
        reason = "no range in its `optimize`"
        report.report("nothing-to-optimize", name=subject.name, reason=reason, help=help_)
        return None
    report_narrowed(optimization, system, space, report)
    if not report.has_errors:
        _check_scenarios(shipment, subject, space, report)
    check_properties(request.properties, subject, report)
    objectives = list(_objectives(request, subject, fitness, report))
    if report.has_errors:
        return None
    first, *others = objectives
    kept = dict.fromkeys(each.property for each in optimization.constraints)
    properties = tuple({**kept, **dict.fromkeys(request.properties)})
    watched = (each.measure for each in objectives if each.is_property)
    conditions = replace(conditions, properties=tuple(dict.fromkeys((*properties, *watched))))
    shipment = replace(shipment, conditions=conditions)
    given = {name: int(number(value)) for name, value in optimization.settings}
    seed = request.seed if request.seed is not None else given.get("seed", 0)
    plan = Plan(
        space,
        Aim(
            first.goal,
            request.together,
            properties,
            first.measure,
            tuple(others),
            first.is_property,
        ),
        tuple(map(str, request.scenarios)) or (NO_SCENARIO,),
        request.method,
        request.evaluations or given.get("evaluations", 200),
        request.seeds,
        request.fresh,
        seed,
    )
    return Problem(subject, system, optimization, fitness, shipment, plan, request.paths)
