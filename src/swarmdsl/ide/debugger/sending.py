"""Events that a user sends to a run: those that would do something now, and commands to send."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.engine.world import FAILURES
from swarmdsl.execution.simulate.inputs.events import Input, Reader
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ide.debugger.messages import RequestError
from swarmdsl.ir import EventData, System, Transition, subexpressions

_COMMAND = re.compile(
    r"send(?:\s+(?P<event>[\w.]+))?(?:\s+(?P<data>\{.*\}))?(?:\s+to\s+(?P<to>\S+))?\s*"
)
_HELP = 'write `send EVENT`, `send EVENT {"field": 1}` or `send EVENT to ROBOT`'


def read_command(text: str) -> dict[str, Any] | None:
    """Return the event that a command of the console sends, as a line of events; None if none.

    Raises RequestError for a wrong command.
    """
    words = text.strip()
    if words != "send" and not words.startswith("send "):
        return None
    found = _COMMAND.fullmatch(words)
    if found is None or not found["event"]:
        raise RequestError(_HELP)
    line: dict[str, Any] = {"event": found["event"]}
    if found["data"]:
        try:
            line["data"] = json.loads(found["data"])
        except (ValueError, RecursionError):
            raise RequestError(f"the data are no JSON: {_HELP}") from None
    if found["to"]:
        line["member"] = found["to"]
    return line


def read_event(line: Mapping[str, Any], subject: Subject, cast: Sequence[Actor]) -> Input:
    """Return an event as the simulator reads it; raise RequestError with the first diagnostic."""
    report = Diagnostics()
    reader = Reader(subject, cast, report)
    given = json.dumps(line, ensure_ascii=False).encode("utf-8", "replace")
    read = next(reader.stream([given]), None)
    problems = [found for found in report if read is None or found.severity.value == "error"]
    if read is None or problems:
        first = next(iter(report))
        raise RequestError("; ".join(filter(None, (first.message, first.help))))
    return read


def enabled(
    subject: Subject, world: World, instances: Mapping[Actor, Instance]
) -> list[dict[str, Any]]:
    """Return the events that would do something now, each with its receivers and first data.

    One whose guard depends on its data may do something. Ends of functions that run are among them.
    """
    found: dict[str, dict[str, Any]] = {}
    for actor, instance in instances.items():
        if not instance.running:
            continue
        for name, label in _names(subject, world, actor):
            if _does_something(name, instance, subject.system):
                entry = found.setdefault(name, {"event": name, "label": label, "to": []})
                data = _default(name, subject.system)
                if isinstance(data, dict) and data:
                    entry["data"] = named_numbers(data)
                entry["to"].append(actor.name or actor.machine.name)
    return list(found.values())


def _names(subject: Subject, world: World, actor: Actor) -> Iterator[tuple[str, str]]:
    """Yield the events that can reach a machine from outside, each with a label."""
    system = subject.system
    if system is None:
        names = {each for edges in actor.machine.edges for edge in edges for each in edge.events}
        yield from ((name, name) for name in sorted(names) if "*" not in name)
        return
    yield from ((each.name, each.name) for each in system.events if actor.listens(each.name))
    for run in world.runs(actor):
        for outcome, name in run.activity.events.items():
            yield name, f"{run.activity.name} {outcome}"


def _default(name: str, system: System | None) -> Any:
    """Return the data of an event that says nothing; None if its type is not known."""
    declared = system.events_by_name.get(name) if system is not None else None
    return default_value(declared.type, system) if declared is not None and system else None


def _does_something(name: str, instance: Instance, system: System | None) -> bool:
    decision = instance.configuration.decide(name)
    if decision.step is not None:
        return True
    event = Event(name, _default(name, system))
    for path, _ in decision.candidates:
        for edge in path:
            origin = edge.table.origin
            guard = origin.guard if isinstance(origin, Transition) else None
            parts = subexpressions(guard) if guard is not None else ()
            if edge.guard is None or any(isinstance(part, EventData) for part in parts):
                return True
            try:
                if edge.guard(instance, event):
                    return True
            except FAILURES:
                continue
    return False
