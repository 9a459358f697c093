"""Sends pings to nodes and takes the time until they answer; lines of JSON say what to do.

It runs in the environment with ROS 2: `{"connect": ["/a"]}` waits until the nodes in these
namespaces have answered once, `{"rounds": 1000}` sends so many pings to all of them, each when the
last one is answered. Each is answered with a line: the seconds it took, of each round.
"""

import json
import sys
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

PATIENCE = 240
"""How long an answer may take, in seconds."""


class Driver(Node):
    """Has a ping and a pong for each node."""

    def __init__(self):
        super().__init__("driver")
        self.pings = []
        self.answers = 0

    def connect(self, spaces):
        """Send pings until all of them have answered one, and let no answer be on its way then."""
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
        """Send a ping to all, and wait for all answers."""
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
        """Take what comes for a while."""
        end = time.perf_counter() + seconds
        while (left := end - time.perf_counter()) > 0:
            rclpy.spin_once(self, timeout_sec=left)


def main():
    """Do what the lines of standard input say."""
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
