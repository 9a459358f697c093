"""Autopilots with PX4 as nodes, and clients of the functions that fly them.

A line of JSON on the input is an order, `{"do": "goal", "number": 1, ...}`; a line on the output
says what has happened.
"""

from __future__ import annotations

import json
import math
import sys
import threading
from typing import Any

import px4_offboard_msgs.action as actions
import rclpy
from autopilot import Autopilot
from geometry_msgs.msg import PoseStamped
from px4_msgs.msg import (
    OffboardControlMode,
    TrajectorySetpoint,
    VehicleCommand,
    VehicleCommandAck,
    VehicleLandDetected,
    VehicleLocalPosition,
    VehicleStatus,
)
from rclpy.action import ActionClient
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

_STEP = 0.02
# As the client of XRCE-DDS of PX4 has its writers and readers.
_OUT = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
_IN = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    durability=DurabilityPolicy.VOLATILE,
)
_lock = threading.Lock()


def tell(**what: Any) -> None:
    with _lock:
        sys.stdout.write(json.dumps(what) + "\n")
        sys.stdout.flush()


class Vehicle(Node):
    """An autopilot in its namespace; clients of the functions are in that of the robot."""

    def __init__(self, system: int, space: str, robot: str) -> None:
        super().__init__(f"autopilot_{system}", namespace=space)
        self.robot = robot
        self.pilot = Autopilot(self.answer, system)
        self.told: Any = None
        self.counted = 0
        self.handles: dict[str, Any] = {}
        self.status, self.position, self.landing, self.answers = (
            self.create_publisher(kind, f"fmu/out/{name}", _OUT)
            for kind, name in (
                (VehicleStatus, "vehicle_status_v1"),
                (VehicleLocalPosition, "vehicle_local_position"),
                (VehicleLandDetected, "vehicle_land_detected"),
                (VehicleCommandAck, "vehicle_command_ack"),
            )
        )
        for kind, name, hear in (
            (OffboardControlMode, "offboard_control_mode", self.hear_mode),
            (TrajectorySetpoint, "trajectory_setpoint", self.hear_setpoint),
            (VehicleCommand, "vehicle_command", self.hear_command),
        ):
            self.create_subscription(kind, f"fmu/in/{name}", hear, _IN)
        self.mode_at = -math.inf
        self.create_timer(_STEP, self.step)

    def hear_mode(self, mode: Any) -> None:
        others = (mode.velocity, mode.acceleration, mode.attitude, mode.body_rate)
        assert mode.position
        assert not any(others)
        assert mode.timestamp > 0
        self.mode_at = self.pilot.now

    def hear_setpoint(self, setpoint: Any) -> None:
        assert all(map(math.isnan, setpoint.velocity))
        if self.pilot.now - self.mode_at < 0.5:  # both have to come
            self.counted += 1
            self.pilot.hear_setpoint(list(map(float, setpoint.position)), setpoint.yaw)

    def hear_command(self, command: Any) -> None:
        assert command.from_external
        assert command.timestamp > 0
        self.pilot.hear_command(command)

    def answer(self, command: int, result: int) -> None:
        self.answers.publish(VehicleCommandAck(command=command, result=result))

    def step(self) -> None:
        self.pilot.step(_STEP)
        self.status.publish(VehicleStatus(**self.pilot.status()))
        self.position.publish(VehicleLocalPosition(**self.pilot.position()))
        self.landing.publish(VehicleLandDetected(landed=self.pilot.landed))
        state = {
            "mode": self.pilot.mode,
            "armed": self.pilot.armed,
            "failsafe": self.pilot.failsafe,
        }
        if state != self.told:
            self.told = state
            tell(vehicle=self.pilot.system, **state)


class Clients(Node):
    """Clients of the functions of all robots."""

    def __init__(self, vehicles: dict[int, Vehicle]) -> None:
        super().__init__("clients")
        self.vehicles = vehicles
        self.made: dict[tuple[int, str], Any] = {}

    def client(self, system: int, action: str, name: str) -> Any:
        if (system, name) not in self.made:
            robot = self.vehicles[system].robot
            kind = getattr(actions, action)
            self.made[system, name] = ActionClient(self, kind, f"{robot}/{name}")
        return self.made[system, name]

    def do_goal(self, number: int, system: int, action: str, name: str, data: Any) -> None:
        goal = getattr(actions, action).Goal()
        if action == "GoTo":
            goal.pose = pose(**{name: float(value) for name, value in data.items()})
        elif action == "Hold":
            goal.time.sec = data["time"]
        elif action == "TakeOff":
            goal.altitude = data["altitude"]

        def fed(message: Any) -> None:
            place = message.feedback.position
            tell(feedback=number, place=[place.x, place.y, place.z])

        def accepted(future: Any) -> None:
            handle = future.result()
            self.vehicles[system].handles[str(number)] = handle
            tell(accepted=number)
            handle.get_result_async().add_done_callback(ended)

        def ended(future: Any) -> None:
            result = future.result()
            code, why = result.result.error_code, result.result.error_msg
            tell(ended=number, status=result.status, code=code, why=why)

        client = self.client(system, action, name)
        assert client.wait_for_server(30)
        client.send_goal_async(goal, feedback_callback=fed).add_done_callback(accepted)

    def do_cancel(self, number: int, system: int) -> None:
        self.vehicles[system].handles[str(number)].cancel_goal_async()

    def do_set(self, system: int, **values: Any) -> None:
        for name, value in values.items():
            setattr(self.vehicles[system].pilot, name, value)
        tell(set=system)

    def do_ask(self, system: int) -> None:
        vehicle = self.vehicles[system]
        pilot = vehicle.pilot
        tell(
            asked=system,
            place=pilot.place,
            yaw=None if math.isnan(pilot.yaw) else pilot.yaw,
            gaps=pilot.gaps,
            commands=pilot.commands,
            setpoints=vehicle.counted,
        )


def pose(x: float, y: float, z: float, yaw: float | None = None) -> PoseStamped:
    made = PoseStamped()
    made.pose.position.x, made.pose.position.y, made.pose.position.z = x, y, z
    made.pose.orientation.w = 0.0
    if yaw is not None:
        made.pose.orientation.z, made.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


def main() -> None:
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    vehicles = {
        int(system): Vehicle(int(system), space, robot)
        for system, space, robot in (each.split(",") for each in sys.argv[1:])
    }
    clients = Clients(vehicles)
    executor = MultiThreadedExecutor(num_threads=8)
    for node in (clients, *vehicles.values()):
        executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    tell(ready=True)
    for line in sys.stdin:
        order = json.loads(line)
        getattr(clients, f"do_{order.pop('do')}")(**order)
    executor.shutdown(timeout_sec=1)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
