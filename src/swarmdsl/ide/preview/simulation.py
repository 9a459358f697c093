"""Simulation that the pages of a preview drive, each of them the same one."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from threading import RLock
from typing import Any, cast

from swarmdsl.base.read_files import is_folder
from swarmdsl.execution.simulate.inputs.scenario_files import scenarios_in
from swarmdsl.ide.debugger.messages import RequestError
from swarmdsl.ide.preview.adapter import Adapter
from swarmdsl.ide.preview.breakpoints import Breakpoints
from swarmdsl.ide.preview.pictures import Message, Pictures, Steps
from swarmdsl.ide.preview.serving import Snapshot

_TRACE = ""
"""Name of the run among the traces that are followed; no file has it."""
_STEPS = ("continue", "next", "stepIn", "stepBack", "pause")
_CHANGED = "the model has changed: Restart runs it as it is now"


class Simulation:
    """A run of the model under the debug adapter, and what pages show of it."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        # Requests of pages and events of the adapter come in threads of their own.
        self._lock = RLock()
        self._adapter: Adapter | None = None
        self._shown: dict[str, Any] = {}
        self._sources: Sequence[Path] = ()
        self._subjects: dict[str, tuple[str, str]] = {}
        self._scenarios: dict[str, Path] = {}
        self._breakpoints = Breakpoints()
        self._told = ""
        """Last line of the console."""

    # ---- what can be simulated

    def offers(self, pictures: Pictures, sources: Sequence[Path], folder: Path) -> Message:
        """Return what pages can simulate of a model, which is in `sources` of a project."""
        with self._lock:
            self._sources = sources
            if self._breakpoints.learn(pictures.stops):
                self._publish()
            self._subjects = {_titled(kind, name): (kind, name) for kind, name in pictures.subjects}
            folders = [each if is_folder(each) else each.parent for each in sources]
            found = scenarios_in([*folders, folder.absolute()])
            self._scenarios = {os.path.relpath(each, folders[0]): each for each in found}
            return {
                "subjects": {_titled(*each): id_ for each, id_ in pictures.subjects.items()},
                "scenarios": list(self._scenarios),
            }

    def model_changed(self) -> None:
        """Tell pages that the run is that of an earlier text."""
        with self._lock:
            if self._adapter is not None:
                self._show(changed=_CHANGED)

    # ---- wishes of pages

    def act(self, wish: object) -> str:
        """Do what a page asks for; return the reason if that is not possible, else nothing."""
        try:
            if not isinstance(wish, dict):
                raise RequestError("not an object")
            for name, act in self._acts.items():
                if name in wish:
                    act(self, wish)
                    return ""
            raise RequestError(f"expected one of {', '.join(self._acts)}")
        except RequestError as error:
            return str(error)

    def close(self) -> None:
        """End the run."""
        with self._lock:
            adapter, self._adapter = self._adapter, None
        if adapter is not None:
            adapter.kill()

    def _start(self, wish: Mapping[str, Any]) -> None:
        start = wish["start"] if isinstance(wish["start"], dict) else {}
        title, name = str(start.get("subject")), start.get("scenario") or ""
        with self._lock:
            subject = self._subjects.get(title)
            scenario = self._scenarios.get(str(name))
            if subject is None:
                raise RequestError(f"the model has no {title} that runs")
            if name and scenario is None:
                raise RequestError(f"there is no scenario `{name}`")
            self.close()
            self._snapshot.forget(_TRACE)
            try:
                adapter = self._adapter = Adapter(self._hear)
            except OSError as error:
                raise RequestError(f"no simulation can be started: {error.strerror}") from error
            self._shown = {"about": title, "speed": start.get("speed")}
            self._show(starts=True)
        kind, subject_name = subject
        launch = {
            "program": [str(each) for each in self._sources],
            kind: subject_name,
            "scenario": str(scenario) if scenario is not None else None,
            "speed": start.get("speed"),
            "stopOnEntry": True,
        }
        try:
            adapter.request("initialize", {"adapterID": "swarm"})
            adapter.request("launch", launch)
            self._breakpoints.send(adapter, is_new=True)
            adapter.request("configurationDone", {})
        except RequestError as error:
            self._end(adapter, str(error))

    def _request(self, wish: Mapping[str, Any]) -> None:
        request = wish["request"]
        if request == "terminate":
            self.close()
            with self._lock:
                self._snapshot.forget(_TRACE)
                self._shown = {}
                self._publish()
        elif request == "restart":
            self._restart()
        elif request in _STEPS:
            thread = self._shown.get("thread") or 1
            self._running().request("swarmGo", {"request": request, "threadId": thread})
        else:
            raise RequestError(f"there is no request `{request}`")

    def _restart(self) -> None:
        adapter = self._running()
        self._breakpoints.send(adapter)  # those of the text that runs next
        adapter.request("restart", {})
        with self._lock:
            if adapter is self._adapter:
                self._show(over=False, changed="")

    def _send(self, wish: Mapping[str, Any]) -> None:
        line = {key: wish[key] for key in ("event", "data") if key in wish}
        self._running().request("swarmSend", line)

    def _toggle_breakpoint(self, wish: Mapping[str, Any]) -> None:
        with self._lock:
            if wish["breakpoint"] is None:
                self._breakpoints.clear()
            else:
                self._breakpoints.toggle(wish)
            self._publish()
            # Of a text that has changed, the lines are others: Restart sends them.
            adapter = None if self._shown.get("changed") else self._adapter
        if adapter is not None:
            self._breakpoints.send(adapter)

    def _look(self, wish: Mapping[str, Any]) -> None:
        """Show the variables of another member, which goes on with *Into*."""
        adapter = self._running()
        seen = adapter.request("swarmPicture", {"threadId": wish["look"]})
        with self._lock:
            if adapter is self._adapter:
                self._show(**_state(seen))

    def _set_speed(self, wish: Mapping[str, Any]) -> None:
        adapter = self._running()
        adapter.request("swarmSpeed", {"speed": wish["speed"]})
        with self._lock:
            if adapter is self._adapter:
                self._show(speed=wish["speed"])

    _acts: Mapping[str, Callable[[Simulation, Mapping[str, Any]], None]] = {
        "start": _start,
        "request": _request,
        "event": _send,
        "look": _look,
        "speed": _set_speed,
        "breakpoint": _toggle_breakpoint,
    }

    def _running(self) -> Adapter:
        with self._lock:
            if self._adapter is None:
                raise RequestError("nothing is simulated")
            return self._adapter

    # ---- events of the adapter

    def _hear(self, adapter: Adapter, event: str, body: Mapping[str, Any]) -> None:
        with self._lock:
            if adapter is not self._adapter:
                return  # one that was ended
            match event:
                case "swarmMoved":
                    steps = {key: body[key] for key in ("taken", "entered") if key in body}
                    self._snapshot.move(_TRACE, body["active"], cast("Steps", steps))
                    self._show(**_state(body), starts=False)
                case "output" if body["category"] == "console":
                    self._told = body["output"].rstrip("\n")
                case "terminated":
                    self._show(over=True, held=False, events=None, reason=self._told)
                case "gone":
                    self._end(adapter, f"the simulation has broken off, with code {body['code']}")

    def _end(self, adapter: Adapter, why: str) -> None:
        with self._lock:
            if adapter is not self._adapter:
                return
            self._snapshot.forget(_TRACE)
            self._shown = {"failed": why}
            self._adapter = None
            self._publish()
        adapter.kill()

    # ---- what pages show

    def _show(self, **changed: Any) -> None:
        self._shown = {**self._shown, **changed}
        self._publish()

    def _publish(self) -> None:
        shown = self._breakpoints.shown()
        self._snapshot.control({"debug": self._shown or None, "breakpoints": shown})


def _titled(kind: str, name: str) -> str:
    return f"{'state machine' if kind == 'machine' else kind} {name}"


def _state(body: Mapping[str, Any]) -> dict[str, Any]:
    """Return the part of a picture of the adapter that the controls show."""
    keys = ("time", "member", "thread", "members", "events", "variables", "reason")
    return {"held": "events" in body, **{key: body.get(key) for key in keys}}
