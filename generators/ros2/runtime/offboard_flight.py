"""
Offboard control of one vehicle with PX4, without ROS.

What the autopilot says goes in (`hear_...`); commands, and a setpoint for each step, come out. A
goal is a generator that goes on with each step, until it returns or raises a `FlightError`. Places
are in metres in the frame of PX4, north, east, down from the start of its estimate.
"""

from math import atan2, cos, dist, hypot, isfinite, sin
from typing import Any, NamedTuple

ARMED = 2
POSITION_MODE = 2
LOITER = 4
RETURN = 5
OFFBOARD = 14
LAND = 18

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
_MODES = {
    0: 'manual',
    1: 'altitude control',
    POSITION_MODE: 'position control',
    3: 'mission',
    LOITER: 'hold',
    RETURN: 'return',
    12: 'descend',
    13: 'termination',
    OFFBOARD: 'offboard',
    17: 'take off',
    LAND: 'land',
}

NO_AUTOPILOT = 1
NO_POSITION = 2
OTHER_VEHICLE = 3
ARMING_REFUSED = 4
MODE_REFUSED = 5
COMMAND_REFUSED = 6
NO_ANSWER = 7
MODE_LOST = 8
MOTORS_STOPPED = 9
TIME_OVER = 10
NOT_FLYING = 11
BAD_GOAL = 12
REPLACED = 13

_BEFORE = 1.2
"""Seconds of setpoints that PX4 wants before it takes the mode."""
_AGAIN = 0.5
"""Seconds until a command without an answer is sent again: topics of PX4 are best effort."""
_COUNTERS = 256
"""Values of a counter of PX4, which begins again after them."""
_STILL = 0.5
"""Speed below which a vehicle has arrived, in metres per second."""


class FlightError(Exception):
    """A goal cannot be reached, with its code and the reason for people."""

    def __init__(self, code, reason):
        super().__init__(reason)
        self.code = code


class Settings(NamedTuple):
    """Parameters of the node, in metres and seconds."""

    system: int = 1
    tolerance: float = 0.3
    silence: float = 1.0
    answer: float = 5.0
    travel: float = 120.0
    landing: float = 300.0


class Setpoint(NamedTuple):
    """Place and heading that the vehicle is to have."""

    position: Any
    yaw: float


class End(NamedTuple):
    """End of a goal: the outcome of the action, and the fields of its result."""

    outcome: str
    code: int = 0
    reason: str = ''


def to_ned(x, y, z):
    """Return a place of the frame east, north, up in the frame north, east, down, or back."""
    return y, x, -z


def turned(yaw):
    """Return an angle from east to the left as one from north to the right, or back."""
    return atan2(cos(yaw), sin(yaw))


def jump(before, after):
    """Return how far, and by which angle, the estimate has jumped between two positions."""
    seen = after.x - before.x, after.y - before.y, after.z - before.z
    north, east = _jumped(before, after, 'xy', after.delta_xy, seen[:2])
    (down,) = _jumped(before, after, 'z', [after.delta_z], seen[2:])
    turn = [after.heading - before.heading]
    (turn,) = _jumped(before, after, 'heading', [after.delta_heading], turn)
    return (north, east, down), turn


def _jumped(before, after, what, told, seen):
    """Return what is told of a jump, or what is seen of several: the last one alone is told."""
    name = f'{what}_reset_counter'
    count = (getattr(after, name) - getattr(before, name)) % _COUNTERS
    found = told if count == 1 else seen
    return [float(each) if count and isfinite(each) else 0.0 for each in found]


