"""Worlds of all environments, and reports of what they cannot hold."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.codegen import Diagnostics, OutputFile
from swarmdsl.codegen.xml import document
from swarmdsl.ir import Environment, System

from .options import Options
from .world import World, lasting

TARGET = "gazebo"
_RESERVED = re.compile("world|__.*__")


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield the world of each environment."""
    for environment in system.environments:
        if _RESERVED.fullmatch(environment.name):
            report.report(
                "bad-identifier",
                environment.origin,
                target=TARGET,
                name=environment.name,
                use="the name of a world",
                notes=("SDF reserves `world`, and names between `__` and `__`",),
            )
            continue
        report_left_out(environment, TARGET, report)
        text = document(World(environment, options).sdf(options.sdf, environment.name))
        yield OutputFile(f"{environment.name}.sdf", text, origin=environment.origin)


def report_left_out(environment: Environment, target: str, report: Diagnostics) -> None:
    """Report what a world cannot hold, each at its place."""
    for targets in environment.targets:
        if not targets.places:
            number = f"{targets.count} targets" if targets.count > 1 else "a target"
            report.report(
                "no-place",
                targets.origin,
                target=target,
                what=f"{number} `{targets.kind}` at random",
                notes=("only a target at a point is placed in the world",),
            )
    for wind in environment.winds:
        if not lasting(wind):
            report.report(
                "no-place",
                wind.origin,
                target=target,
                what="the times of a wind",
                notes=("the wind of a world never changes: this one is left out",),
            )
    for rain in environment.rains:
        report.report("no-place", rain.origin, target=target, what="rain")
