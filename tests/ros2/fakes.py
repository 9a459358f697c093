"""Servers and other robots for generated nodes: a ROS process that does what lines of JSON say.

Runs in the environment with ROS. Commands come on standard input, what happens goes to standard
output; `harness.py` says what there is.
"""

import json
import sys
import threading
import time
from importlib import import_module

import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock

_STEP = 0.01
# A subscription is known before it knows its publishers itself, in seconds.
_KNOWN = 0.3


class Fakes(Node):
    """Has servers, publishers and subscriptions as it is told."""

    def __init__(self):
        super().__init__("fakes")
        self.group = ReentrantCallbackGroup()
        self.servers = {}
        self.topics = {}
        self.open = {}
        self.lock = threading.Lock()

    def tell(self, **what):
        with self.lock:
            sys.stdout.write(json.dumps(what) + "\n")
            sys.stdout.flush()

    def obey(self, line):
        getattr(self, "do_" + line.pop("do"))(**line)

    def do_action(self, name, kind, script, stopping=0.0):
        calls = iter(range(10**6))

        def accept(goal):
            number = next(calls)
            plan = dict(script[min(number, len(script) - 1)])
            self.tell(goal=name, number=number, data=plain(goal))
            time.sleep(plan.get("hesitates", 0.0))
            plans.append(plan)
            return GoalResponse.REJECT if plan["outcome"] == "reject" else GoalResponse.ACCEPT

        def cancel(handle):
            self.tell(cancel=name)
            return CancelResponse.ACCEPT if stopping is not None else CancelResponse.REJECT

        def execute(handle):
            plan = plans[-1]
            self.tell(begun=name)
            for values in plan.get("feedback", ()):
                handle.publish_feedback(fill(made.Feedback(), values))
            end = time.monotonic() + plan.get("after", 0.0)
            while plan["outcome"] == "never" or time.monotonic() < end:
                if handle.is_cancel_requested:
                    time.sleep(stopping)
                    self.tell(stopped=name)
                    handle.canceled()
                    return made.Result()
                if not handle.is_active:
                    return made.Result()
                time.sleep(_STEP)
            result = fill(made.Result(), plan.get("result", {}))
            vary(result, plan.get("vary"))
            if plan["outcome"] == "succeeded":
                handle.succeed()
            elif plan["outcome"] == "canceled":
                handle.canceled()
            else:
                handle.abort()
            return result

        plans = self.open[name] = []
        made = interface(kind)
        self.servers[name] = ActionServer(
            self,
            made,
            name,
            execute_callback=execute,
            goal_callback=accept,
            cancel_callback=cancel,
            callback_group=self.group,
        )

    def do_service(self, name, kind, script):
        calls = iter(range(10**6))

        def respond(request, response):
            number = next(calls)
            plan = dict(script[min(number, len(script) - 1)])
            plans.append(plan)
            self.tell(request=name, number=number, data=plain(request))
            time.sleep(plan.get("after", 0.0))
            while plan["outcome"] == "never":
                time.sleep(_STEP)
            vary(response, plan.get("vary"))
            if plan["outcome"] == "succeeded" and hasattr(response, "success"):
                response.success = True
            return fill(response, plan.get("result", {}))

        plans = self.open[name] = []
        self.servers[name] = self.create_service(
            interface(kind), name, respond, callback_group=self.group
        )

    def do_finish(self, name, outcome, number):
        """End the goals and requests that wait for it, with values that depend on a number."""
        for plan in self.open[name]:
            if plan["outcome"] == "never":
                plan.update(outcome=outcome, vary=number)

    def do_gone(self, name):
        server = self.servers.pop(name)
        if isinstance(server, ActionServer):
            server.destroy()
        else:
            self.destroy_service(server)

    def do_publisher(self, topic, kind, depth=10, reliable=True):
        reliability = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
        qos = QoSProfile(depth=depth, reliability=reliability)
        self.topics[topic] = self.create_publisher(interface(kind), topic, qos)

    def do_publish(self, topic, data, number=None):
        publisher = self.topics[topic]
        publisher.publish(fill(vary(publisher.msg_type(), number), data))

    def do_burst(self, topic, field, count, size):
        """Publish lists one right after the other, each with its number and zeros after it."""
        publisher = self.topics[topic]
        for number in range(count):
            message = publisher.msg_type()
            setattr(message, field, [number] + [0] * (size - 1))
            publisher.publish(message)
        self.tell(burst=topic)

    def do_clock(self, time):
        if "/clock" not in self.topics:
            self.topics["/clock"] = self.create_publisher(Clock, "/clock", 1)
            wait_for(self.topics["/clock"])
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(time, 10**9)
        self.topics["/clock"].publish(message)

    def do_subscribe(self, topic, kind, latched=False):
        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        self.create_subscription(
            interface(kind),
            topic,
            lambda message: self.tell(message=topic, data=plain(message)),
            QoSProfile(depth=100, durability=durability),
            callback_group=self.group,
        )

    def do_call(self, name, kind, data):
        """Call a service, and tell what it responds."""
        made = interface(kind)
        client = self.create_client(made, name, callback_group=self.group)
        client.wait_for_service(60)
        future = client.call_async(fill(made.Request(), data))
        future.add_done_callback(lambda done: self.tell(called=name, data=plain(done.result())))

    def do_listeners(self, topics, count):
        """Wait until so many listen to each topic, and know of who publishes there."""
        for topic in topics:
            wait_for(self.topics[topic], count)
        time.sleep(_KNOWN)
        self.tell(listeners=topics)


def wait_for(publisher, count=1):
    end = time.monotonic() + 30
    while publisher.get_subscription_count() < count and time.monotonic() < end:
        time.sleep(_STEP)


def interface(name):
    package, kind, name = name.split("/")
    return getattr(import_module(f"{package}.{kind}"), name)


def fill(message, values):
    for name, value in values.items():
        held = getattr(message, name)
        setattr(message, name, fill(held, value) if isinstance(value, dict) else value)
    return message


def vary(message, number):
    """Fill in values that depend on a number, if there is one."""
    if number is not None:
        for name in message.get_fields_and_field_types():
            held = getattr(message, name)
            if isinstance(held, bool):
                setattr(message, name, number % 2 == 0)
            elif isinstance(held, (int, float)):
                setattr(message, name, type(held)((1, 30, 0, 100)[number % 4]))
            elif isinstance(held, str):
                setattr(message, name, f"n{number % 2}")
            elif hasattr(held, "get_fields_and_field_types"):
                vary(held, number)
    return message


def plain(value):
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes):
        return list(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    return [plain(each) for each in value] if isinstance(value, list) else value


def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = Fakes()
    executor = MultiThreadedExecutor(num_threads=64)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    node.tell(ready=True)
    for line in sys.stdin:
        node.obey(json.loads(line))
    executor.shutdown(timeout_sec=1)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
