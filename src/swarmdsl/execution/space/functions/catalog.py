"""Classes of the function models that the catalogue of the IR lists."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.execution.space.functions.aggregate import Aggregate
from swarmdsl.execution.space.functions.avoid import Avoid
from swarmdsl.execution.space.functions.base import Model
from swarmdsl.execution.space.functions.bid import Bid
from swarmdsl.execution.space.functions.carry import Carry
from swarmdsl.execution.space.functions.charge import Charge
from swarmdsl.execution.space.functions.coverage import Coverage
from swarmdsl.execution.space.functions.disperse import Disperse
from swarmdsl.execution.space.functions.dock import Dock
from swarmdsl.execution.space.functions.drive import Drive
from swarmdsl.execution.space.functions.flock import Flock
from swarmdsl.execution.space.functions.follow_path import FollowPath
from swarmdsl.execution.space.functions.form_up import FormUp
from swarmdsl.execution.space.functions.go_home import GoHome
from swarmdsl.execution.space.functions.go_to import GoTo
from swarmdsl.execution.space.functions.grasp import Grasp
from swarmdsl.execution.space.functions.hover import Hover
from swarmdsl.execution.space.functions.land import Land
from swarmdsl.execution.space.functions.place import PutDown
from swarmdsl.execution.space.functions.random_walk import RandomWalk
from swarmdsl.execution.space.functions.refill import Refill
from swarmdsl.execution.space.functions.sense import Sense
from swarmdsl.execution.space.functions.spray import Spray
from swarmdsl.execution.space.functions.take_off import TakeOff
from swarmdsl.execution.space.functions.track import Track

CLASSES: Mapping[str, type[Model]] = {
    "aggregate": Aggregate,
    "avoid": Avoid,
    "bid": Bid,
    "carry": Carry,
    "charge": Charge,
    "coverage": Coverage,
    "disperse": Disperse,
    "dock": Dock,
    "drive": Drive,
    "flock": Flock,
    "follow_path": FollowPath,
    "form_up": FormUp,
    "go_home": GoHome,
    "go_to": GoTo,
    "grasp": Grasp,
    "hover": Hover,
    "land": Land,
    "place": PutDown,
    "random_walk": RandomWalk,
    "refill": Refill,
    "sense": Sense,
    "spray": Spray,
    "take_off": TakeOff,
    "track": Track,
}
