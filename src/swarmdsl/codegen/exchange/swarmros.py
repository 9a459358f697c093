"""Target `swarmros`: for each member, the configuration of CPSwarm's bridge."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import Generator, NoOptions, OutputFile
from swarmdsl.codegen.shared.swarmros import bridge_files
from swarmdsl.ir import System


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """Return the configuration of each member's bridge."""
    return bridge_files(system, report)


generator = Generator(
    target="swarmros",
    summary="the configuration of the bridge between members, CPSwarm's swarmros",
    emit=emit,
)
