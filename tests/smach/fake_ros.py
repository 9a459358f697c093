"""A ROS in one process: rospy, actionlib and the classes of messages, driven by a test."""

from __future__ import annotations

import keyword
import threading
import time
from collections import defaultdict
from collections.abc import Iterable
from types import ModuleType, SimpleNamespace
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.ir import Array, Field, Named, Primitive, System

WAIT = 60.0


class GoalStatus:
    PENDING, ACTIVE, PREEMPTED, SUCCEEDED, ABORTED, REJECTED = range(6)
    PREEMPTING, RECALLING, RECALLED, LOST = range(6, 10)


class CommState:
    PENDING, DONE = 1, 7


class Duration:
    __slots__ = ("secs",)

    def __init__(self, secs: float = 0.0, nsecs: int = 0) -> None:
        self.secs = secs + nsecs / 1e9

    def to_sec(self) -> float:
        return self.secs

    def is_zero(self) -> bool:
        return self.secs == 0.0

    def to_nsec(self) -> int:
        return round(self.secs * 1e9)

    def __add__(self, other: Any) -> Any:
        return type(other)(self.secs + other.secs)

    def __sub__(self, other: Duration) -> Duration:
        return Duration(self.secs - other.secs)

    def __mul__(self, factor: float) -> Duration:
        return Duration(self.secs * factor)

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, Duration):
            return self.secs / other.secs
        return Duration(self.secs / other)

    def __neg__(self) -> Duration:
        return Duration(-self.secs)

    def __abs__(self) -> Duration:
        return Duration(abs(self.secs))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self.secs == other.secs

    def __hash__(self) -> int:
        return hash(self.secs)

    def __lt__(self, other: Duration) -> bool:
        return self.secs < other.secs

    def __le__(self, other: Duration) -> bool:
        return self.secs <= other.secs

    def __gt__(self, other: Duration) -> bool:
        return self.secs > other.secs

    def __ge__(self, other: Duration) -> bool:
        return self.secs >= other.secs


class Time(Duration):
    __slots__ = ()

    clock = staticmethod(time.monotonic)

    def __bool__(self) -> bool:
        return self.secs != 0.0

    @staticmethod
    def now() -> Time:
        return Time(Time.clock())

    def __add__(self, other: Duration) -> Time:
        return Time(self.secs + other.secs)


class ServiceException(Exception):  # noqa: N818 - rospy's name
    pass


class ROSException(Exception):  # noqa: N818 - rospy's name
    pass


class Call:
    """A goal or a request that a server works on; the test ends it."""

    def __init__(self, name: str, content: Any, deaf: bool) -> None:
        self.name = name
        self.content = content
        self.deaf = deaf
        self.cancelled = False
        self.status: int | None = None
        self.result: Any = None
        self.ended = threading.Event()
        self.on_done: Any = None

    def end(self, status: int, result: Any) -> None:
        self.status, self.result = status, result
        self.ended.set()
        if self.on_done is not None:
            threading.Thread(target=self.on_done, args=(status, result), daemon=True).start()


def field_name(name: str) -> str:
    """A field's name in Python, as genpy makes it."""
    return f"{name}_" if keyword.iskeyword(name) or name == "self" else name


def spread(fields: dict[str, Any]) -> dict[str, Any]:
    """Messages that are dictionaries as objects."""
    return {
        name: SimpleNamespace(**spread(value)) if isinstance(value, dict) else value
        for name, value in fields.items()
    }


def fill(message: Any, values: list[dict[str, Any]]) -> None:
    """Fill a message as `genpy.message.fill_message_args` does from one dict."""
    for field, value in values[0].items():
        if isinstance(value, dict):
            fill(getattr(message, field), [value])
        else:
            setattr(message, field, value)


