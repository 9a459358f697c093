"""A swarm of some size as plain data, which targets print for other model checkers.

In: a model and its properties. Out: states and steps of its robots, which the engine has run, and
the automata that watch properties. Read `plain_data.py` first, then `composer.py`.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.execution.verify.composition.composer import Network, compose, subjects
    from swarmdsl.execution.verify.composition.plain_data import (
        SETTLED,
        VIOLATED,
        Combined,
        Composition,
        Letter,
        Local,
        Number,
        Reading,
        Rule,
        Team,
        Turn,
        Watch,
    )
else:
    from swarmdsl.base.lazy_exports import lazy_exports

    __getattr__ = lazy_exports(
        globals(),
        {
            "swarmdsl.execution.verify.composition.composer": "Network compose subjects",
            "swarmdsl.execution.verify.composition.plain_data": (
                "SETTLED VIOLATED Combined Composition Letter Local Number Reading Rule Team Turn "
                "Watch"
            ),
        },
    )

__all__ = [
    "SETTLED",
    "VIOLATED",
    "Combined",
    "Composition",
    "Letter",
    "Local",
    "Network",
    "Number",
    "Reading",
    "Rule",
    "Team",
    "Turn",
    "Watch",
    "compose",
    "subjects",
]
