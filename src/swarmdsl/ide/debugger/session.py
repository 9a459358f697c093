"""Session of a client: its requests, and the run that they drive.

One thread does everything: while the run goes on, it looks for messages between the moments, and
while the run stands still, it waits for them. Another thread only reads.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.execution.simulate.durations import SECOND
from swarmdsl.execution.simulate.trace import Line, as_text
from swarmdsl.ide.debugger import answers
from swarmdsl.ide.debugger.breakpoints import Breakpoints, Places
from swarmdsl.ide.debugger.controls import Controls, EndedError, RunAgainError
from swarmdsl.ide.debugger.expressions import Expressions
from swarmdsl.ide.debugger.inspection import Inspection
from swarmdsl.ide.debugger.messages import (
    Arguments,
    Connection,
    RequestError,
    optional,
    required,
)
from swarmdsl.ide.debugger.points import Way
from swarmdsl.ide.debugger.programs import Program, load
from swarmdsl.ide.debugger.sending import enabled

_INTERVAL = 0.1
"""Least time between two pictures of a run that goes on, in seconds."""
_MOST_TOLD = 200
"""Lines in one message, at most."""

Body = Mapping[str, Any] | None


class Session:
    """Debug session with one client."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._messages: SimpleQueue[Any] = SimpleQueue()
        self._deferred: list[Callable[[], None]] = []
        """What follows the answer to the present request."""
        self.first_line = self.first_column = 1
        self.program: Program | None = None
        self._launch: Arguments = {}
        self.controls: Controls | None = None
        self.inspection: Inspection | None = None
        self.places: Places | None = None
        self.is_held = False
        self._reason = ""
        self._goes_on = False
        self._is_configured = self._is_over = False
        self._lines: list[str] = []
        self._shown = 0.0
        self._requests = {**_LIFE, **_STEPS, **answers.REQUESTS}

    # ---- messages

    def serve(self) -> None:
        """Answer requests until the client leaves."""
        threading.Thread(target=self._read, daemon=True).start()
        try:
            while True:
                self._handle(self._messages.get())
                if self.controls is not None and self._is_configured and not self._is_over:
                    self._run()
        except EndedError:
            return

    def _read(self) -> None:
        while (message := self._connection.read()) is not None:
            self._messages.put(message)
        self._messages.put(None)

    def event(self, name: str, body: Body = None) -> None:
        """Send an event to the client."""
        self._connection.write({"type": "event", "event": name, "body": body or {}})

    def after_answer(self, act: Callable[[], None]) -> None:
        """Do something when the present request has been answered."""
        self._deferred.append(act)

    def _handle(self, message: Any) -> None:
        if message is None:
            raise EndedError
        if not isinstance(message, dict) or message.get("type") != "request":
            return
        command, number = message.get("command"), message.get("seq")
        answer = {
            "type": "response",
            "request_seq": number if isinstance(number, int) else 0,
            "command": command if isinstance(command, str) else "",
        }
        try:
            body = self._answered(command, message.get("arguments"))
        except RequestError as error:
            self._refuse(answer, str(error))
        except Exception as error:
            self._refuse(answer, f"internal error: {type(error).__name__}: {error}")
        else:
            self._connection.write({**answer, "success": True, "body": body or {}})
        deferred, self._deferred = self._deferred, []
        for act in deferred:
            act()

    def _answered(self, command: Any, arguments: Any) -> Body:
        request = self._requests.get(command) if isinstance(command, str) else None
        if request is None:
            raise RequestError(f"there is no request `{command}`")
        if arguments is not None and not isinstance(arguments, dict):
            raise RequestError("`arguments` must be an object")
        return request(self, arguments or {})

    def _refuse(self, answer: Mapping[str, Any], why: str) -> None:
        error = {"id": 1, "format": "{why}", "variables": {"why": why}, "showUser": True}
        refusal = {"success": False, "message": why, "body": {"error": error}}
        self._connection.write({**answer, **refusal})

    # ---- called by requests

    def begin(self, arguments: Arguments) -> None:
        """Load the program of a launch; raise RequestError if there is none."""
        self._launch = arguments
        report = Diagnostics()
        folder = Path(optional(arguments, "cwd", str) or Path())
        speed = arguments.get("speed")
        if speed is not None and not (isinstance(speed, (int, float)) and 0 < speed <= 1000):
            raise RequestError("`speed` must be a number above 0, at most 1000")
        program = load(arguments, folder, report)
        for found in report:
            self._report(found)
        if program is None:
            raise RequestError(_headline(next(iter(report))))
        self.program = program
        subject = program.subject
        expressions = Expressions(subject)
        self.places = Places(subject, program.machines)
        breakpoints = Breakpoints(self.places, expressions)
        real = 1.0 if optional(arguments, "realTime", bool) else None
        self.controls = Controls(subject, self, breakpoints, expressions, speed or real)
        self.inspection = Inspection(self.controls)
        if optional(arguments, "stopOnEntry", bool):
            self.controls.way = Way("moment")

    def configured(self) -> None:
        """Begin to run, when the request has been answered."""
        if self.controls is None:
            raise RequestError("nothing is launched")
        self._is_configured = True

    def again(self) -> None:
        """Begin anew with the files of now, when the request has been answered."""
        filters = self.looking().filters
        kept = self.looking().breakpoints.asked
        self.begin(self._launch)
        controls = self.looking()
        controls.filters = filters
        for path, asked in kept.items():
            controls.breakpoints.replace(path, asked)
        if not self._is_over and (self.is_held or self._is_configured):
            self.after_answer(_begin_again)
        self._is_over = False

    def looking(self) -> Controls:
        """Return the controls of the run; raise RequestError if nothing is launched."""
        if self.controls is None or self.inspection is None:
            raise RequestError("nothing is launched")
        return self.controls

    def standing(self) -> Inspection:
        """Return what looks into the run; raise RequestError unless it stands still."""
        self.looking()
        if not self.is_held or self.inspection is None:
            raise RequestError("the simulation is running" if not self._is_over else "it is over")
        return self.inspection

    def go_on(self, way: Way) -> None:
        """Let the run go on, when the request has been answered."""
        self.standing()
        self.looking().way = way
        self._goes_on = True

    def go_back(self, point: int, *, finds: bool = False) -> None:
        """Play the run again to a point, when the request has been answered."""

        def act() -> None:
            raise RunAgainError(point, finds=finds)

        self.after_answer(act)

    # ---- the run

    def _run(self) -> None:
        """Run the program to its end, again and again if the user goes back."""
        self.event("process", {"name": self._name(), "startMethod": "launch"})
        while True:
            controls = self.looking()
            assert self.program is not None
            controls.reset()
            try:
                ending = self.program.play(controls)
            except RunAgainError as again:
                controls = self.looking()
                controls.finds = again.finds
                if again.point:
                    controls.way = Way("point", point=again.point)
            else:
                break
            finally:
                self._forget()
        self._is_over = True
        self.tell(f"{ending}, at {controls.world.clock.now / SECOND:.3f} s", "console")
        self._flush()
        self.event("exited", {"exitCode": 0})
        self.event("terminated")

    def _name(self) -> str:
        return self.program.subject.name if self.program is not None else ""

    def _forget(self) -> None:
        self.is_held = False
        if self.inspection is not None:
            self.inspection.forget()

    def poll(self) -> None:
        """Handle what the user has asked for meanwhile."""
        while True:
            try:
                message = self._messages.get_nowait()
            except Empty:
                break
            self._handle(message)
        if self._lines and (
            len(self._lines) >= _MOST_TOLD or time.monotonic() - self._shown > _INTERVAL
        ):
            self._show()

    def hold(self, reason: str, text: str) -> None:
        """Stand still until the user goes on."""
        controls = self.looking()
        self.is_held, self._goes_on = True, False
        self._reason = text
        self._show()
        thread = controls.point.member + 1
        body = {"reason": reason, "threadId": thread, "allThreadsStopped": True}
        if text:
            body |= {"description": _SAID.get(reason, text), "text": text}
        self.event("stopped", body)
        while not self._goes_on:
            self._handle(self._messages.get())
        self._forget()

    def tell(self, text: str, category: str = "stdout") -> None:
        """Tell the user a line."""
        if category == "stdout":
            self._lines.append(text)
            return
        self._flush()
        self.event("output", {"category": category, "output": f"{text}\n"})

    def moved(self, line: Line) -> None:
        """Follow a step that the user sees."""
        self.tell(as_text(line))

    @property
    def reason(self) -> str:
        """Text of why the run stands still."""
        return self._reason

    def _flush(self) -> None:
        if self._lines:
            text = "".join(f"{line}\n" for line in self._lines)
            self._lines.clear()
            self.event("output", {"category": "stdout", "output": text})

    def _show(self) -> None:
        """Show what has happened, and the active states to those who draw them."""
        self._flush()
        self._shown = time.monotonic()
        self.event("swarmMoved", self.picture())

    def picture(self) -> dict[str, Any]:
        """Return the run as pages show it: active states, events to send, variables."""
        controls, inspection = self.looking(), self.inspection
        assert inspection is not None
        if not controls.has_begun:
            return {"active": {}}
        instances = controls.instances
        active = {
            inspection.name(member): [instance.final]
            if instance.final is not None
            else instance.configuration.innermost
            for member, instance in enumerate(instances.values())
            if instance.running or instance.final is not None
        }
        gone = {inspection.name(n): None for n in range(len(instances))}
        last = controls.last.get(controls.point.member)
        shown: dict[str, Any] = {
            "time": controls.world.clock.now / SECOND,
            "active": {**gone, **active},
        }
        if last is not None:
            called = last.actor.machine.called
            name = inspection.name(controls.point.member)
            shown["taken"] = {name: list(dict.fromkeys(map(called, last.taken)))}
            shown["entered"] = {name: last.entered}
        if self.is_held:
            member = controls.point.member
            shown["member"] = inspection.name(member)
            shown["thread"] = member + 1
            shown["events"] = enabled(controls.subject, controls.world, instances)
            shown["variables"] = inspection.variables(member)
        return shown

    def _report(self, found: Diagnostic) -> None:
        body: dict[str, Any] = {"category": "stderr", "output": f"{_headline(found)}\n"}
        if found.primary is not None:
            place = found.primary.span.absolute
            line, column = place.source.line_column(place.start)
            if place.source.path is not None:
                path = os.path.realpath(place.source.path)
                body |= {"source": {"name": place.source.path.name, "path": path}}
                body |= {"line": line - 1 + self.first_line}
                body |= {"column": column - 1 + self.first_column}
        self.event("output", body)


