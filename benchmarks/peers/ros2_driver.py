"""Send pings to nodes and measure the time of their answers.

Runs in the environment of ROS 2. Reads JSON lines: `{"connect": ["/a"]}` waits until the nodes in
these namespaces have answered once; `{"rounds": 1000}` sends this number of pings to all nodes,
each after the last one is answered. Each line is answered with a line: the seconds of each round.
"""

import json
import sys
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

PATIENCE = 240
"""Timeout of an answer in seconds."""


class Driver(Node):
    """Node with a ping publisher and a pong subscription for each measured node."""

    def __init__(self):
        super().__init__("driver")
        self.pings = []
        self.answers = 0

    def connect(self, spaces):
        """Ping all nodes until each has answered, then wait until no answer is on its way."""
        missing = set(spaces)

        def hear(space):
            missing.discard(space)
            self.answers += 1

        for space in spaces:
            self.pings.append(self.create_publisher(Empty, f"{space}/ping", 10))
            self.create_subscription(Empty, f"{space}/pong", lambda _, s=space: hear(s), 10)
        start = time.perf_counter()
        while missing:
            if time.perf_counter() - start > PATIENCE:
                raise TimeoutError(f"{missing} are not there")
            for ping, space in zip(self.pings, spaces, strict=True):
                if space in missing:
                    ping.publish(Empty())
            self.spin(0.1)
        taken = time.perf_counter() - start
        self.spin(1.0 if spaces else 0.0)
        return taken

    def round(self):
        """Ping all nodes and wait for all answers."""
        wanted = self.answers = 0
        start = time.perf_counter()
        for ping in self.pings:
            ping.publish(Empty())
            wanted += 1
        while self.answers < wanted:
            if time.perf_counter() - start > PATIENCE:
                raise TimeoutError(f"{self.answers} of {wanted} have answered")
            rclpy.spin_once(self, timeout_sec=1)
        return time.perf_counter() - start

    def spin(self, seconds):
        """Process callbacks for some seconds."""
        end = time.perf_counter() + seconds
        while (left := end - time.perf_counter()) > 0:
            rclpy.spin_once(self, timeout_sec=left)


def main():
    """Execute the commands on standard input."""
    rclpy.init()
    driver = Driver()
    for line in sys.stdin:
        wanted = json.loads(line)
        if "connect" in wanted:
            found = [driver.connect(wanted["connect"])]
        else:
            found = [driver.round() for _ in range(wanted["rounds"])]
        print(json.dumps(found), flush=True)


if __name__ == "__main__":
    main()
