"""Scene of a run: the state of MuJoCo, and its robots under control."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import mujoco
import numpy as np

from swarmdsl.execution.physics.drives import Drives
from swarmdsl.execution.physics.mjcf import GROUND, form_of
from swarmdsl.execution.physics.quadrotors import Quadrotors
from swarmdsl.execution.space.arrays import Flags, Floats, Whole
from swarmdsl.execution.space.layout import Unit

_ON_GROUND = 0.005
"""Height in metres below which a robot stands on the ground."""
_AT_REST = 0.005
"""Speed in m/s or rad/s below which something is at rest."""
_INTO = 0.1
"""Share of a wanted velocity that has to point at what is touched, to be stopped by it."""


class Places(NamedTuple):
    """Arrays of what a step leads to, with a row for each robot."""

    place: Floats
    velocity: Floats
    heading: Floats
    touched: Flags


class Scene:
    """Robots of a run in MuJoCo."""

    def __init__(self, model: Any, units: Sequence[Unit], x: Floats, y: Floats) -> None:
        self.model = model
        self.data = mujoco.MjData(model)
        forms = [form_of(unit.body) for unit in units]
        self._bottom: Floats = np.array([form.bottom for form in forms])
        joints = [model.joint(f"robot {number}") for number in range(len(units))]
        self._place: Whole = np.array([joint.qposadr[0] for joint in joints])[:, None] + np.arange(
            3
        )
        self._turned: Whole = self._place[:, :1] + np.arange(3, 7)
        self._velocity: Whole = np.array([joint.dofadr[0] for joint in joints])[
            :, None
        ] + np.arange(3)
        self._spin: Whole = self._velocity + 3
        self._body: Whole = np.array([model.body(f"robot {n}").id for n in range(len(units))])
        flies = [form.flies for form in forms]
        self._flying: Whole = np.flatnonzero(flies)
        self._driving: Whole = np.flatnonzero(np.logical_not(flies))
        self._quadrotors = Quadrotors([unit for unit, up in zip(units, flies, strict=True) if up])
        self._drives = Drives([unit for unit, up in zip(units, flies, strict=True) if not up])
        self._motors = self._actuators(self._flying, ("thrust", "torque x", "torque y", "torque z"))
        self._wheels = self._actuators(self._driving, ("left", "right"))
        self._owner = self._owners(len(units))
        self.data.qpos[self._place] = np.column_stack((x, y, self._bottom))
        mujoco.mj_forward(model, self.data)

    def step(self, wanted: Floats, alive: Flags, wind: Floats, substeps: int) -> Places:
        """Do a step of robots that want velocities; `wind` is that of the air."""
        data, dt = self.data, self.model.opt.timestep
        touched = np.zeros(len(alive), dtype=np.bool_)
        for _ in range(substeps):
            axes = self._axes()
            if len(self._flying):
                self._fly(wanted, alive, wind, axes, dt)
            if len(self._driving):
                who = self._driving
                data.ctrl[self._wheels] = self._drives.control(
                    wanted[who], axes[who], alive[who], dt
                )
            mujoco.mj_step(self.model, data)
            if data.ncon:
                self._contacts(wanted, touched)
        self._quadrotors.missed[touched[self._flying]] = 0.0
        axes = self._axes()
        flat = np.hypot(axes[:, 0, 0], axes[:, 1, 0])
        heading = axes[:, :2, 0] / np.maximum(flat, 1e-9)[:, None]
        place = data.qpos[self._place].copy()
        place[:, 2] = self._heights()
        return Places(place, data.qvel[self._velocity].copy(), heading, touched)

    @property
    def places(self) -> Floats:
        """Places of the middles of all robots."""
        found: Floats = self.data.qpos[self._place]
        return found

    @property
    def is_at_rest(self) -> bool:
        """True if nothing moves."""
        return bool((np.abs(self.data.qvel) < _AT_REST).all())

    def set_upright(self, number: int) -> None:
        """Set a robot on its feet, at rest, where it is."""
        data = self.data
        rotation = self._axes()[number]
        yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
        data.qpos[self._turned[number]] = (np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2))
        data.qvel[self._velocity[number]] = data.qvel[self._spin[number]] = 0.0
        height = self._place[number, 2]
        data.qpos[height] = max(data.qpos[height], self._bottom[number])

    # ---- internal

    def _actuators(self, who: Whole, names: Sequence[str]) -> Whole:
        found = [[self.model.actuator(f"{name} {n}").id for name in names] for n in who.tolist()]
        return np.array(found, dtype=np.int64).reshape(len(who), len(names))

    def _owners(self, count: int) -> Whole:
        """Return the robot of each shape; -1 for what is solid, -2 for the ground."""
        model = self.model
        of_body = {model.body(f"robot {number}").id: number for number in range(count)}
        roots = model.body_rootid[model.geom_bodyid]
        found = np.array([of_body.get(int(root), -1) for root in roots], dtype=np.int64)
        found[model.geom(GROUND).id] = -2
        return found

    def _heights(self) -> Floats:
        """Return how high robots are above where they stand on the ground."""
        heights = self.data.qpos[self._place[:, 2]] - self._bottom
        return np.where(heights < _ON_GROUND, 0.0, heights)

    def _axes(self) -> Floats:
        """Return the rotation matrices of all robots, from them to the world."""
        w, x, y, z = self.data.qpos[self._turned].T
        rows = (
            (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
        )
        return np.moveaxis(np.array(rows), -1, 0)

    def _fly(self, wanted: Floats, alive: Flags, wind: Floats, axes: Floats, dt: float) -> None:
        data, who, quadrotors = self.data, self._flying, self._quadrotors
        velocity = data.qvel[self._velocity[who]]
        height = self._heights()[who]
        wants = quadrotors.wants(wanted[who], height)
        on = quadrotors.motors_on(wanted[who], height, alive[who])
        data.xfrc_applied[self._body[who], :3] = quadrotors.drag(velocity, wind, on)
        spin = data.qvel[self._spin[who]]
        data.ctrl[self._motors] = quadrotors.control(wants, velocity, axes[who], spin, on, dt)

    def _contacts(self, wanted: Floats, touched: Flags) -> None:
        """Note the robots that want to go where something is that they touch."""
        contact = self.data.contact
        pairs = self._owner[contact.geom]
        for (one, other), frame in zip(pairs.tolist(), contact.frame, strict=True):
            if -2 in (one, other):
                continue
            # The normal points from the first shape to the second one.
            for robot, sign in ((one, 1.0), (other, -1.0)):
                if robot >= 0:
                    want = wanted[robot]
                    into = sign * float(want @ frame[:3])
                    touched[robot] |= into > _INTO * float(np.sqrt(want @ want))
