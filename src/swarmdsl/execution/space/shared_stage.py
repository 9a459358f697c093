"""Stage, radio links and functions that the spaces of some runs share."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.space.functions.running import Running
from swarmdsl.execution.space.messages import Messages
from swarmdsl.execution.space.radio import Links
from swarmdsl.execution.space.setting import Setting, Use
from swarmdsl.execution.space.stage import Stage

Key = tuple[str, str]
"""Function and its model."""


class SharedStage:
    """Stage of some runs with the same setting, radio links, and the functions in its robots."""

    def __init__(self, setting: Setting, seeds: Sequence[int]) -> None:
        self.setting = setting
        self.stage = Stage(setting.layout, seeds, setting.motion)
        self.links = Links(self.stage)
        self.messages = Messages(setting.system)
        self.functions: dict[Key, Running] = {}

    def running(self, use: Use) -> Running:
        """Return the function with this model in all robots."""
        key = (use.function, use.kind.name)
        if key not in self.functions:
            self.functions[key] = Running(use.function, use.kind.make, self.stage)
            # What happens does not depend on which function has been called first in some run.
            self.functions = dict(sorted(self.functions.items()))
        return self.functions[key]
