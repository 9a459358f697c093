"""
Node with the functions of offboard control of one vehicle with PX4.

It sends setpoints and commands on topics of XRCE-DDS, and has an action server for each function.
"""

from functools import partial

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from px4_msgs.msg import (
    OffboardControlMode,
    TrajectorySetpoint,
    VehicleCommand,
    VehicleCommandAck,
    VehicleLandDetected,
    VehicleLocalPosition,
    VehicleStatus,
)
import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.clock import Clock, ClockType
from rclpy.exceptions import InvalidTopicNameException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future

from . import parameters
from .identity import identity
from .offboard_flight import Flight
from .offboard_frames import heading, to_ned, turned
from .offboard_vehicle import Settings
from .parameters import Parameter, StartError

PARAMETERS = (
    Parameter('member', 'string', '', 'Its robot, such as uav[0]; the launch files set it.'),
    Parameter('system', 'uint8', 0, 'System of MAVLink; 0: the number of its robot, plus 1.'),
    Parameter('vehicle', 'string', '', 'Namespace of the topics of PX4; {system} is its system.'),
    Parameter('frame', 'string', 'enu', 'Frame of goals: `enu`, or `ned` as in PX4.'),
    Parameter('rate', 'float64', 20.0, 'Setpoints in a second, more than 2.'),
    Parameter('tolerance', 'float64', 0.3, 'Metres to a place at which the vehicle is there.'),
    Parameter('timeouts.silence', 'duration', 1.0, 'Time in which the autopilot is to be heard.'),
    Parameter('timeouts.answer', 'duration', 5.0, 'Time in which it obeys a command.'),
    Parameter('timeouts.travel', 'duration', 120.0, 'Time to climb or to fly to a place.'),
    Parameter('timeouts.landing', 'duration', 300.0, 'Time to land, also after the way back.'),
)
_SECOND = 10**9
_FRAMES = ('enu', 'ned')
_SLOWEST, _FASTEST = 2.0, 200.0
_LAST_SYSTEM = 255
_FEEDBACK = 0.5
_NAN = float('nan')
# PX4 publishes its state in this way, also for those who come late.
_STATE = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
# It hears so. Volatile, since an old command must not reach an autopilot that comes late.
_ORDERS = QoSProfile(
    depth=5,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    durability=DurabilityPolicy.VOLATILE,
)