class World:
    """Environment of the machine under test.

    A call waits until the test ends it, unless `answers` has an outcome for it. A server in
    `deaf` goes on when it is cancelled.
    """

    def __init__(self, system: System) -> None:
        self.system = system
        self.params: dict[str, Any] = {}
        self.answers: dict[str, list[str]] = defaultdict(list)
        self.deaf: set[str] = set()
        self.log: list[tuple[str, str]] = []
        self.calls: list[Call] = []
        self.sent: list[tuple[str, Any]] = []
        self.modules: dict[str, ModuleType] = {}
        self.ended = threading.Event()
        self._active: dict[str, Call] = {}
        self._subscribers: dict[str, list[Any]] = defaultdict(list)
        self._changed = threading.Condition()
        self._define_rospy()
        self._define_messages()

    # ---- what a test does

    def publish(self, topic: str, **fields: Any) -> None:
        """Send a message to those who listen now."""
        subscribers = list(self._subscribers[topic])
        assert subscribers, f"nobody listens to {topic}"
        for type_, callback in subscribers:
            callback(type_(**fields))

    def wait_for(self, name: str) -> Call:
        """The call of this action or service, when it comes."""
        with self._changed:
            assert self._changed.wait_for(lambda: name in self._active, WAIT), (
                f"{name} is not called; so far: {self.log}"
            )
            return self._active[name]

    def finish(self, name: str, outcome: str = "succeeded", **fields: Any) -> None:
        """End the running call of this name when it has come."""
        call = self.wait_for(name)
        self._end(call, outcome, fields)

    def wait_until(self, test: Any, what: str) -> None:
        """Wait for something to become true."""
        end = time.monotonic() + WAIT
        while not test():
            assert time.monotonic() < end, f"{what}; so far: {self.log}"
            time.sleep(0.002)

    def called(self) -> list[str]:
        """The names of all calls so far."""
        return [name for what, name in self.log if what == "call"]

    # ---- what the machine does

    def start(self, call: Call) -> None:
        with self._changed:
            self.log.append(("call", call.name))
            self.calls.append(call)
            self._active[call.name] = call
            self._changed.notify_all()
        if self.answers[call.name]:
            self._end(call, self.answers[call.name].pop(0), {})

    def cancel(self, call: Call) -> None:
        with self._changed:
            call.cancelled = True
            self.log.append(("cancel", call.name))
        if not call.deaf:
            self._end(call, "preempted", {})

    def _end(self, call: Call, outcome: str, fields: dict[str, Any]) -> None:
        status = {
            "succeeded": GoalStatus.SUCCEEDED,
            "aborted": GoalStatus.ABORTED,
            "preempted": GoalStatus.PREEMPTED,
        }[outcome]
        with self._changed:
            if self._active.get(call.name) is not call:
                return
            del self._active[call.name]
            self.log.append((outcome, call.name))
            self._changed.notify_all()
        call.end(status, call.content.result_class(**fields))

    # ---- modules

    def _module(self, name: str, **members: Any) -> ModuleType:
        parent, _, child = name.rpartition(".")
        if name not in self.modules:
            self.modules[name] = module = ModuleType(name)
            module.__path__ = []
            if parent:
                setattr(self._module(parent), child, module)
        vars(self.modules[name]).update(members)
        return self.modules[name]

    def _define_rospy(self) -> None:
        world = self
        hooks: list[Any] = []

        class Subscriber:
            def __init__(self, topic, type_, callback=None, callback_args=None):
                world._subscribers[topic].append((type_, callback))

        class Publisher:
            def __init__(self, topic, type_, latch=False, queue_size=None):
                assert queue_size
                self.topic = topic

            def publish(self, message):
                with world._changed:
                    world.sent.append((self.topic, message))
                    world.log.append(("send", self.topic))

        class ServiceProxy:
            def __init__(self, name, spec):
                self.name = name

            def __call__(self, request):
                call = Call(self.name, request, deaf=True)
                world.start(call)
                call.ended.wait()
                if call.status != GoalStatus.SUCCEEDED:
                    raise ServiceException(self.name)
                return call.result

        class Goal:
            """The handle of a goal, which is its own list of known goals too."""

            def __init__(self, call, transition_cb):
                self.call = call
                call.on_done = lambda *_: transition_cb(self)
                self.comm_state_machine = self.action_goal = self.goal_id = self
                self.id = id(self)

            def get_comm_state(self):
                return CommState.PENDING if self.call.status is None else CommState.DONE

            def get_terminal_state(self):
                return self.call.status

            def get_result(self):
                return self.call.result

            def cancel(self):
                world.cancel(self.call)

        class ActionClient:
            def __init__(self, name, spec):
                self.name = name
                self.goal: Goal | None = None

            def wait_for_server(self, timeout):
                return True

            def send_goal(self, goal, transition_cb):
                call = Call(self.name, goal, self.name in world.deaf)
                self.goal = Goal(call, transition_cb)
                world.start(call)
                return self.goal

            @property
            def last_status_msg(self):
                return SimpleNamespace(status_list=[self.goal])

        def get_param(name, *default):
            return world.params.get(name, *default) if default else world.params[name]

        def nothing(*arguments):
            pass

        def logerr(text, *arguments):
            world.log.append(("error", text % arguments if arguments else text))

        def end(reason):
            world.log.append(("shutdown", reason))
            world.ended.set()

        core = self._module("rospy.core", _in_shutdown=False)
        self._module(
            "rospy",
            Time=Time,
            Duration=Duration,
            Subscriber=Subscriber,
            Publisher=Publisher,
            ServiceProxy=ServiceProxy,
            ServiceException=ServiceException,
            ROSException=ROSException,
            wait_for_service=nothing,
            get_param=get_param,
            get_name=lambda: "/robot_7/work",
            get_namespace=lambda: world.params.get("namespace", "/robot_7/"),
            has_param=world.params.__contains__,
            get_rostime=Time.now,
            init_node=lambda name, disable_signals: None,
            on_shutdown=hooks.append,
            resolve_name=lambda name: name,
            spin=lambda: self.ended.wait(WAIT),
            signal_shutdown=end,
            is_shutdown=self.ended.is_set,
            loginfo=nothing,
            logwarn=nothing,
            logdebug=nothing,
            logerr=logerr,
            logfatal=logerr,
            core=core,
        )
        self._module("roslib", load_manifest=nothing)
        self._module("genpy.message", fill_message_args=fill)
        # The real smach_ros imports the simple client, for parts of it that are not used here.
        self._module("actionlib", ActionClient=ActionClient, CommState=CommState)
        self._module(
            "actionlib.simple_action_client", SimpleActionClient=None, GoalStatus=GoalStatus
        )
        self._module("actionlib_msgs.msg", GoalStatus=GoalStatus)
        # What the real smach_ros imports for parts of it that are not used here.
        self._module("actionlib.simple_action_server", SimpleActionServer=None)
        self._module("rostopic")
        self._module("std_msgs.msg", Header=None)
        parts = ("ContainerStatus", "ContainerInitialStatusCmd", "ContainerStructure")
        self._module("smach_msgs.msg", **{f"Smach{part}": None for part in parts})

    def _define_messages(self) -> None:
        """A class for every type that the model describes or names."""
        for interface in (*self.system.interfaces, *envelopes_of(self.system).values()):
            package = interface.type.package
            match interface:
                case ir.Message(fields=fields):
                    self.message(package, interface.type.name, fields)
                case ir.Service(request=request, response=response):
                    self._service(package, interface.type.name, request, response)
                case ir.Action(goal=goal, result=result):
                    self._action(package, interface.type.name, goal, result)
        for function in self.system.functions:
            call = function.communication
            if self.system.interface(call.type) is None:
                define = self._service if call.paradigm == "service" else self._action
                define(call.type.package, call.type.name, None, None)
        for machine in self.system.machines:
            for item in (*machine.params, *machine.variables):
                type_ = item.type.element if isinstance(item.type, Array) else item.type
                if isinstance(type_, Named) and self.system.interface(type_) is None:
                    self.message(type_.package, type_.name, None)
        for event in self.system.events:
            if isinstance(event.type, Named) and self.system.interface(event.type) is None:
                self.message(event.type.package, event.type.name, None)

    def message(
        self, package: str, name: str, fields: Iterable[Field] | None, kind: str = "msg"
    ) -> type:
        """Make a message class that takes its fields by name and nothing else.

        With None for the fields they are not known, and it takes any.
        """
        world, types = self, {field_name(field.name): field.type for field in fields or ()}

        def __init__(message: Any, /, **values: Any) -> None:  # noqa: N807
            unknown = values.keys() - types.keys()
            assert fields is None or not unknown, f"{name} has no field {unknown}"
            given = values if fields is not None else {**spread(known), **values}
            for field in given.keys() - types.keys():
                setattr(message, field, given[field])
            for field, type_ in types.items():
                value = values[field] if field in values else world.default(type_)
                setattr(message, field, value)

        known = {} if fields is not None else default_value(Named(package, name), self.system)
        slots = tuple(types) if fields is not None else ("__dict__",)
        # Slots as genpy makes them: smach wraps what has a `__dict__` to keep it constant.
        members = {
            "__init__": __init__,
            "__slots__": slots,
            "_slot_types": tuple(str(type_) for type_ in types.values()),
            "result_class": None,
        }
        class_ = type(name, (), members)
        self._module(f"{package}.{kind}", **{name: class_})
        return class_

    def default(self, type_: Any) -> Any:
        """The default value of a field."""
        match type_:
            case Named(package=package, name=name):
                module = self.modules.get(f"{package}.msg")
                class_ = getattr(module, name, None) or self.message(package, name, None)
                return class_()
            case Array(element=element, size=int(size), bounded=False):
                return [self.default(element) for _ in range(size)]
            case Array():
                return []
            case Primitive(name="string"):
                return ""
            case Primitive(name="bool"):
                return False
            case Primitive(name="duration"):
                return Duration()
            case Primitive(name="time"):
                return Time()
            case Primitive(name="float32" | "float64"):
                return 0.0
        return 0

    def _service(self, package: str, name: str, request: Any, response: Any) -> None:
        request_class = self.message(package, f"{name}Request", request, "srv")
        request_class.result_class = self.message(package, f"{name}Response", response, "srv")
        spec = type(name, (), {"_request_class": request_class})
        self._module(f"{package}.srv", **{name: spec})

    def _action(self, package: str, name: str, goal: Any, result: Any) -> None:
        goal_class = self.message(package, f"{name}Goal", goal)
        goal_class.result_class = self.message(package, f"{name}Result", result)

        class Wrapped:
            def __init__(self, **inner: Any) -> None:
                vars(self).update(inner)

        def spec() -> Wrapped:
            return Wrapped(
                action_goal=Wrapped(goal=goal_class()),
                action_result=Wrapped(result=goal_class.result_class()),
            )

        self._module(f"{package}.msg", **{f"{name}Action": spec})
