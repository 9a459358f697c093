"""Session of a client: its requests, and the run that they drive.

One thread does everything: while the run goes on, it looks for messages between the moments, and
while the run stands still, it waits for them. Another thread only reads.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.world.line import Line, as_text
from swarmdsl.ide.debugger import answers, courses
from swarmdsl.ide.debugger.behaviour_test import load_test
from swarmdsl.ide.debugger.breakpoints import Breakpoints, Places
from swarmdsl.ide.debugger.client import EndedError, RunAgainError
from swarmdsl.ide.debugger.controls import GO_ON, Controls
from swarmdsl.ide.debugger.expressions import Expressions
from swarmdsl.ide.debugger.inspection import Inspection
from swarmdsl.ide.debugger.launch_keys import misspelled
from swarmdsl.ide.debugger.messages import (
    Arguments,
    Connection,
    RequestError,
    as_path,
    optional,
    speed_of,
)
from swarmdsl.ide.debugger.points import Way
from swarmdsl.ide.debugger.programs import Program, load_model
from swarmdsl.ide.debugger.showing import headline, output_of, picture

_INTERVAL = 0.1
"""Least time between two pictures of a run that goes on, in seconds."""
_LONGEST = 1.0
"""Time between two pictures of a run in which nothing happens, in seconds."""
_MOST_TOLD = 200
"""Lines in one message, at most."""

Body = Mapping[str, Any] | None


class Session:
    """Debug session with one client."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._messages: SimpleQueue[Any] = SimpleQueue()
        self._deferred: list[Callable[[], None]] = []
        """Acts that follow the answer to the present request."""
        self.first_line = self.first_column = 1
        self.program: Program | None = None
        self._launch: Arguments = {}
        self.controls: Controls | None = None
        self.inspection: Inspection | None = None
        self.places: Places | None = None
        self.is_held = False
        self._reason = ""
        self._is_notable = False
        """True if the run stands still for a reason that the user did not ask for."""
        self._goes_on = False
        self._is_configured = self._is_over = False
        self._lines: list[str] = []
        self._shown = self._went = 0.0
        """Times of the last picture, and of the last time that the run went on."""
        self._looks_held = False
        """True if the run stands still as far as the client knows: a step may take long."""
        self._told: Line | None = None
        """Last step that the client was shown."""
        self._requests = {**courses.REQUESTS, **answers.REQUESTS}

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
            self._deferred.clear()
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
        folder = Path(as_path(optional(arguments, "cwd", str) or ""))
        speed = speed_of(arguments)
        for hint in misspelled(arguments):
            self.tell(hint, "stderr")
        program: Program | None
        if arguments.get("test") in (None, ""):
            program = load_model(arguments, folder, report)
        else:
            program = load_test(arguments, folder, report, self.judged)
        for found in report:
            self.event("output", output_of(found, self.first_line, self.first_column))
        if program is None:
            errors = (each for each in report if each.severity is Severity.ERROR)
            raise RequestError(headline(next(errors)))
        self.program = program
        subject = program.subject
        expressions = Expressions(subject)
        self.places = Places(subject, program.machines)
        breakpoints = Breakpoints(self.places, expressions)
        self.controls = Controls(subject, self, breakpoints, expressions, speed)
        self.inspection = Inspection(self.controls)
        self.controls.stops = not optional(arguments, "noDebug", bool)
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

    def set_speed(self, arguments: Arguments) -> None:
        """Let time pass at the speed of some arguments; raise RequestError for a wrong one."""
        self.looking().speed = speed_of(arguments)
        self._launch = {**self._launch, "realTime": False, "speed": arguments.get("speed")}

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
        self.event("exited", {"exitCode": int(controls.has_failed)})
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
        passed = time.monotonic() - max(self._shown, self._went)
        is_news = bool(self._lines) or self._looks_held
        if len(self._lines) >= _MOST_TOLD or passed > (_INTERVAL if is_news else _LONGEST):
            self._show()

    def hold(self, reason: str, text: str) -> None:
        """Stand still until the user goes on."""
        controls = self.looking()
        self.is_held, self._goes_on = True, False
        self._reason = f"at a breakpoint: {text}" if reason == "breakpoint" else text
        self._is_notable = reason in ("exception", "pause", "breakpoint")
        self._show()
        thread = controls.point.member + 1
        body = {"reason": reason, "threadId": thread, "allThreadsStopped": True}
        if text:
            body["text"] = text
        if reason in ("exception", "pause"):
            body["description"] = text or "Paused"
        self.event("stopped", body)
        while not self._goes_on:
            self._handle(self._messages.get())
        self._forget()
        self._went = time.monotonic()
        if controls.way == GO_ON:
            self._send_picture()

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

    def judged(self, result: Mapping[str, Any]) -> None:
        """Send the result of a test."""
        self.event("swarmTested", result)

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
        self._send_picture()
        controls = self.looking()
        self._told = controls.last.get(controls.point.member)

    def _send_picture(self) -> None:
        self._looks_held = self.is_held
        self.event("swarmMoved", self.picture())

    def picture(self, member: int | None = None) -> dict[str, Any]:
        """Return the run as pages show it: `member` is looked at, by default the one at the stop.

        The reason of a stop is in it unless that is a step, which the page shows itself.
        """
        controls = self.looking()
        assert self.inspection is not None
        if not self.is_held:
            return picture(controls, self.inspection, self._told)
        seen = controls.point.member if member is None else member
        shown = picture(controls, self.inspection, self._told, seen)
        if self._reason and self._is_notable:
            shown["reason"] = self._reason
        return shown


def _begin_again() -> None:
    raise RunAgainError(0)
