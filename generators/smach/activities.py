"""The call of a function: a SimpleActionState or a ServiceState."""

from __future__ import annotations

from swarmdsl.dataclass import dataclass, field
from swarmdsl.ir import Activity, Communication, Literal, OutcomeTrigger, State

from .expressions import field_name, keys, python_expression
from .module import CANCELLED, Module
from .python import Call, Source, comments, layout
from .statements import STEP, assign


@dataclass
class _Interface:
    """The keywords of the state's constructor, and the userdata its callbacks need."""

    keywords: list[tuple[str, object]] = field(default_factory=list)
    inputs: list[str] = field(default_factory=list)
    outputs: list[str] = field(default_factory=list)

    def finished(self) -> tuple[tuple[str, object], ...]:
        """All keywords, the keys last."""
        found = [*self.keywords]
        for word, names in (("input_keys", self.inputs), ("output_keys", self.outputs)):
            if names:
                found.append((word, list(dict.fromkeys(names))))
        return tuple(found)


def activity_call(state: State, module: Module) -> tuple[Call, tuple[str, ...]]:
    """The state that calls the function of `state`, and how it can end by itself.

    `cancelled` is how an action ends that its server preempted; it is told from `aborted`
    only where the model does.
    """
    activity = state.activity
    assert activity is not None
    call = module.system.function(activity.function).communication
    module.imports.module("smach_ros")
    interface = _Interface()
    if call.paradigm == "service":
        _fill(state, activity, call, "request", interface, module)
        _store_response(state, activity, interface, module)
        type_ = module.imports.interface(call.type, "srv")
        arguments = (call.name, Source(type_))
        service = Call("smach_ros.ServiceState", arguments, interface.finished())
        return service, ("succeeded", "aborted")
    _fill(state, activity, call, "goal", interface, module)
    cancelled = _handles_preempted(state)
    _store_result(state, activity, interface, module, cancelled)
    keywords = interface.finished()
    if cancelled:
        keywords += (("outcomes", [CANCELLED]),)
    type_ = module.imports.interface(call.type, "msg", "Action")
    action = Call("smach_ros.SimpleActionState", (call.name, Source(type_)), keywords)
    return action, ("succeeded", "aborted", *([CANCELLED] if cancelled else []))


def _handles_preempted(state: State) -> bool:
    return any(
        isinstance(trigger, OutcomeTrigger) and trigger.outcome == "preempted"
        for transition in state.transitions
        for trigger in transition.triggers
    )


def _fill(
    state: State,
    activity: Activity,
    call: Communication,
    word: str,
    interface: _Interface,
    module: Module,
) -> None:
    """Where the content of the goal or request comes from."""
    if activity.goal_callback is not None:
        name = _callback(activity, activity.goal_callback, f"userdata, {word}", interface, module)
        interface.keywords.append((f"{word}_cb", _step(name, module)))
        return
    if not activity.arguments:
        return
    kind = "msg" if word == "goal" else "srv"
    message = Call(
        module.imports.interface(call.type, kind, word.capitalize()),
        (),
        tuple(
            (field_name(name), Source(python_expression(value, module.imports)))
            for name, value in activity.arguments
        ),
    )
    if all(isinstance(value, Literal) for _, value in activity.arguments):
        interface.keywords.append((word, message))
        return
    name = module.add_function(
        (state.id, word),
        f"userdata, {word}",
        [layout(message, 1, f"{STEP}return ")],
        comments(activity.origin),
    )
    interface.keywords.append((f"{word}_cb", _step(name, module)))
    interface.inputs += [key for _, value in activity.arguments for key in keys(value)]


def _store_response(
    state: State, activity: Activity, interface: _Interface, module: Module
) -> None:
    """What becomes of the response of a service, when there was one."""
    if activity.result_callback is not None:
        name = _callback(
            activity, activity.result_callback, "userdata, response", interface, module
        )
    elif activity.results:
        name = module.add_function(
            (state.id, "response"),
            "userdata, response",
            _store(activity, "response", 1, interface, module),
            comments(activity.origin),
        )
    else:
        return
    interface.keywords.append(("response_cb", _step(name, module)))


def _store_result(
    state: State, activity: Activity, interface: _Interface, module: Module, cancelled: bool
) -> None:
    """What becomes of the result of an action; only that of a successful one is stored."""
    parameters = "userdata, status, result"
    body: list[str] = []
    if activity.result_callback is not None:
        callback = _callback(activity, activity.result_callback, parameters, interface, module)
        if not cancelled:
            interface.keywords.append(("result_cb", _aborting(callback, module)))
            return
        body.append(f"{STEP}{callback}({parameters})")
    elif activity.results:
        body.append(f"{STEP}if status == GoalStatus.SUCCEEDED:")
        body += _store(activity, "result", 2, interface, module)
    if cancelled:
        body.append(f"{STEP}if status in (GoalStatus.PREEMPTED, GoalStatus.RECALLED):")
        body += [f"{STEP * 2}return {CANCELLED!r}", f"{STEP}return None"]
    if not body:
        return
    if cancelled or activity.results:
        module.imports.name("actionlib_msgs.msg", "GoalStatus")
    name = module.add_function((state.id, "result"), parameters, body, comments(activity.origin))
    by_user = activity.result_callback is not None
    interface.keywords.append(
        ("result_cb", _aborting(name, module) if by_user else _step(name, module))
    )


def _step(callback: str, module: Module) -> Call:
    return Call(module.own("states", "step"), (Source(callback),))


def _aborting(callback: str, module: Module) -> Call:
    return Call(module.own("states", "aborting"), (Source(callback),))


def _store(
    activity: Activity, source: str, depth: int, interface: _Interface, module: Module
) -> list[str]:
    lines: list[str] = []
    for result in activity.results:
        value = f"{source}.{field_name(result.field)}"
        lines += assign(result.variable, result.path, value, depth, module)
        interface.outputs.append(result.variable)
        interface.inputs += [result.variable] if result.path else []
    return lines


def _callback(
    activity: Activity, name: str, parameters: str, interface: _Interface, module: Module
) -> str:
    """A callback of the user, who may read and write all there is."""
    module.callbacks.append((name, parameters, activity.origin))
    module.imports.name(module.imports.types.package, "callbacks")
    interface.inputs += module.keys
    interface.outputs += module.keys
    return f"callbacks.{name}"
