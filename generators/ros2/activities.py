"""Activities: goals and requests of calls, and handling of results and responses."""

from __future__ import annotations

from swarmdsl.codegen.python import Call, Source, layout
from swarmdsl.ir import Activity, State, bound_of_any

from .effects import filled, put
from .expressions import DATA, EVENT
from .imports import WIDTH
from .module import BOTH, STEP, Module
from .names import field_name


def activity_of(state: State, activity: Activity, module: Module) -> Call:
    """Return the `Activity(...)` of a state for the table."""
    module.imports.own("engine", "Activity")
    module.imports.own("host", "outcomes")
    call = module.system.function(activity.function).communication
    keywords: list[tuple[str, object]] = []
    empty = (
        f"{module.imports.interface(call.type, 'action')}.Goal"
        if call.paradigm == "action"
        else f"{module.imports.interface(call.type, 'srv')}.Request"
    )
    if activity.goal_callback is not None:
        word = "goal" if call.paradigm == "action" else "request"
        value = _by_user(activity, activity.goal_callback, word, f"{empty}()", module)
        keywords.append(("goal", _goal(state, value, activity, module)))
    elif activity.arguments:
        goal = filled(empty, activity.arguments, module)
        keywords.append(("goal", _goal(state, goal, activity, module)))
    if activity.result_callback is not None:
        word = "result" if call.paradigm == "action" else "response"
        value = _by_user(activity, activity.result_callback, word, f"{EVENT}.data", module)
        line = layout(value, 1, STEP, width=WIDTH)
        keywords.append(
            ("finalize", module.function("result", state.id, BOTH, [line], activity.origin))
        )
    elif activity.results:
        lines = []
        for result in activity.results:
            module.imports.own("values", "get")
            value_text = f"get({EVENT}.data, {field_name(result.field)!r})"
            if result.path:
                lines.append(put(result.variable, result.path, value_text, module))
                continue
            bound = bound_of_any(module.types[result.variable])
            if bound is not None:
                module.imports.own("engine", "bounded")
                kept = f"bounded({value_text}, {bound!r})"
            else:
                module.imports.name("copy", "deepcopy")
                kept = f"deepcopy({value_text})"
            lines.append(f"{STEP}{DATA}.{result.variable} = {kept}")
        keywords.append(
            ("finalize", module.function("result", state.id, BOTH, lines, activity.origin))
        )
    if call.paradigm == "service" and activity.judges_response:
        keywords.append(("refused", "succeeded"))
    arguments = (activity.function, call.name, Call("outcomes", (state.id,)))
    return Call("Activity", arguments, tuple(keywords))


def _goal(state: State, value: object, activity: Activity, module: Module) -> Source:
    lines = [layout(value, 1, f"{STEP}return ", width=WIDTH)]
    return module.function("goal", state.id, "machine", lines, activity.origin)


def _by_user(activity: Activity, name: str, word: str, value: str, module: Module) -> Call:
    module.callbacks.append((name, f"data, {word}", activity.origin))
    module.imports.name(".", "callbacks")
    module.imports.own("host", "by_user")
    return Call("by_user", (Source(f"callbacks.{name}"), Source(DATA), Source(value)))