def heading(x, y, z, w):
    """Return the angle of a quaternion around the vertical axis; None if all of it is 0."""
    if not any((x, y, z, w)):
        return None
    return atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class Flight:
    """
    The flight of a vehicle, from the first goal on.

    `send` sends a command with its parameters, `ended` gets the `End` of each goal.
    """

    def __init__(self, settings, send, ended):
        self._settings = settings
        self._send = send
        self._ended = ended
        self._now = 0.0
        self._status = self._position = self._landing = None
        self._status_at = self._position_at = None
        self._answers = {}
        self._ground = 0.0
        self._target = None
        self._sent_since = None
        self._named = frozenset()
        self._follows = False
        self._goal = None
        self._work = None
        self._is_cancelled = False

    # What the autopilot says.

    def hear_status(self, now, status):
        """Take a `VehicleStatus`."""
        was_offboard = self._status is not None and self._status.nav_state == OFFBOARD
        self._status, self._status_at = status, now
        if self._work is None and was_offboard and status.nav_state != OFFBOARD:
            # Somebody else flies: setpoints end, so that nothing leads back to the old ones.
            self._target = None

    def hear_position(self, now, position):
        """Take a `VehicleLocalPosition`; what is held moves with a jump of the estimate."""
        if self._position is not None:
            self._move(*jump(self._position, position))
        self._position, self._position_at = position, now
        if self.is_landed and position.z_valid:
            self._ground = position.z

    def _move(self, way, turn):
        """Move the ground, and what a goal has not named in the frame: it is held in the world."""
        self._ground += way[2]
        if self._target is not None:
            place, yaw = self._target
            if 'place' not in self._named:
                place = tuple(a + b for a, b in zip(place, way, strict=True))
            if 'yaw' not in self._named:
                yaw = atan2(sin(yaw + turn), cos(yaw + turn))
            self._target = Setpoint(place, yaw)

    def hear_landed(self, landing):
        """Take a `VehicleLandDetected`."""
        self._landing = landing

    def hear_answer(self, answer):
        """Take a `VehicleCommandAck`."""
        self._answers[answer.command] = answer.result

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
        self._now = now
        if self._work is not None:
            try:
                next(self._work)
            except StopIteration:
                self._end(End('canceled' if self._is_cancelled else 'succeeded'))
            except FlightError as failure:
                self._give_up()
                outcome = 'canceled' if self._is_cancelled else 'aborted'
                self._end(End(outcome, failure.code, str(failure)))
        if self._follows and self._is_placed():
            self._target = self._here()
        if self._target is None:
            self._sent_since = None
        elif self._sent_since is None:
            self._sent_since = now
        return self._target

    @property
    def is_landed(self):
        """Return True if the vehicle is known to stand on the ground."""
        return self._landing is not None and self._landing.landed

    @property
    def feedback(self):
        """Place of the vehicle and the distance to its goal, or None without a place."""
        if self._work is None or not self._is_placed():
            return None
        here = self._here().position
        if self._goal in ('land', 'return_to_launch'):
            return here, max(self._ground - here[2], 0.0)
        return here, dist(here, self._target.position) if self._target is not None else 0.0

    def _end(self, end):
        self._work = None
        self._named = frozenset()
        self._follows = False
        self._ended(end)

    def _give_up(self):
        """Stay where the vehicle is, or leave it to the one who flies it."""
        is_ours = self._status is not None and self._status.nav_state == OFFBOARD
        is_flying = is_ours and self._is_armed() and not self.is_landed
        self._target = self._here() if is_flying and self._is_placed() else None

    # The goals as generators.

    def _take_off(self, altitude):
        if not (isfinite(altitude) and altitude > 0):
            raise FlightError(BAD_GOAL, f'the altitude is {altitude}, and must be greater than 0')
        yield from self._ready()
        if self.is_landed or not self._is_armed():
            self._ground = self._position.z
        here = self._here()
        yield from self._take_control()
        yield from self._arm()
        north, east, _ = here.position
        self._target = Setpoint((north, east, self._ground - altitude), here.yaw)
        yield from self._arrive()

    def _go_to(self, place, yaw=None):
        if not all(map(isfinite, (*place, 0.0 if yaw is None else yaw))):
            raise FlightError(BAD_GOAL, 'the pose has a number that is not finite')
        yield from self._flying()
        yield from self._take_control()
        self._named = frozenset(['place'] if yaw is None else ['place', 'yaw'])
        self._target = Setpoint(place, self._here().yaw if yaw is None else yaw)
        yield from self._arrive()

    def _hold(self, time):
        if not (isfinite(time) and time >= 0):
            raise FlightError(BAD_GOAL, f'the time is {time} s, and must not be negative')
        yield from self._flying()
        yield from self._take_control()
        self._target = self._here()
        end = self._now + time
        while self._now < end:
            self._check_control()
            yield

    def _land(self):
        yield from self._come_down(DO_LAND, LAND)

    def _return_to_launch(self):
        yield from self._come_down(DO_RETURN, RETURN)

    def _stop(self, goal):
        """Stay where the vehicle is, in place of a goal that was cancelled."""
        if self._status is None or not self._is_placed():
            return
        self._target = self._here()
        if self.is_landed:
            # It may have been told to arm, and may not have heard of it yet.
            self._target = None
            self._send(ARM, param1=0.0)
        elif goal in ('land', 'return_to_launch') and self._is_armed():
            yield from self._take_control()

    def _come_down(self, command, mode):
        yield from self._ready(needs_place=False)
        if not self._is_armed():
            return
        # Setpoints go on at the place where it is: a goal that is cancelled holds it at once.
        self._follows = True
        yield from self._command(command, COMMAND_REFUSED, _words(mode))
        yield from self._until_mode(mode)
        end = self._now + self._settings.landing
        while not self.is_landed:
            self._check_heard()
            if not self._is_armed():
                raise FlightError(MOTORS_STOPPED, 'the motors have stopped in flight')
            if self._status.nav_state != mode:
                now_in = _words(self._status.nav_state)
                raise FlightError(
                    MODE_LOST, f'the vehicle has left the mode {_words(mode)}: {now_in}'
                )
            self._check_time(end, 'is not on the ground')
            yield
        self._follows = False
        self._target = None
        if self._is_armed():
            yield from self._command(ARM, COMMAND_REFUSED, 'to stop the motors', param1=0.0)
        end = self._now + self._settings.answer
        while self._is_armed():
            self._check_heard()
            self._check_time(end, 'is on the ground with its motors on')
            yield

    # Parts of goals.

    def _ready(self, needs_place=True):
        """Wait until the autopilot is heard, and knows where it is."""
        end = self._now + self._settings.silence
        while not self._is_heard():
            if self._now >= end:
                raise FlightError(NO_AUTOPILOT, 'the autopilot is not heard')
            yield
        self._check_heard()
        while needs_place and not self._is_placed():
            if self._now >= end:
                raise FlightError(NO_POSITION, 'the autopilot tells no valid local position')
            yield

    def _flying(self):
        yield from self._ready()
        if not self._is_armed() or self.is_landed:
            raise FlightError(NOT_FLYING, 'the vehicle does not fly: take off first')

    def _take_control(self):
        """Send setpoints for the place where it is, and change to offboard mode."""
        if self._status.nav_state == OFFBOARD and self._target is not None:
            return
        self._target = self._here()
        while self._sent_since is None or self._now < self._sent_since + _BEFORE:
            self._check_heard()
            self._check_placed()
            yield
        values = {'param1': _CUSTOM, 'param2': _CUSTOM_OFFBOARD}
        yield from self._command(SET_MODE, MODE_REFUSED, 'offboard mode', **values)
        yield from self._until_mode(OFFBOARD)

    def _arm(self):
        if self._is_armed():
            return
        yield from self._command(ARM, ARMING_REFUSED, 'to arm', param1=1.0)
        end = self._now + self._settings.answer
        while not self._is_armed():
            self._check_heard()
            if self._now >= end:
                raise FlightError(ARMING_REFUSED, f'the vehicle is not armed{self._preflight()}')
            yield

    def _arrive(self):
        end = self._now + self._settings.travel
        while True:
            self._check_control()
            here = self._position
            way = dist((here.x, here.y, here.z), self._target.position)
            slow = hypot(here.vx, here.vy, here.vz) < _STILL
            if way <= self._settings.tolerance and slow:
                return
            self._check_time(end, f'is {way:.1f} m away from its goal')
            yield

    def _command(self, command, code, what, **values):
        """Send a command until it is accepted."""
        self._answers.pop(command, None)
        end = self._now + self._settings.answer
        again = self._now
        answer = None
        while True:
            self._check_heard()
            answer = self._answers.pop(command, answer)
            if answer == ACCEPTED:
                return
            if answer in _ANSWERS and answer != TEMPORARILY_REJECTED:
                break
            if self._now >= end:
                break
            if self._now >= again:
                if answer != IN_PROGRESS:
                    self._send(command, **values)
                again = self._now + _AGAIN
            yield
        if answer is None or answer == IN_PROGRESS:
            raise FlightError(NO_ANSWER, f'the autopilot does not answer to the command {what}')
        why = self._preflight() if code == ARMING_REFUSED else ''
        raise FlightError(code, f'the command {what} is {_ANSWERS.get(answer, answer)}{why}')

    def _until_mode(self, mode):
        end = self._now + self._settings.answer
        while self._status.nav_state != mode:
            self._check_heard()
            if self._now >= end:
                now_in = _words(self._status.nav_state)
                raise FlightError(MODE_REFUSED, f'the vehicle stays in the mode {now_in}')
            yield

    # Checks.

    def _check_control(self):
        self._check_heard()
        if self._status.nav_state != OFFBOARD:
            why = ' in a failsafe' if self._status.failsafe else ''
            now_in = _words(self._status.nav_state)
            raise FlightError(MODE_LOST, f'the vehicle has left offboard control{why}: {now_in}')
        if not self._is_armed():
            raise FlightError(MOTORS_STOPPED, 'the motors have stopped')
        self._check_placed()

    def _check_heard(self):
        if not self._is_heard():
            raise FlightError(NO_AUTOPILOT, 'the autopilot is not heard')
        if self._status.system_id != self._settings.system:
            system, other = self._settings.system, self._status.system_id
            raise FlightError(OTHER_VEHICLE, f'the vehicle is system {other}, not {system}')

    def _check_placed(self):
        if not self._is_placed():
            raise FlightError(NO_POSITION, 'the autopilot tells no valid local position')

    def _check_time(self, end, what):
        if self._now >= end:
            raise FlightError(TIME_OVER, f'the time is over: the vehicle {what}')

    def _is_heard(self):
        return self._is_fresh(self._status_at)

    def _is_placed(self):
        here = self._position
        return self._is_fresh(self._position_at) and here.xy_valid and here.z_valid

    def _is_fresh(self, at):
        return at is not None and self._now - at <= self._settings.silence

    def _is_armed(self):
        return self._status.arming_state == ARMED

    def _here(self):
        here = self._position
        return Setpoint((here.x, here.y, here.z), here.heading)

    def _preflight(self):
        return '' if self._status.pre_flight_checks_pass else ': pre-flight checks do not pass'


def _words(mode):
    return _MODES.get(mode, f'number {mode}')