class OffboardNode(Node):
    """
    Action servers of a vehicle; only one of their goals is flown at a time.

    `servers` are goals of a `Flight`, with interfaces and names of servers; `topics` are those
    of PX4 by the names of their messages.
    """

    def __init__(self, servers, topics):
        super().__init__('px4_offboard')
        parameters.declare(self, PARAMETERS)
        found = parameters.values(self, PARAMETERS)
        self._system = found['system'] or self._number(found['member']) + 1
        self._frame = found['frame']
        self._check(found)
        settings = Settings(
            self._system,
            found['tolerance'],
            *(
                found[f'timeouts.{each}'] / _SECOND
                for each in ('silence', 'answer', 'travel', 'landing')
            ),
        )
        self._flight = Flight(settings, self._command, self._end)
        # A vehicle flies in the time of the world, even if the time of ROS stands still.
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._handle = self._future = self._interface = None
        self._fed_back = 0.0
        space = found['vehicle'].replace('{system}', str(self._system))
        try:
            self._connect(topics, space)
        except InvalidTopicNameException as error:
            raise StartError(f'parameter `vehicle` is no namespace: {error}') from None
        self._servers = [
            ActionServer(
                self,
                interface,
                name,
                execute_callback=partial(self._execute, goal, interface),
                goal_callback=lambda _: GoalResponse.ACCEPT,
                cancel_callback=self._cancel,
            )
            for goal, interface, name in servers
        ]
        self.create_timer(1 / found['rate'], self._step, clock=self._steady)
        self.get_logger().info(f'flies system {self._system} of MAVLink')

    def _number(self, member):
        return identity({'member': member, 'self.count': 0}, self.get_namespace()).index

    def _check(self, found):
        if self._frame not in _FRAMES:
            raise StartError(f'parameter `frame` is `{self._frame}`, and must be enu or ned')
        if not _SLOWEST < found['rate'] <= _FASTEST:
            bounds = f'more than {_SLOWEST} and at most {_FASTEST}'
            raise StartError(f'parameter `rate` is {found["rate"]}, and must be {bounds}')
        for name in ('tolerance', *(each for each in found if each.startswith('timeouts.'))):
            if not found[name] > 0:
                raise StartError(f'parameter `{name}` must be above 0')
        if self._system > _LAST_SYSTEM:
            number = f'{found["member"]} has system {self._system} of MAVLink'
            raise StartError(f'{number}, and the last one is {_LAST_SYSTEM}: set `system`')

    def _connect(self, topics, space):
        def named(interface):
            name = topics[interface.__name__]
            return f'{space.rstrip("/")}/{name}' if space else name

        self._modes, self._setpoints, self._commands = (
            self.create_publisher(each, named(each), _ORDERS)
            for each in (OffboardControlMode, TrajectorySetpoint, VehicleCommand)
        )
        flight, vehicle = self._flight, self._flight.vehicle
        for interface, hear in (
            (VehicleStatus, lambda message: vehicle.hear_status(self._now(), message)),
            (VehicleLocalPosition, lambda message: flight.hear_position(self._now(), message)),
            (VehicleLandDetected, vehicle.hear_landed),
            (VehicleCommandAck, vehicle.hear_answer),
        ):
            self.create_subscription(interface, named(interface), hear, _STATE)

    def _now(self):
        return self._steady.now().nanoseconds / _SECOND

    def _stamp(self):
        return self.get_clock().now().nanoseconds // 1000

    async def _execute(self, goal, interface, handle):
        """Fly; an earlier goal has ended when this one begins."""
        self._flight.begin(goal, **self._arguments(goal, handle.request))
        self._handle, self._future = handle, Future()
        self._interface = interface
        if handle.is_cancel_requested:
            self._flight.cancel()
        end = await self._future
        return interface.Result(error_code=end.code, error_msg=end.reason)

    def _arguments(self, goal, request):
        if goal == 'take_off':
            return {'altitude': request.altitude}
        if goal == 'hold':
            time: Duration = request.time
            return {'time': time.sec + time.nanosec / _SECOND}
        if goal != 'go_to':
            return {}
        place, turn = request.pose.pose.position, request.pose.pose.orientation
        yaw = heading(turn.x, turn.y, turn.z, turn.w)
        if self._frame == 'ned':
            return {'place': (place.x, place.y, place.z), 'yaw': yaw}
        yaw = None if yaw is None else turned(yaw)
        return {'place': to_ned(place.x, place.y, place.z), 'yaw': yaw}

    def _cancel(self, handle):
        if self._handle is not None and handle.goal_id == self._handle.goal_id:
            self._flight.cancel()
        return CancelResponse.ACCEPT

    def _end(self, end):
        handle, future = self._handle, self._future
        self._handle = self._future = None
        if end.reason:
            self.get_logger().warning(end.reason)
        if end.outcome == 'succeeded':
            handle.succeed()
        elif end.outcome == 'canceled':
            handle.canceled()
        else:
            handle.abort()
        future.set_result(end)

    def _step(self):
        now = self._now()
        setpoint = self._flight.step(now)
        if setpoint is not None:
            self._modes.publish(OffboardControlMode(timestamp=self._stamp(), position=True))
            self._setpoints.publish(
                TrajectorySetpoint(
                    timestamp=self._stamp(),
                    position=[float(each) for each in setpoint.position],
                    velocity=[_NAN] * 3,
                    acceleration=[_NAN] * 3,
                    jerk=[_NAN] * 3,
                    yaw=float(setpoint.yaw),
                    yawspeed=_NAN,
                )
            )
        if self._handle is not None and now - self._fed_back >= _FEEDBACK:
            self._feed_back(now)

    def _feed_back(self, now):
        told = self._flight.feedback
        if told is None:
            return
        self._fed_back = now
        place, distance = told
        x, y, z = place if self._frame == 'ned' else to_ned(*place)
        point = Point(x=float(x), y=float(y), z=float(z))
        message = self._interface.Feedback(position=point, distance=float(distance))
        self._handle.publish_feedback(message)

    def _command(self, command, **values):
        self._commands.publish(
            VehicleCommand(
                timestamp=self._stamp(),
                command=command,
                target_system=self._system,
                target_component=1,
                source_system=self._system,
                source_component=1,
                from_external=True,
                **values,
            )
        )


def run(servers, topics, args=None):
    """Run the node until a signal comes."""
    rclpy.init(args=args)
    try:
        rclpy.spin(OffboardNode(servers, topics))
    except StartError as error:
        rclpy.logging.get_logger('px4_offboard').fatal(str(error))
        raise SystemExit(1) from None
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
