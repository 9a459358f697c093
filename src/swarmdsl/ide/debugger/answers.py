"""Requests that look into a run, or set what it stops at."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swarmdsl.base.source import Source
from swarmdsl.ide.debugger.inspection import Frame
from swarmdsl.ide.debugger.messages import (
    Arguments,
    RequestError,
    as_path,
    optional,
    required,
    texts,
)
from swarmdsl.ide.debugger.owner import Body, Handler, Session
from swarmdsl.ide.debugger.points import Way
from swarmdsl.ide.debugger.sending import enabled, read_command
from swarmdsl.ide.debugger.values import Shown, text_of, type_text
from swarmdsl.ide.server.positions import UTF_16, bounds, offset, units

# ---- breakpoints


def _set_breakpoints(session: Session, arguments: Arguments) -> Body:
    controls = session.looking()
    path = _path(arguments)
    asked = optional(arguments, "breakpoints", list) or []
    shift = 1 - session.first_line
    shifts = {"line": shift, "column": 1 - session.first_column}
    moved = [
        {**each, **{key: each[key] + by for key, by in shifts.items() if _is_number(each.get(key))}}
        if isinstance(each, dict)
        else each
        for each in asked
    ]
    found = controls.breakpoints.replace(path, moved)
    if asked and session.places is not None and session.places.has_changed(path):
        hint = "has changed since the run began: restart to run it as it is now"
        session.tell(f"{Path(path).name} {hint}", "stderr")
    return {
        "breakpoints": [
            {**each, "line": each["line"] - shift} if "line" in each else each for each in found
        ]
    }


def _is_number(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _path(arguments: Arguments) -> str:
    """Return the real path of the file that a request is about."""
    return os.path.realpath(as_path(required(required(arguments, "source", dict), "path", str)))


def _locations(session: Session, arguments: Arguments) -> Body:
    places = session.places
    if places is None:
        raise RequestError("nothing is launched")
    path = _path(arguments)
    shift = 1 - session.first_line
    first = required(arguments, "line", int) + shift
    last = optional(arguments, "endLine", int)
    lines = places.lines(path, first, first if last is None else last + shift)
    return {"breakpoints": [{"line": line - shift} for line in lines]}


def _set_filters(session: Session, arguments: Arguments) -> Body:
    controls = session.looking()
    controls.filters = frozenset(texts(arguments, "filters"))
    return None


def _exception(session: Session, arguments: Arguments) -> Body:
    session.standing()
    return {"exceptionId": session.reason or "fault", "breakMode": "always"}


# ---- stacks and variables


def _threads(session: Session, arguments: Arguments) -> Body:
    if session.inspection is None:
        return {"threads": []}
    return {"threads": session.inspection.threads()}


def _stack(session: Session, arguments: Arguments) -> Body:
    inspection = session.standing()
    found = inspection.stack(inspection.member(required(arguments, "threadId", int)))
    first = optional(arguments, "startFrame", int) or 0
    most = optional(arguments, "levels", int) or len(found)
    shown = found[max(first, 0) : max(first, 0) + most]
    return {
        "stackFrames": [_frame(session, number, frame) for number, frame in shown],
        "totalFrames": len(found),
    }


def _frame(session: Session, number: int, frame: Frame) -> dict[str, Any]:
    shown: dict[str, Any] = {"id": number, "name": frame.name, "line": 0, "column": 0}
    if frame.place is not None and frame.place.source.path is not None:
        place = frame.place
        path = os.path.realpath(place.source.path or "")
        for key, (line, column) in zip(("", "end"), bounds(place), strict=True):
            shown[f"{key}Line" if key else "line"] = line + session.first_line
            shown[f"{key}Column" if key else "column"] = column + session.first_column
        shown["source"] = {"name": Path(path).name, "path": path}
    else:
        shown["presentationHint"] = "subtle"
    return shown


def _scopes(session: Session, arguments: Arguments) -> Body:
    inspection = session.standing()
    found = inspection.scopes(inspection.frame(required(arguments, "frameId", int)))
    return {
        "scopes": [
            {"name": name, "variablesReference": number, "expensive": False, **_HINTS.get(name, {})}
            for name, number in found
        ]
    }


_HINTS: Mapping[str, Mapping[str, str]] = {
    "Variables": {"presentationHint": "locals"},
    "Params": {"presentationHint": "arguments"},
}


def _variables(session: Session, arguments: Arguments) -> Body:
    inspection = session.standing()
    number = required(arguments, "variablesReference", int)
    held = inspection.references.of(number)
    if held is None:
        raise RequestError(f"there are no variables with the number {number}")
    member, found = held
    return {"variables": [_variable(session, member, each) for each in found]}


def _variable(session: Session, member: int, shown: Shown) -> dict[str, Any]:
    inspection = session.standing()
    made = {
        "name": shown.name,
        "value": inspection.text(shown),
        "type": inspection.type(shown),
        "variablesReference": inspection.references.inside(member, shown),
    }
    if shown.expression:
        made["evaluateName"] = shown.expression
    if not shown.settable:
        made["presentationHint"] = {"attributes": ["readOnly"]}
    return made


def _set_variable(session: Session, arguments: Arguments) -> Body:
    inspection = session.standing()
    held = inspection.references.of(required(arguments, "variablesReference", int))
    name = required(arguments, "name", str)
    found = next((each for each in held[1] if each.name == name), None) if held else None
    if held is None or found is None or not found.settable:
        raise RequestError(f"`{name}` cannot be set")
    text = inspection.set(held[0], found.expression, required(arguments, "value", str))
    return {"value": text, "type": inspection.type(found)}


# ---- expressions and commands


def _evaluate(session: Session, arguments: Arguments) -> Body:
    inspection, controls = session.standing(), session.looking()
    text = required(arguments, "expression", str).strip()
    line = read_command(text) if optional(arguments, "context", str) == "repl" else None
    if line is not None:
        return _sent(session, line)
    number = optional(arguments, "frameId", int)
    member, state = controls.point.member, None
    if number:
        frame = inspection.frame(number)
        member, state = frame.member, frame.state
    found = controls.evaluate(text, member, state)
    system = controls.subject.system
    shown = Shown(text, found.value, found.type)
    return {
        "result": text_of(found.value, found.type, system),
        "type": type_text(found.type),
        "variablesReference": inspection.references.inside(member, shown),
    }


def _sent(session: Session, line: Mapping[str, Any]) -> Body:
    """Send an event; let the run go on to its end, unless it is in the middle of a step."""
    controls = session.looking()
    who = session.standing().send(line)
    result = f"{line['event']} to {', '.join(who) or 'nobody'}"
    if controls.point.kind == "microstep":
        return {"result": f"{result}, when this step is over", "variablesReference": 0}
    now = controls.world.clock.now
    session.after_answer(lambda: session.event("continued", {"allThreadsContinued": True}))
    session.go_on(Way("event", event=line["event"], time=now))
    return {"result": result, "variablesReference": 0}


def _send(session: Session, arguments: Arguments) -> Body:
    required(arguments, "event", str)
    line = {key: arguments[key] for key in ("event", "member", "data") if key in arguments}
    return _sent(session, line)


def _picture(session: Session, arguments: Arguments) -> Body:
    session.looking()
    thread = optional(arguments, "threadId", int)
    return session.picture(session.standing().member(thread) if thread is not None else None)


def _completions(session: Session, arguments: Arguments) -> Body:
    inspection, controls = session.standing(), session.looking()
    text, column = required(arguments, "text", str), required(arguments, "column", int)
    line = optional(arguments, "line", int)
    at = (0 if line is None else line - session.first_line, column - session.first_column)
    before = text[: offset(Source("console", text), at)].replace("\n", " ")
    if before.lstrip().startswith("send "):
        found = enabled(controls.subject, controls.world, controls.instances)
        names = [str(each["event"]) for each in found]
        typed = before.rpartition(" ")[2]
        return {"targets": _targets(before, typed, names, "event")}
    words = before.replace("(", " ").split(" ")
    names = list(inspection.variables(controls.point.member))
    targets = _targets(before, words[-1], [name for name in names if "." not in name], "variable")
    if "send".startswith(before.strip()):
        start = units(before, UTF_16) - len(words[-1])
        targets.append({"label": "send", "text": "send ", "start": start, "type": "keyword"})
    return {"targets": targets}


def _targets(before: str, typed: str, names: list[str], kind: str) -> list[dict[str, Any]]:
    start = units(before, UTF_16) - units(typed, UTF_16)
    kinds = {"event": "value", "variable": "variable"}
    return [
        {"label": name, "start": start, "length": units(typed, UTF_16), "type": kinds[kind]}
        for name in names
        if name.startswith(typed)
    ]


REQUESTS: Mapping[str, Handler] = {
    "setBreakpoints": _set_breakpoints,
    "breakpointLocations": _locations,
    "setExceptionBreakpoints": _set_filters,
    "exceptionInfo": _exception,
    "threads": _threads,
    "stackTrace": _stack,
    "scopes": _scopes,
    "variables": _variables,
    "setVariable": _set_variable,
    "evaluate": _evaluate,
    "completions": _completions,
    "swarmSend": _send,
    "swarmPicture": _picture,
}
