"""Classes of the function models that the catalogue of the IR lists."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.execution.space.functions.base import Model
from swarmdsl.execution.space.functions.coverage import Coverage
from swarmdsl.execution.space.functions.go_to import GoTo
from swarmdsl.execution.space.functions.random_walk import RandomWalk

CLASSES: Mapping[str, type[Model]] = {
    "coverage": Coverage,
    "go_to": GoTo,
    "random_walk": RandomWalk,
}
