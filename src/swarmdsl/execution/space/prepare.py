"""Prepare the setting of a space: its layout and its function models, checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.machines.subject import MOST_MEMBERS, Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.space.building import UnfitError, build
from swarmdsl.execution.space.functions.catalog import CLASSES
from swarmdsl.execution.space.functions.foreign import load
from swarmdsl.execution.space.motion import Motion
from swarmdsl.execution.space.robots import Robots
from swarmdsl.execution.space.setting import Kind, Setting
from swarmdsl.ir.function_models import MODELS


def prepare_setting(
    subject: Subject,
    scenario: Scenario,
    report: Diagnostics,
    motion: Callable[[Robots], Motion] = Motion,
) -> Setting | None:
    """Return the setting of a subject; None if something of it cannot be, which is reported."""
    assert subject.system is not None
    if subject.size(scenario.counts) > MOST_MEMBERS:
        return None  # reported when the robots are made
    robots = subject.create_robots(scenario.counts, scenario.alone)
    kinds = {name: Kind(name, MODELS[name].arguments, made) for name, made in CLASSES.items()}
    kinds.update(_of_project(subject, scenario, report))
    try:
        layout = build(subject, robots, scenario)
    except UnfitError as error:
        report.report("unfit-device", name=error.name, owner=error.owner, reason=error.reason)
        return None
    return Setting(layout, subject.system, scenario, kinds, motion)


def _of_project(subject: Subject, scenario: Scenario, report: Diagnostics) -> Mapping[str, Kind]:
    """Load the models of the project that are used."""
    used = {str(said["model"]): said for said in scenario.functions.values() if "model" in said}
    system = subject.system
    for function in system.functions if system is not None else ():
        if function.model is not None:
            used.setdefault(function.model.name, {})
    found = {}
    for name, source in subject.models.items():
        if name not in used:
            continue
        kind = load(source, report)
        if kind is None:
            continue
        known = [each.name for each in kind.arguments]
        for key in used[name].get("arguments", {}):
            if key not in known:
                help_ = suggest(key, known, "arguments")
                owner = f"model `{name}`"
                report.report("unknown-key", name=key, owner=owner, help=help_)
        for function in system.functions if system is not None else ():
            use = function.model
            for key, _ in use.arguments if use is not None and use.name == name else ():
                if key not in known:
                    help_ = suggest(key, known, "arguments")
                    place = use.origin if use is not None else None
                    report.report("unknown-argument", place, model=name, name=key, help=help_)
        found[name] = kind
    return found
