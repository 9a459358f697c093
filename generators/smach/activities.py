"""Activities: calls of functions as `ActionState` or `ServiceState`."""

from __future__ import annotations

from swarmdsl.codegen.python import Call, Source, comments, layout
from swarmdsl.codegen.shared import sent_types
from swarmdsl.ir import Activity, Communication, Literal, State, bound_of_any

from .expressions import field_name
from .module import Module
from .statements import STEP, assign, kept, within

Keywords = tuple[tuple[str, object], ...]


def activity_call(state: State, keywords: Keywords, module: Module) -> Call:
    """Return the call that makes a state with an activity; `keywords` are further arguments."""
    activity = state.activity
    assert activity is not None
    call = module.system.function(activity.function).communication
    if call.paradigm == "service":
        class_ = module.own("services", "ServiceState")
        type_ = module.imports.interface(call.type, "srv")
        sent, got = "request", "response"
    else:
        class_ = module.own("actions", "ActionState")
        type_ = module.imports.interface(call.type, "msg", "Action")
        sent, got = "goal", "result"
    given = (*_sent(state, activity, call, sent, module), *_got(state, activity, got, module))
    return Call(class_, (call.name, Source(type_)), (*given, *keywords))


def _sent(
    state: State, activity: Activity, call: Communication, word: str, module: Module
) -> Keywords:
    """Return the argument with the goal or request, or the function that fills it."""
    if activity.goal_callback is not None:
        name = _callback(activity, activity.goal_callback, f"userdata, {word}", module)
        return ((f"{word}_cb", Source(name)),)
    if not activity.arguments:
        return ()
    kind = "msg" if word == "goal" else "srv"
    types = sent_types(module.system.interface(call.type))
    message = Call(
        module.imports.interface(call.type, kind, word.capitalize()),
        (),
        tuple(
            (field_name(name), Source(kept(value, types.get(name), module)))
            for name, value in activity.arguments
        ),
    )
    if all(isinstance(value, Literal) for _, value in activity.arguments):
        return ((word, message),)
    name = module.add_function(
        (state.id, word),
        f"userdata, {word}",
        [layout(message, 1, f"{STEP}return ")],
        comments(activity.origin),
    )
    return ((f"{word}_cb", Source(name)),)


def _got(state: State, activity: Activity, word: str, module: Module) -> Keywords:
    """Return the argument that handles the result or response.

    It is stored only when the call succeeded. If the model stores field `success` of a response,
    a response with `success` false counts as a success.
    """
    if activity.result_callback is not None:
        status = "status, " if word == "result" else ""
        parameters = f"userdata, {status}{word}"
        name = _callback(activity, activity.result_callback, parameters, module)
        return ((f"{word}_cb", Source(name)),)
    if not activity.results:
        return ()
    lines: list[str] = []
    for result in activity.results:
        bound = bound_of_any(module.held(result.variable, result.path))
        value = within(f"{word}.{field_name(result.field)}", bound, module)
        lines += assign(result.variable, result.path, value, 1, module)
    said = comments(activity.origin)
    name = module.add_function((state.id, word), f"userdata, {word}", lines, said)
    refused = word == "response" and activity.judges_response
    return (("store", Source(name)), *((("refused", "succeeded"),) if refused else ()))


def _callback(activity: Activity, name: str, parameters: str, module: Module) -> str:
    """Add a callback of the user; return its qualified name."""
    module.callbacks.append((name, parameters, activity.origin))
    module.imports.name(module.imports.types.package, "callbacks")
    return f"callbacks.{name}"
