"""The others in a ROS graph: servers and publishers that a test drives by a line of JSON each.

Run by the Python that has ROS. Lines come from standard input; what happens is told on standard
output. A server works on a goal or a request until the test ends it, unless its `answers` has an
outcome for it; a `deaf` one goes on when its goal is cancelled.
"""

import importlib
import json
import sys
import threading
import time

import actionlib
import genpy
import rospy

_told = threading.Lock()


def tell(what, name, content=None, since=None):
    """Tell what happens, and when: now, or when it began."""
    event = {"what": what, "name": name, "content": content, "time": since or time.monotonic()}
    with _told:
        sys.stdout.write(json.dumps(event) + "\n")
        sys.stdout.flush()


def class_of(type_, module):
    package, _, name = type_.partition("/")
    return getattr(importlib.import_module(f"{package}.{module}"), name)


def filled(message, fields):
    if fields:
        genpy.message.fill_message_args(message, [fields])
    return message


def plain(value):
    if isinstance(value, genpy.TVal):
        return value.to_sec()
    if hasattr(value, "__slots__"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value.decode("latin-1") if isinstance(value, bytes) else value


class Server:
    """Base of action and service servers: the end of a call."""

    def __init__(self, name, answers=(), deaf=False):
        self.name = name
        self.answers = list(answers)
        self.deaf = deaf
        self._ended = threading.Condition()
        self._ending = None

    def end(self, outcome, fields):
        with self._ended:
            self._ending = (outcome, fields)
            self._ended.notify_all()

    def work(self, content, is_cancelled):
        """The outcome of a call and the fields of its result, when the test has said them."""
        with self._ended:
            self._ending = (self.answers.pop(0), {}) if self.answers else None
        tell("call", self.name, plain(content))
        told = False
        while not rospy.is_shutdown():
            with self._ended:
                if self._ending is None:
                    self._ended.wait(0.01)
                if self._ending is not None:
                    return self._ending
            if is_cancelled() and not told:
                tell("cancel", self.name)
                told = True
                if not self.deaf:
                    return ("preempted", {})
        return ("aborted", {})


class Action(Server):
    def __init__(self, name, type_, **settings):
        super().__init__(name, **settings)
        spec = class_of(f"{type_}Action", "msg")
        self._result = type(spec().action_result.result)
        self._server = actionlib.SimpleActionServer(name, spec, self._execute, auto_start=False)
        self._server.start()

    def _execute(self, goal):
        outcome, fields = self.work(goal, self._server.is_preempt_requested)
        tell(outcome, self.name)
        ends = {
            "succeeded": self._server.set_succeeded,
            "aborted": self._server.set_aborted,
            "preempted": self._server.set_preempted,
        }
        ends[outcome](filled(self._result(), fields))


class Service(Server):
    def __init__(self, name, type_, **settings):
        super().__init__(name, **settings)
        self._type = class_of(type_, "srv")
        self._service = rospy.Service(name, self._type, self._called)

    def _called(self, request):
        outcome, fields = self.work(request, lambda: False)
        tell(outcome, self.name)
        if outcome != "succeeded":
            raise rospy.ServiceException(outcome)
        response = self._type._response_class()
        if hasattr(response, "success"):
            response.success = True
        return filled(response, fields)


class Publisher:
    def __init__(self, topic, type_):
        self._class = class_of(type_, "msg")
        self._publisher = rospy.Publisher(topic, self._class, queue_size=1000)

    def publish(self, fields, others):
        """Publish when there are more connections than those of `others`: the node listens.

        Gives the time before that.
        """
        end = time.monotonic() + 5
        while self._publisher.get_num_connections() <= others and time.monotonic() < end:
            time.sleep(0.005)
        since = time.monotonic()
        self._publisher.publish(filled(self._class(), fields))
        return since


def main():
    rospy.init_node("peers", anonymous=True, disable_signals=True)
    servers, publishers, heard = {}, {}, {}
    kinds = {"action": Action, "service": Service}
    tell("ready", "")
    for line in sys.stdin:
        order = json.loads(line)
        do, name = order.pop("do"), order.pop("name")
        if do in kinds:
            servers[name] = kinds[do](name, order.pop("type"), **order)
            tell("serves", name)
        elif do == "end":
            servers[name].end(order["outcome"], order["fields"])
        elif do == "publish":
            if name not in publishers:
                publishers[name] = Publisher(name, order["type"])
            since = publishers[name].publish(order["fields"], name in heard)
            tell("published", name, since=since)
        elif do == "listen":
            heard[name] = rospy.Subscriber(
                name,
                class_of(order["type"], "msg"),
                lambda message, name=name: tell("sent", name, plain(message)),
            )
        elif do == "hear":
            while not heard[name].get_num_connections():
                time.sleep(0.005)
            tell("hears", name)
    rospy.signal_shutdown("the test has ended")


if __name__ == "__main__":
    main()
