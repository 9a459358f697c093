"""
State of one vehicle with PX4, as its autopilot has told it, without ROS.

Places are in metres in the frame of PX4, north, east, down from the start of its estimate.
"""

from typing import Any, NamedTuple

from .offboard_frames import jump

_ARMED = 2
POSITION_MODE = 2
LOITER = 4
RETURN = 5
OFFBOARD = 14
LAND = 18
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


class Vehicle:
    """A vehicle at the time `now`, with what its autopilot has told last."""

    def __init__(self, settings):
        self._settings = settings
        self.now = 0.0
        self.ground = 0.0
        self.position = None
        self._status = self._landing = None
        self._status_at = self._position_at = None
        self._answers = {}

    def hear_status(self, now, status):
        """Take a `VehicleStatus`."""
        self._status, self._status_at = status, now

    def hear_position(self, now, position):
        """Take a `VehicleLocalPosition`; return how far, and by which angle, it has jumped."""
        way, turn = (0.0, 0.0, 0.0), 0.0
        if self.position is not None:
            way, turn = jump(self.position, position)
        self.ground += way[2]
        self.position, self._position_at = position, now
        if self.is_landed and position.z_valid:
            self.ground = position.z
        return way, turn

    def hear_landed(self, landing):
        """Take a `VehicleLandDetected`."""
        self._landing = landing

    def hear_answer(self, answer):
        """Take a `VehicleCommandAck`."""
        self._answers[answer.command] = answer.result

    def answer(self, command, default=None):
        """Return the last answer to a command, and forget it."""
        return self._answers.pop(command, default)

    @property
    def mode(self):
        """Mode that it is in; None before the autopilot is heard."""
        return None if self._status is None else self._status.nav_state

    @property
    def mode_name(self):
        """Name of its mode for people."""
        return name_of(self.mode)

    @property
    def is_landed(self):
        """Return True if the vehicle is known to stand on the ground."""
        return self._landing is not None and self._landing.landed

    @property
    def is_armed(self):
        """Return True if its motors run."""
        return self._status is not None and self._status.arming_state == _ARMED

    @property
    def is_heard(self):
        """Return True if the autopilot has told its status lately."""
        return self._is_fresh(self._status_at)

    @property
    def is_placed(self):
        """Return True if the autopilot has told a valid position lately."""
        here = self.position
        return self._is_fresh(self._position_at) and here.xy_valid and here.z_valid

    def _is_fresh(self, at):
        return at is not None and self.now - at <= self._settings.silence

    @property
    def here(self):
        """Its place and heading as a setpoint."""
        here = self.position
        return Setpoint((here.x, here.y, here.z), here.heading)

    @property
    def failed_checks(self):
        """Reason to add where it refuses to arm."""
        return '' if self._status.pre_flight_checks_pass else ': pre-flight checks do not pass'

    def check_heard(self):
        """Raise a `FlightError` unless this vehicle is heard."""
        if not self.is_heard:
            raise FlightError(NO_AUTOPILOT, 'the autopilot is not heard')
        if self._status.system_id != self._settings.system:
            system, other = self._settings.system, self._status.system_id
            raise FlightError(OTHER_VEHICLE, f'the vehicle is system {other}, not {system}')

    def check_placed(self):
        """Raise a `FlightError` unless it knows where it is."""
        if not self.is_placed:
            raise FlightError(NO_POSITION, 'the autopilot tells no valid local position')

    def check_control(self):
        """Raise a `FlightError` unless it flies in offboard mode, and knows where it is."""
        self.check_heard()
        if self.mode != OFFBOARD:
            why = ' in a failsafe' if self._status.failsafe else ''
            lost = f'the vehicle has left offboard control{why}: {self.mode_name}'
            raise FlightError(MODE_LOST, lost)
        if not self.is_armed:
            raise FlightError(MOTORS_STOPPED, 'the motors have stopped')
        self.check_placed()

    def check_time(self, end, what):
        """Raise a `FlightError` from a time on; `what` says what the vehicle has not reached."""
        if self.now >= end:
            raise FlightError(TIME_OVER, f'the time is over: the vehicle {what}')


def name_of(mode):
    """Return the name of a mode of PX4 for people."""
    return _MODES.get(mode, f'number {mode}')
