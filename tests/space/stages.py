"""Stages without an engine around them, for tests of what happens in a space."""

from itertools import pairwise

import numpy as np

from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.space.functions.base import ABORTED, RUNNING, SUCCEEDED
from swarmdsl.execution.space.functions.catalog import CLASSES
from swarmdsl.execution.space.functions.running import Running
from swarmdsl.execution.space.layout import Battery, Body, Layout, Unit
from swarmdsl.execution.space.shapes import Edge, Round
from swarmdsl.execution.space.stage import Stage
from swarmdsl.ir import Targets
from swarmdsl.ir.function_models import MODELS
from swarmdsl.ir.space import Point

WALKER = Body(radius=0.2, speed=1.0)
FLYER = Body(radius=0.3, mass=1.5, speed=5.0, climb=2.0)
SAID = {SUCCEEDED: "succeeded", ABORTED: "aborted", RUNNING: "running"}


def units(count, body=WALKER, role="robot", starts=None, **more):
    """Return robots of a role, which start at points or anywhere."""
    return tuple(
        Unit(
            Robot(f"{role}[{index}]", role, "Robot", index, count),
            body,
            start=Point(*starts[index]) if starts is not None else None,
            **more,
        )
        for index in range(count)
    )


def stage(of, seeds=(1,), size=(100.0, 100.0), **more):
    return Stage(Layout(tuple(of), size, **more), seeds)


def wall(*points, high=np.inf, shape=0, opaque=True):
    return tuple(
        Edge(x, y, to_x, to_y, 0.0, high, opaque, shape)
        for (x, y), (to_x, to_y) in pairwise(points)
    )


def disc(x, y, radius, high=np.inf):
    return Round(x, y, radius, high)


def box(low, high, shape=0, height=np.inf, opaque=True):
    (left, bottom), (right, top) = low, high
    corners = ((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom))
    return wall(*corners, high=height, shape=shape, opaque=opaque)


def things(kind, *places):
    return Targets(kind, len(places), tuple(Point(x, y) for x, y in places))


def battery(joules, **powers):
    return Battery(joules, **powers)


class Play:
    """Functions that run on a stage, step by step."""

    def __init__(self, on):
        self.stage = on
        self.functions = {}
        self.ended = {}

    def start(self, model, rows, **given):
        """Begin a function in some rows, with the defaults of the catalogue."""
        defaults = {
            each.name: each.default / SECOND
            if each.kind == "time" and each.default is not None
            else each.default
            for each in MODELS[model].arguments
        }
        assert set(given) <= set(defaults), given
        if model not in self.functions:
            self.functions[model] = Running(model, CLASSES[model], self.stage)
        for row in rows:
            self.ended.pop(row, None)
            self.functions[model].start(row, {**defaults, **given})
        return self

    def step(self):
        on = self.stage
        on.ticks += 1
        part = on.rows_of(range(len(on.seeds)))
        ended = [
            (row, status, each)
            for each in self.functions.values()
            for row, status in each.step(part)
        ]
        for row in on.move(part).tolist():
            on.alive[row] = False
        ended += [
            (row, status, each)
            for each in self.functions.values()
            for row, status in each.contacts()
        ]
        on.eyes.look(part)
        for row, status, function in ended:
            if function.active[row]:
                self.ended[row] = (SAID[status], round(float(on.ticks[0] * on.dt), 6))
                if status == SUCCEEDED:
                    function.result(row)
                function.stop(row)

    def run(self, seconds, each=lambda: None):
        """Let time pass, or less if all functions have ended."""
        for _ in range(round(seconds / self.stage.dt)):
            if not any(function.active.any() for function in self.functions.values()):
                break
            self.step()
            each()
        return self

    def outcomes(self):
        return [self.ended[row][0] for row in sorted(self.ended)]
