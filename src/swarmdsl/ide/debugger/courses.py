"""Requests about the course of a session: its start and end, and how the run goes on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.ide.debugger.client import EndedError
from swarmdsl.ide.debugger.controls import FAILURES, VIOLATIONS
from swarmdsl.ide.debugger.messages import Arguments, RequestError, optional, required
from swarmdsl.ide.debugger.owner import Body, Handler, Session
from swarmdsl.ide.debugger.points import Way

CAPABILITIES: Mapping[str, Any] = {
    "supportsConfigurationDoneRequest": True,
    "supportsConditionalBreakpoints": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsBreakpointLocationsRequest": True,
    "supportsEvaluateForHovers": True,
    "supportsSetVariable": True,
    "supportsStepBack": True,
    "supportsRestartRequest": True,
    "supportsTerminateRequest": True,
    "supportsCompletionsRequest": True,
    "supportsExceptionInfoRequest": True,
    "exceptionBreakpointFilters": [
        {"filter": VIOLATIONS, "label": "Property violated", "default": True},
        {"filter": FAILURES, "label": "Expression failed", "default": True},
    ],
}


# ---- the life of a session


def _initialize(session: Session, arguments: Arguments) -> Body:
    session.first_line = 0 if optional(arguments, "linesStartAt1", bool) is False else 1
    session.first_column = 0 if optional(arguments, "columnsStartAt1", bool) is False else 1
    return CAPABILITIES


def _launched(session: Session, arguments: Arguments) -> Body:
    if session.controls is not None:
        raise RequestError("something is launched already")
    session.begin(arguments)
    session.after_answer(lambda: session.event("initialized"))
    return None


def _configured(session: Session, arguments: Arguments) -> Body:
    session.configured()
    return None


def _restart(session: Session, arguments: Arguments) -> Body:
    session.looking()
    session.again()
    return None


def _end(session: Session, arguments: Arguments) -> Body:
    def act() -> None:
        session.event("terminated")
        raise EndedError

    session.after_answer(act)
    return None


_LIFE: Mapping[str, Handler] = {
    "initialize": _initialize,
    "launch": _launched,
    "configurationDone": _configured,
    "restart": _restart,
    "terminate": _end,
    "disconnect": _end,
}


# ---- ways to go on


def _continue(session: Session, arguments: Arguments) -> Body:
    session.go_on(Way("breakpoint"))
    return {"allThreadsContinued": True}


def _moment(session: Session, arguments: Arguments) -> Body:
    session.go_on(Way("moment"))
    return None


def _microstep(session: Session, arguments: Arguments) -> Body:
    session.go_on(Way("microstep", _member(session, arguments)))
    return None


def _transition(session: Session, arguments: Arguments) -> Body:
    session.go_on(Way("transition", _member(session, arguments)))
    return None


def _member(session: Session, arguments: Arguments) -> int:
    return session.standing().member(required(arguments, "threadId", int))


def _back(session: Session, arguments: Arguments) -> Body:
    session.standing()
    controls = session.looking()
    before = [each for each in controls.moments if each < controls.number]
    if not before:
        raise RequestError("this is the start of the run")
    session.go_back(before[-1])
    return None


def _back_to_breakpoint(session: Session, arguments: Arguments) -> Body:
    session.standing()
    session.go_back(session.looking().number, finds=True)
    return None


def _pause(session: Session, arguments: Arguments) -> Body:
    if not session.is_held:
        session.looking().wants_pause = True
    return None


def _go(session: Session, arguments: Arguments) -> Body:
    """Go on as another request would, for a page whose editor does not know of it."""
    name = required(arguments, "request", str)
    way = _WAYS.get(name)
    if way is None:
        raise RequestError(f"`request` must be one of {', '.join(_WAYS)}")
    if way is not _pause:
        session.standing()
        session.after_answer(lambda: session.event("continued", {"allThreadsContinued": True}))
    return way(session, arguments)


def _speed(session: Session, arguments: Arguments) -> Body:
    """Let time pass at another speed from now on, also when the run begins anew."""
    session.looking()
    session.set_speed(arguments)
    return None


_WAYS: Mapping[str, Handler] = {
    "continue": _continue,
    "next": _moment,
    "stepIn": _microstep,
    "stepOut": _transition,
    "stepBack": _back,
    "reverseContinue": _back_to_breakpoint,
    "pause": _pause,
}

REQUESTS: Mapping[str, Handler] = {**_LIFE, **_WAYS, "swarmGo": _go, "swarmSpeed": _speed}
