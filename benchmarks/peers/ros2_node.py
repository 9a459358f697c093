"""Handwritten node with the behaviour of the model in `benchmarks/ros2.py`.

Runs in the environment of ROS 2. With the parameter `tells`, it also publishes its state, on the
same topics and in the log, and its diagnostics, as the generated node always does.
"""

import json
import time

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Empty, String


class Echo(Node):
    """Toggles between A and B with each ping, and answers it."""

    def __init__(self):
        super().__init__("echo")
        tells = self.declare_parameter("tells", False).value
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.tells = tells
        self.place = "A"
        self.began = time.monotonic()
        self.pong = self.create_publisher(Empty, "pong", 10)
        if tells:
            self.state = self.create_publisher(String, "~/state", latched)
            self.transitions = self.create_publisher(String, "~/transitions", latched)
            self.health = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
            self.create_timer(1.0, self.tell_health)
        self.create_subscription(Empty, "ping", self.hear, 10)

    def hear(self, message):
        """Answer and toggle."""
        before, self.place = self.place, "B" if self.place == "A" else "A"
        self.pong.publish(Empty())
        if self.tells:
            line = {
                "t": round((time.monotonic() - self.began) * 1000),
                "event": "Ping",
                "configuration": [self.place],
                "entered": [self.place],
                "exited": [before],
                "sent": ["Pong"],
            }
            self.transitions.publish(String(data=json.dumps(line)))
            self.state.publish(String(data=json.dumps({"configuration": [self.place]})))
            self.get_logger().info(f"Ping -> {self.place}")

    def tell_health(self):
        """Publish the status OK, like diagnostic_updater."""
        status = DiagnosticStatus(name="echo", message=self.place, level=DiagnosticStatus.OK)
        status.values = [KeyValue(key="state", value=self.place)]
        array = DiagnosticArray(status=[status])
        array.header.stamp = self.get_clock().now().to_msg()
        self.health.publish(array)


def main():
    """Run the node until it is interrupted."""
    rclpy.init()
    node = Echo()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
