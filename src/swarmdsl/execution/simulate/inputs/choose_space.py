"""Choose the space of a simulation: the abstract one, or another one where a model asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space

if TYPE_CHECKING:
    from swarmdsl.execution.space.ensemble import Ensemble
    from swarmdsl.execution.space.setting import Setting

KINDS = ("abstract", "flat", "physics")
_INSTALL = "`pip install 'swarmdsl[world]'` installs it"
_INSTALL_PHYSICS = "`pip install 'swarmdsl[physics]'` installs it"
_ABSTRACT = "leave `--world` out"


def has_geometry(subject: Subject, scenario: Scenario) -> bool:
    """Return True if a model or a scenario says where something is, or how robots move or see.

    That functions of a library have models says only what they do where there are places.
    """
    system, swarm = subject.system, subject.swarm
    if system is None:
        return False
    if any("model" in said for said in scenario.functions.values()):
        return True
    if any(each.model is not None and not each.in_library for each in system.functions):
        return True
    if swarm is None:
        return False
    environment = subject.environment
    if environment is not None and any(
        (
            environment.areas,
            environment.zones,
            environment.walls,
            environment.obstacles,
            environment.targets,
            environment.winds,
            environment.rains,
        )
    ):
        return True
    members = [system.members_by_name[role.member] for role in swarm.roles]
    if any(each.body or each.battery or each.radio for each in members):
        return True
    parts = (part.component for member in members for part in member.parts)
    return any(system.components_by_name[name].sights for name in parts)


def has_places(kind: str | None, subject: Subject, scenario: Scenario) -> bool:
    """Return True if robots have places: in a kind of space, or where something has geometry."""
    return kind != "abstract" and (kind is not None or has_geometry(subject, scenario))


def is_installed() -> bool:
    """Return True if there is NumPy, which spaces other than the abstract one need."""
    return find_spec("numpy") is not None


def has_mujoco() -> bool:
    """Return True if there is MuJoCo, which physics needs."""
    return find_spec("mujoco") is not None


class Spaces:
    """Makes the spaces of runs; without a setting, they are abstract."""

    def __init__(self, setting: Setting | None = None) -> None:
        self._setting = setting

    @property
    def is_flat(self) -> bool:
        """True if robots have places."""
        return self._setting is not None

    @property
    def setting(self) -> Setting | None:
        """Setting of the robots' places; None if they have none."""
        return self._setting

    def alone(self, seed: int, *, covers: bool = True) -> Space:
        """Return the space of one run; with `covers` it notes which ground is covered."""
        if self._setting is None:
            return ABSTRACT
        return self._ensemble([seed], together=False, covers=covers).spaces[0]

    def together(self, seeds: Sequence[int], *, covers: bool = False) -> Ensemble:
        """Return the spaces of runs that move on together."""
        return self._ensemble(seeds, together=True, covers=covers)

    def _ensemble(self, seeds: Sequence[int], *, together: bool, covers: bool) -> Ensemble:
        from swarmdsl.execution.space.ensemble import Ensemble

        assert self._setting is not None
        ensemble = Ensemble(self._setting, seeds, together=together)
        ensemble.stage.covering.is_wanted = covers
        return ensemble


def choose_space(
    kind: str | None,
    subject: Subject,
    scenario: Scenario,
    report: Diagnostics,
) -> Spaces:
    """Return the spaces of a subject: of a kind, or flat ones if it has geometry."""
    if not has_places(kind, subject, scenario):
        return Spaces()
    if not is_installed():
        if kind is None:
            report.report("positions-left-out", name=subject.name, help=_INSTALL)
        else:
            report.report("no-such-world", kind=kind, what="NumPy", help=_INSTALL)
        return Spaces()
    if kind == "physics" and not has_mujoco():
        report.report("no-such-world", kind=kind, what="MuJoCo", help=_INSTALL_PHYSICS)
        return Spaces()
    if subject.system is None:
        if kind is not None:
            what = "a model: SCXML has no robots"
            report.report("no-such-world", kind=kind, what=what, help=_ABSTRACT)
        return Spaces()
    from swarmdsl.execution.space.prepare import prepare_setting

    if kind != "physics":
        return Spaces(prepare_setting(subject, scenario, report))
    from swarmdsl.execution.physics.fitting import check_bodies
    from swarmdsl.execution.physics.motion import PhysicalMotion

    setting = prepare_setting(subject, scenario, report, PhysicalMotion)
    if setting is not None:
        check_bodies(setting.layout, report)
    return Spaces(setting)
