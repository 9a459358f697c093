"""
Offboard control of one vehicle with PX4, without ROS.

What the autopilot says goes in; commands, and a setpoint for each step, come out. A goal is a
generator that goes on with each step, until it returns or raises a `FlightError`.
"""

from math import atan2, cos, dist, hypot, isfinite, sin
from typing import NamedTuple

from .offboard_vehicle import (
    ARMING_REFUSED,
    BAD_GOAL,
    COMMAND_REFUSED,
    FlightError,
    LAND,
    MODE_LOST,
    MODE_REFUSED,
    MOTORS_STOPPED,
    name_of,
    NO_ANSWER,
    NO_AUTOPILOT,
    NO_POSITION,
    NOT_FLYING,
    OFFBOARD,
    REPLACED,
    RETURN,
    Setpoint,
    Vehicle,
)

DO_RETURN = 20
DO_LAND = 21
SET_MODE = 176
ARM = 400

# Parameters of SET_MODE: a mode of its own, and which one.
_CUSTOM = 1.0
_CUSTOM_OFFBOARD = 6.0

ACCEPTED = 0
TEMPORARILY_REJECTED = 1
IN_PROGRESS = 5
_ANSWERS = {
    TEMPORARILY_REJECTED: 'rejected for now',
    2: 'denied',
    3: 'not supported',
    4: 'failed',
    6: 'cancelled',
}

_BEFORE = 1.2
"""Seconds of setpoints that PX4 wants before it takes the mode."""
_AGAIN = 0.5
"""Seconds until a command without an answer is sent again: topics of PX4 are best effort."""
_STILL = 0.5
"""Speed below which a vehicle has arrived, in metres per second."""


class End(NamedTuple):
    """End of a goal: the outcome of the action, and the fields of its result."""

    outcome: str
    code: int = 0
    reason: str = ''