def _begin_again() -> None:
    raise RunAgainError(0)


def _headline(found: Diagnostic) -> str:
    place = ""
    if found.primary is not None:
        at = found.primary.span.absolute
        line, column = at.source.line_column(at.start)
        place = f"{at.source.name}:{line}:{column}: "
    label = f": {found.primary.message}" if found.primary and found.primary.message else ""
    help_ = f" (help: {found.help})" if found.help else ""
    return f"{place}{found.severity.value}[{found.code}]: {found.message}{label}{help_}"


_SAID = {"breakpoint": "Paused on a state or transition", "exception": "Paused on a fault"}


# ---- the life of a session


def _initialize(session: Session, arguments: Arguments) -> Body:
    session.first_line = 0 if optional(arguments, "linesStartAt1", bool) is False else 1
    session.first_column = 0 if optional(arguments, "columnsStartAt1", bool) is False else 1
    return answers.CAPABILITIES


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


_LIFE: Mapping[str, Callable[[Session, Arguments], Body]] = {
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


_STEPS: Mapping[str, Callable[[Session, Arguments], Body]] = {
    "continue": _continue,
    "next": _moment,
    "stepIn": _microstep,
    "stepOut": _transition,
    "stepBack": _back,
    "reverseContinue": _back_to_breakpoint,
    "pause": _pause,
}
