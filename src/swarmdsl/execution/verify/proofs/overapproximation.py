"""Models with more runs than a given one: what holds in all of theirs, holds in all of its own."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.abstraction.places import Node
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.open_data import is_about, loosened
from swarmdsl.execution.verify.swarm.model import Model

_VARIABLES = "its variables"


def robot_alone(
    model: Model,
    properties: Sequence[ir.Property],
    robot: str | None,
    budget: Budget,
    *,
    is_open: bool = False,
) -> Model | None:
    """Return the model of one robot, to which others may send anything at any time.

    Only what decides on this robot and some properties counts. With `is_open`, conditions on its
    variables hold or not, each time, and it is about the properties that do not read them: None if
    there is none, or if delays depend on them.
    """
    key = (robot, tuple(each.name for each in properties), is_open)
    if key not in model.wider:
        model.wider[key] = (
            _with_open_variables(model, properties, budget, robot)
            if is_open
            else _of(model, model.subject, properties, budget, robot, ())
        )
    return model.wider[key]


def with_open_data(model: Model, budget: Budget) -> Model | None:
    """Return the model in which conditions on data that are not all covered hold or not, each time.

    These data come from outside, and so does what is computed from them. It is about the properties
    that do not read them; None if there is none, or if delays depend on them.
    """
    if "" not in model.wider:
        model.wider[""] = _with_open_data(model, budget)
    return model.wider[""]


def _with_open_data(model: Model, budget: Budget) -> Model | None:
    uncovered = _uncovered(model)
    data = model.demands.reached_from(uncovered)
    properties = [each for each in model.properties if not is_about(each, model.cast, data)]
    if not uncovered or not properties:
        return None
    robots = [actor.robot for actor in model.cast]
    receivers = dict.fromkeys([each.role for each in robots] + [each.name for each in robots])
    subject = loosened(
        model.subject, model.machines.values(), data, [each for each in receivers if each]
    )
    shown = (".".join((name, *path)) for _, name, path in sorted(uncovered))
    return _of(model, subject, properties, budget, None, tuple(f"`{each}`" for each in shown))


def _with_open_variables(
    model: Model, properties: Sequence[ir.Property], budget: Budget, robot: str | None
) -> Model | None:
    budget.check()
    variables = {
        ("var", f"{machine.name}.{each.name}", ())
        for machine in model.machines.values()
        for each in machine.variables
    }
    data = model.demands.reached_from(variables | _uncovered(model))
    properties = [each for each in properties if not is_about(each, model.cast, data)]
    if not properties:
        return None
    subject = loosened(model.subject, model.machines.values(), data)
    return _of(model, subject, properties, budget, robot, (_VARIABLES,))


def _uncovered(model: Model) -> set[Node]:
    return model.demands.uncovered(model.environment.outside)


def _of(
    model: Model,
    subject: Subject | None,
    properties: Sequence[ir.Property],
    budget: Budget,
    only: str | None,
    open_: tuple[str, ...],
) -> Model | None:
    if subject is None:
        return None
    budget.check()
    report = Diagnostics()
    shown = (*model.open, *open_)
    made = Model(subject, model.counts, properties, model.options, budget, report, only, shown)
    assert not report.has_errors, "the swarm has been made before"
    return made