class Flight:
    """
    The flight of a vehicle, from the first goal on.

    `send` sends a command with its parameters, `ended` gets the `End` of each goal.
    """

    def __init__(self, settings, send, ended):
        self._settings = settings
        self._send = send
        self._ended = ended
        self.vehicle = Vehicle(settings)
        self._target = None
        self._sent_since = None
        self._named = frozenset()
        self._follows = False
        self._goal = None
        self._work = None
        self._is_cancelled = False
        self._kept_until = 0.0

    def hear_position(self, now, position):
        """Take a `VehicleLocalPosition`; what is held moves with a jump of the estimate."""
        self._move(*self.vehicle.hear_position(now, position))

    def _move(self, way, turn):
        """Move what a goal has not named in the frame: it is held in the world."""
        if self._target is not None:
            place, yaw = self._target
            if 'place' not in self._named:
                place = tuple(a + b for a, b in zip(place, way, strict=True))
            if 'yaw' not in self._named:
                yaw = atan2(sin(yaw + turn), cos(yaw + turn))
            self._target = Setpoint(place, yaw)

    # Goals.

    def begin(self, goal, **arguments):
        """Begin a goal, such as `take_off` with its arguments; an earlier one ends."""
        if self._work is not None:
            self._end(End('aborted', REPLACED, 'another goal took its place'))
        self._goal = goal
        self._is_cancelled = False
        self._work = getattr(self, f'_{goal}')(**arguments)

    def cancel(self):
        """Cancel the goal: the vehicle stays where it is."""
        if self._work is not None and not self._is_cancelled:
            self._is_cancelled = True
            self._follows = False
            self._work = self._stop(self._goal)

    def step(self, now):
        """Go on, and return the setpoint to send, if any."""
        self.vehicle.now = now
        if self._work is not None:
            try:
                next(self._work)
            except StopIteration:
                self._end(End('canceled' if self._is_cancelled else 'succeeded'))
            except FlightError as failure:
                self._give_up()
                outcome = 'canceled' if self._is_cancelled else 'aborted'
                self._end(End(outcome, failure.code, str(failure)))
        if self._follows and self.vehicle.is_placed:
            self._target = self.vehicle.here
        self._expire()
        if self._target is None:
            self._sent_since = None
        elif self._sent_since is None:
            self._sent_since = now
        return self._target

    @property
    def feedback(self):
        """Place of the vehicle and the distance to its goal, or None without a place."""
        if self._work is None or not self.vehicle.is_placed:
            return None
        here = self.vehicle.here.position
        if self._goal in ('land', 'return_to_launch'):
            return here, max(self.vehicle.ground - here[2], 0.0)
        return here, dist(here, self._target.position) if self._target is not None else 0.0

    def _expire(self):
        """
        End setpoints without a goal outside offboard mode, so that nothing leads back to them.

        After a goal that was cancelled before the mode was taken, PX4 may take it for a while.
        """
        if self.vehicle.mode == OFFBOARD:
            self._kept_until = self.vehicle.now
        elif self._work is None and self.vehicle.now >= self._kept_until:
            self._target = None

    def _end(self, end):
        self._work = None
        self._kept_until = self.vehicle.now + self._settings.answer  # x
        self._named = frozenset()
        self._follows = False
        self._ended(end)

    def _give_up(self):
        """Stay where the vehicle is, or leave it to the one who flies it."""
        is_ours = self.vehicle.mode == OFFBOARD
        is_flying = is_ours and self.vehicle.is_armed and not self.vehicle.is_landed
        self._target = self.vehicle.here if is_flying and self.vehicle.is_placed else None

    # The goals as generators.

    def _take_off(self, altitude):
        if not (isfinite(altitude) and altitude > 0):
            raise FlightError(BAD_GOAL, f'the altitude is {altitude}, and must be greater than 0')
        yield from self._ready()
        if self.vehicle.is_landed or not self.vehicle.is_armed:
            self.vehicle.ground = self.vehicle.position.z
        here = self.vehicle.here
        yield from self._take_control()
        yield from self._arm()
        north, east, _ = here.position
        self._target = Setpoint((north, east, self.vehicle.ground - altitude), here.yaw)
        yield from self._arrive()

    def _go_to(self, place, yaw=None):
        if not all(map(isfinite, (*place, 0.0 if yaw is None else yaw))):
            raise FlightError(BAD_GOAL, 'the pose has a number that is not finite')
        yield from self._flying()
        yield from self._take_control()
        self._named = frozenset(['place'] if yaw is None else ['place', 'yaw'])
        self._target = Setpoint(place, self.vehicle.here.yaw if yaw is None else yaw)
        yield from self._arrive()

    def _hold(self, time):
        if not (isfinite(time) and time >= 0):
            raise FlightError(BAD_GOAL, f'the time is {time} s, and must not be negative')
        yield from self._flying()
        yield from self._take_control()
        self._target = self.vehicle.here
        end = self.vehicle.now + time
        while self.vehicle.now < end:
            self.vehicle.check_control()
            yield

    def _land(self):
        yield from self._come_down(DO_LAND, LAND)

    def _return_to_launch(self):
        yield from self._come_down(DO_RETURN, RETURN)

    def _stop(self, goal):
        """Stay where the vehicle is, in place of a goal that was cancelled."""
        if self.vehicle.mode is None or not self.vehicle.is_placed:
            return
        self._target = self.vehicle.here
        if self.vehicle.is_landed:
            # It may have been told to arm, and may not have heard of it yet.
            self._target = None
            self._send(ARM, param1=0.0)
        elif goal in ('land', 'return_to_launch') and self.vehicle.is_armed:
            yield from self._take_control()

    def _come_down(self, command, mode):
        yield from self._ready(needs_place=False)
        if not self.vehicle.is_armed:
            return
        # Setpoints go on at the place where it is: a goal that is cancelled holds it at once.
        self._follows = True
        yield from self._command(command, COMMAND_REFUSED, name_of(mode))
        yield from self._until_mode(mode)
        end = self.vehicle.now + self._settings.landing
        while not self.vehicle.is_landed:
            self.vehicle.check_heard()
            if not self.vehicle.is_armed:
                raise FlightError(MOTORS_STOPPED, 'the motors have stopped in flight')
            if self.vehicle.mode != mode:
                left = f'the vehicle has left the mode {name_of(mode)}: {self.vehicle.mode_name}'
                raise FlightError(MODE_LOST, left)
            self.vehicle.check_time(end, 'is not on the ground')
            yield
        self._follows = False
        self._target = None
        if self.vehicle.is_armed:
            yield from self._command(ARM, COMMAND_REFUSED, 'to stop the motors', param1=0.0)
        end = self.vehicle.now + self._settings.answer
        while self.vehicle.is_armed:
            self.vehicle.check_heard()
            self.vehicle.check_time(end, 'is on the ground with its motors on')
            yield

    # Parts of goals.

    def _ready(self, needs_place=True):
        """Wait until the autopilot is heard, and knows where it is."""
        end = self.vehicle.now + self._settings.silence
        while not self.vehicle.is_heard:
            if self.vehicle.now >= end:
                raise FlightError(NO_AUTOPILOT, 'the autopilot is not heard')
            yield
        self.vehicle.check_heard()
        while needs_place and not self.vehicle.is_placed:
            if self.vehicle.now >= end:
                raise FlightError(NO_POSITION, 'the autopilot tells no valid local position')
            yield

    def _flying(self):
        yield from self._ready()
        if not self.vehicle.is_armed or self.vehicle.is_landed:
            raise FlightError(NOT_FLYING, 'the vehicle does not fly: take off first')

    def _take_control(self):
        """Send setpoints for the place where it is, and change to offboard mode."""
        if self.vehicle.mode == OFFBOARD and self._target is not None:
            return
        self._target = self.vehicle.here
        while self._sent_since is None or self.vehicle.now < self._sent_since + _BEFORE:
            self.vehicle.check_heard()
            self.vehicle.check_placed()
            yield
        values = {'param1': _CUSTOM, 'param2': _CUSTOM_OFFBOARD}
        yield from self._command(SET_MODE, MODE_REFUSED, 'offboard mode', **values)
        yield from self._until_mode(OFFBOARD)

    def _arm(self):
        if self.vehicle.is_armed:
            return
        yield from self._command(ARM, ARMING_REFUSED, 'to arm', param1=1.0)
        end = self.vehicle.now + self._settings.answer
        while not self.vehicle.is_armed:
            self.vehicle.check_heard()
            if self.vehicle.now >= end:
                why = self.vehicle.failed_checks
                raise FlightError(ARMING_REFUSED, f'the vehicle is not armed{why}')
            yield

    def _arrive(self):
        end = self.vehicle.now + self._settings.travel
        while True:
            self.vehicle.check_control()
            here = self.vehicle.position
            way = dist((here.x, here.y, here.z), self._target.position)
            slow = hypot(here.vx, here.vy, here.vz) < _STILL
            if way <= self._settings.tolerance and slow:
                return
            self.vehicle.check_time(end, f'is {way:.1f} m away from its goal')
            yield

    def _command(self, command, code, what, **values):
        """Send a command until it is accepted."""
        self.vehicle.answer(command)
        end = self.vehicle.now + self._settings.answer
        again = self.vehicle.now
        answer = None
        while True:
            self.vehicle.check_heard()
            answer = self.vehicle.answer(command, answer)
            if answer == ACCEPTED:
                return
            if answer in _ANSWERS and answer != TEMPORARILY_REJECTED:
                break
            if self.vehicle.now >= end:
                break
            if self.vehicle.now >= again:
                if answer != IN_PROGRESS:
                    self._send(command, **values)
                again = self.vehicle.now + _AGAIN
            yield
        if answer is None or answer == IN_PROGRESS:
            raise FlightError(NO_ANSWER, f'the autopilot does not answer to the command {what}')
        why = self.vehicle.failed_checks if code == ARMING_REFUSED else ''
        raise FlightError(code, f'the command {what} is {_ANSWERS.get(answer, answer)}{why}')

    def _until_mode(self, mode):
        end = self.vehicle.now + self._settings.answer
        while self.vehicle.mode != mode:
            self.vehicle.check_heard()
            if self.vehicle.now >= end:
                stays = f'the vehicle stays in the mode {self.vehicle.mode_name}'
                raise FlightError(MODE_REFUSED, stays)
            yield
