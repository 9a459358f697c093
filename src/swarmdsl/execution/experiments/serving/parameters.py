"""Settings of a swarm by the parameter names of CPSwarm: `altitude`, `scouts`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.experiments.serving.messages import Parameter
from swarmdsl.execution.experiments.task import COUNT, Candidate, Value
from swarmdsl.execution.simulate.scenario.durations import SECOND, written_duration
from swarmdsl.ir import Primitive, Swarm, System, Type
from swarmdsl.syntax.types import DURATION, INTEGERS


class Names:
    """Settings that a parameter may mean; a param that several roles have is set in all of them.

    Where `optimize` of the swarm varies a param, it is that of the roles named there.
    """

    def __init__(self, system: System, swarm: Swarm) -> None:
        self._settings: dict[str, dict[str, Type | None]] = {}
        varied = {
            (each.role, each.param)
            for optimization in system.optimizations
            if optimization.swarm == swarm.name
            for each in optimization.params
        }
        only = {param for _, param in varied}
        for role in swarm.roles:
            for param in role.configured(system.members_by_name[role.member]).params:
                if param.name not in only or (role.name, param.name) in varied:
                    setting = f"{role.name}.{param.name}"
                    self._settings.setdefault(param.name, {})[setting] = param.type
        self._counts = {role.name for role in swarm.roles}

    def candidate(
        self, parameters: Sequence[Parameter], message: Source, report: Diagnostics
    ) -> Candidate:
        """Return the candidate that some parameters mean; report those that mean nothing."""
        found: dict[str, Value] = {}
        for each in parameters:
            settings = dict(self._of(each))
            if not settings:
                known = [*self._settings, *self._counts]
                at = max(message.text.find(f'"{each.name}"'), 0)
                span = Span(message, at, min(at + len(each.name) + 2, len(message.text)))
                help_ = suggest(each.name, known, "names")
                kind = "param or role of the swarm"
                report.report("unresolved-name", span, kind=kind, name=each.name, help=help_)
            found.update(settings)
        return Candidate.of(found)

    def _of(self, parameter: Parameter) -> Iterator[tuple[str, Value]]:
        # A param and a role may have one name; `meta` tells which of them is meant.
        is_file = parameter.meta.startswith("file:")
        if parameter.name in self._counts and not (is_file and parameter.name in self._settings):
            yield f"{COUNT}{parameter.name}", _whole(parameter.value)
            return
        for setting, type_ in self._settings.get(parameter.name, {}).items():
            yield setting, _written(parameter.value, type_)


def _written(value: float, type_: Type | None) -> Value:
    """Return a value as it stands in a scenario; times are given in seconds."""
    if type_ == DURATION:
        return written_duration(round(value * SECOND))
    if isinstance(type_, Primitive) and type_.name in INTEGERS:
        return _whole(value)
    if isinstance(type_, Primitive) and type_.name == "bool":
        return bool(value)
    return value


def _whole(value: float) -> int | float:
    """Return a whole number as an integer; another one is left, and refused by the scenario."""
    return int(value) if value.is_integer() else value
