"""Asks the nodes of a graph of ROS 2 for what they offer; prints what came of it as JSON.

Run by the Python that has ROS 2, with what to ask: `skeletons` that are not implemented, or
nodes that are `filled` in with the code of this folder.
"""

import contextlib
import json
import os
import signal
import sys
import threading
import time

import demo.action
import demo.msg
import demo.srv
import rclpy
import std_msgs.msg
from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

STATES = {value: name[7:] for name, value in vars(GoalStatus).items() if name[:7] == "STATUS_"}
PATIENCE = 60


def wait(test):
    """Wait until something is true."""
    limit = time.monotonic() + PATIENCE
    while not test():
        assert time.monotonic() < limit
        time.sleep(0.02)


class Client:
    """A node that is spun in a thread of its own."""

    def __init__(self):
        self.node = rclpy.create_node("client")
        self.climb = ActionClient(self.node, demo.action.Climb, "cmd/climb")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self._spin)
        self.thread.start()
        assert self.climb.wait_for_server(PATIENCE)

    def _spin(self):
        with contextlib.suppress(ExternalShutdownException):
            self.executor.spin()

    def send(self, height, heard=None):
        goal = demo.action.Climb.Goal(height=height)
        listen = None if heard is None else (lambda m: heard.append(m.feedback.now))
        future = self.climb.send_goal_async(goal, feedback_callback=listen)
        wait(future.done)
        assert future.result().accepted
        return future.result()

    def end(self, handle):
        future = handle.get_result_async()
        wait(future.done)
        answer = future.result()
        return [STATES[answer.status], answer.result.reached]

    def goal(self, height, cancel=False):
        heard = []
        handle = self.send(height, heard)
        if cancel:
            time.sleep(0.3)
            handle.cancel_goal_async()
        return [*self.end(handle), heard]

    def ask(self, name, type_, **request):
        client = self.node.create_client(type_, name)
        assert client.wait_for_service(PATIENCE)
        future = client.call_async(type_.Request(**request))
        wait(lambda: future.done() or not client.service_is_ready())
        if not future.done():
            return None
        answer = future.result()
        return {field: getattr(answer, field) for field in answer.get_fields_and_field_types()}

    def heard(self, topic, type_, to, message):
        """The first message on a topic after another was published again and again."""
        found = []
        self.node.create_subscription(type_, topic, found.append, 10)
        publisher = self.node.create_publisher(type(message), to, 10)

        def came():
            publisher.publish(message)
            time.sleep(0.05)
            return bool(found)

        wait(came)
        return found[0]


def main(what, *process):
    rclpy.init()
    client = Client()
    if what == "stopped":
        handle = client.send(3.0)
        os.kill(int(*process), signal.SIGTERM)
        said = client.end(handle)
    else:
        said = ask_all(client, what)
    sys.stdout.write(json.dumps(said) + "\n")
    sys.stdout.flush()
    rclpy.shutdown()
    client.thread.join()


def ask_all(client, what):
    said = {
        "beep": client.ask("cmd/beep", demo.srv.Beep, times=2),
        "snap": client.ask("camera/snap", demo.srv.CameraSnap, zoom=1.0),
    }
    if what == "skeletons":
        said["goal"] = client.goal(1.0)
    else:
        sample = demo.msg.Sample
        exposure = client.node.create_publisher(std_msgs.msg.Float64, "exposure", 10)
        wait(lambda: exposure.get_subscription_count() > 0)
        exposure.publish(std_msgs.msg.Float64(data=0.0))  # which the node stumbles over
        seen = client.heard("target_found", sample, "exposure", std_msgs.msg.Float64(data=2.0))
        position = client.heard("pos/goal_position", sample, "state", sample(code=7))
        replaced = client.send(3.0)
        said.update(
            seen=list(seen.value),
            position=position.code,
            zoomed=client.ask("camera/snap", demo.srv.CameraSnap, zoom=11.0),
            stumbled=client.ask("camera/snap", demo.srv.CameraSnap, zoom=100.0),
            reached=client.goal(1.0),
            replaced=client.end(replaced),
            raised=client.goal(2.0),
            cancelled=client.goal(3.0, cancel=True),
            nothing=client.goal(4.0),
            wrong=client.goal(5.0),
        )
    return said


if __name__ == "__main__":
    main(*sys.argv[1:])
