"""Answers about a run that stands still: threads, stacks, scopes and variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from swarmdsl.analysis.types.fitting import fits
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Instance, State, Transition
from swarmdsl.execution.simulate.inputs.values import MisfitError, fitted
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.ide.debugger.controls import Controls, Deed
from swarmdsl.ide.debugger.messages import RequestError
from swarmdsl.ide.debugger.points import Element
from swarmdsl.ide.debugger.sending import read_event
from swarmdsl.ide.debugger.values import References, Shown, text_of, type_text
from swarmdsl.ir import State as Declared
from swarmdsl.ir import StateKind, StateMachine
from swarmdsl.syntax.types import DURATION

_LONGEST = 80
"""Length of a transition as the name of a frame, at most."""


@dataclass(frozen=True)
class Frame:
    """Frame of a stack: a state or a transition of a member, with its name."""

    member: int
    name: str
    place: Span | None
    state: str


class Inspection:
    """Looks into the run of some controls."""

    def __init__(self, controls: Controls) -> None:
        self._controls = controls
        self._system = controls.subject.system
        self._frames: list[Frame] = []
        self.references = References()
        controls.perform = self._perform

    def forget(self) -> None:
        """Forget frames and variables: the run goes on."""
        self._frames.clear()
        self.references.clear()

    # ---- stacks

    def threads(self) -> list[dict[str, Any]]:
        """Return a thread for each machine of a robot or of a part."""
        return [
            {"id": number + 1, "name": self.name(number)}
            for number in range(len(self._controls.cast))
        ]

    def name(self, member: int) -> str:
        """Return the name of a member."""
        actor = self._controls.cast[member]
        return actor.name or self._controls.subject.name

    def member(self, thread: int) -> int:
        """Return the member of a thread; raise RequestError if there is none."""
        if not 1 <= thread <= len(self._controls.cast):
            raise RequestError(f"there is no thread {thread}")
        return thread - 1

    def stack(self, member: int) -> list[tuple[int, Frame]]:
        """Return the frames of a member, the innermost state first, each with its number."""
        found = []
        for frame in self._stack(member):
            self._frames.append(frame)
            found.append((len(self._frames), frame))
        return found

    def frame(self, number: int) -> Frame:
        """Return a frame by its number; raise RequestError if it is not there any more."""
        if not 1 <= number <= len(self._frames):
            raise RequestError(f"there is no frame {number}")
        return self._frames[number - 1]

    def _stack(self, member: int) -> Iterator[Frame]:
        controls = self._controls
        actor = controls.cast[member]
        instance = controls.instances[actor]
        point = controls.point
        machine = actor.machine
        if instance.final is not None:
            state = machine.states[machine.numbers[instance.final]]
            yield self._frame(member, state, f"ended in {state.id}")
            yield from self._step(member)
            return
        element = point.element if point.member == member else None
        active = [state for state in machine.states[1:] if instance.active(state.id)]
        if isinstance(element, Transition):
            owner = machine.called(element).rpartition("->")[0]
            yield self._frame(member, element, self._text(element), owner)
        elif isinstance(element, State):
            yield self._frame(member, element)
            active = [state for state in active if state is not element]
        yield from (self._frame(member, state) for state in reversed(active))
        if not active and element is None:
            yield Frame(member, "not running", None, "")
        yield from self._step(member)

    def _step(self, member: int) -> Iterator[Frame]:
        """Yield the step of a test that drives the run, if any."""
        place = self._controls.step
        if place is not None:
            yield Frame(member, "step of the test", place.absolute, "")

    def _frame(
        self, member: int, element: Element, name: str = "", state: str | None = None
    ) -> Frame:
        place = self._controls.subject.place(element.origin)
        if isinstance(element, State):
            declared = element.origin
            is_region = isinstance(declared, Declared) and declared.kind is StateKind.REGION
            name = name or (f"region {element.id}" if is_region else element.id)
            state = element.id
        return Frame(member, name, place.absolute if place is not None else None, state or "")

    def _text(self, transition: Transition) -> str:
        """Return a transition as it is written, on one line."""
        place = self._controls.subject.place(transition.origin)
        words = " ".join(place.text.split()) if place is not None else ""
        return words if len(words) <= _LONGEST else f"{words[: _LONGEST - 3]}..."

    # ---- variables

    def scopes(self, frame: Frame) -> list[tuple[str, int]]:
        """Return the scopes of a frame that are not empty, each with its number."""
        member = frame.member
        actor = self._controls.cast[member]
        instance = self._controls.instances[actor]
        scopes = {
            "Variables": self._variables(actor, instance),
            "Params": self._params(actor, instance),
            "Event": self._event(member),
            "Robot": self._robot(actor, instance, frame),
        }
        return [
            (name, self.references.add(member, shown)) for name, shown in scopes.items() if shown
        ]

    def variables(self, member: int) -> Mapping[str, str]:
        """Return the variables of a member as texts."""
        actor = self._controls.cast[member]
        shown = self._variables(actor, self._controls.instances[actor])
        return {each.name: self.text(each) for each in shown}

    def text(self, shown: Shown) -> str:
        """Return the value of a variable as a text."""
        return shown.text or text_of(shown.value, shown.type, self._system)

    def type(self, shown: Shown) -> str:
        """Return the name of the type of a variable; empty if it is not known."""
        return type_text(shown.type)

    def _machine(self, actor: Actor) -> StateMachine | None:
        machines = self._system.machines_by_name if self._system is not None else {}
        return machines.get(actor.machine.name)

    def _variables(self, actor: Actor, instance: Instance) -> list[Shown]:
        machine = self._machine(actor)
        if machine is None:
            data = instance.data if isinstance(instance.data, Mapping) else {}
            return [Shown(str(name), value) for name, value in data.items() if _is_plain(value)]
        return [
            Shown(
                f"{each.owner}.{each.local}" if each.local else each.name,
                instance.data[each.name],
                each.type,
                expression=each.name,
                settable=True,
            )
            for each in machine.variables
            if each.name in instance.data
        ]

    def _params(self, actor: Actor, instance: Instance) -> list[Shown]:
        machine = self._machine(actor)
        params = machine.params if machine is not None else ()
        own = [
            Shown(each.name, instance.data[each.name], each.type, expression=each.name)
            for each in params
        ]
        names = {each.name for each in own}
        others = ((name, value) for name, value in actor.params.items() if name not in names)
        return [*own, *(Shown(name, value) for name, value in others)]

    def _event(self, member: int) -> list[Shown]:
        event = self._controls.event(member)
        if event is None or not event.name:
            return []
        shown = [Shown("name", event.name, text=event.name)]
        if event.envelope.sender:
            shown.append(Shown("sender", event.envelope.sender, expression="event.sender"))
            sent = event.envelope.sent
            shown.append(Shown("sent", sent, text=format_duration(sent)))
        data = event.data if isinstance(event.data, Mapping) else {}
        fields = (Shown(str(n), v, expression=f"event.{n}") for n, v in data.items())
        return [*shown, *fields]

    def _robot(self, actor: Actor, instance: Instance, frame: Frame) -> list[Shown]:
        controls = self._controls
        robot, world = actor.robot, controls.world
        shown = [Shown("time", world.clock.now, DURATION)]
        if robot.name is not None:
            identity = robot.identity.items()
            shown += [Shown(name, value, expression=f"self.{name}") for name, value in identity]
        place = world.space.at(robot)
        if place is not None:
            shown.append(Shown("place", [round(each, 3) for each in place]))
        for run in world.runs(actor):
            goal = run.goal if run.goal is not None else {}
            shown.append(Shown(f"{run.activity.name} (running)", goal, text="" if goal else "()"))
        machine = actor.machine
        number = machine.numbers.get(frame.state)
        if number and machine.states[number].timed and instance.active(frame.state):
            with suppress(KeyError):  # in the middle of the entry, which notes it
                elapsed = instance.elapsed(frame.state)
                shown.append(Shown("time in the state", elapsed, DURATION))
        return shown

    # ---- acts of the user

    def set(self, member: int, name: str, text: str) -> str:
        """Give a variable the value of an expression; return the value as a text."""
        controls = self._controls
        actor = controls.cast[member]
        machine = self._machine(actor)
        known = {each.name: each for each in machine.variables} if machine is not None else {}
        variable = known.get(name)
        if variable is None or self._system is None:
            raise RequestError(f"`{name}` is no variable of the machine: only these can be set")
        found = controls.evaluate(text, member)
        value = found.value
        if not fits(found.type, variable.type):
            wanted, given = type_text(variable.type), type_text(found.type)
            raise RequestError(f"`{name}` takes a value of type `{wanted}`, not of `{given}`")
        try:
            if variable.type != DURATION or not isinstance(value, int):
                value = fitted(variable.type, value, self._system, (name,))
        except MisfitError as error:
            report = Diagnostics()
            report.report(error.code, None, help=error.help, **error.fields)
            raise RequestError("; ".join(each.message for each in report)) from None
        controls.act(Deed(member=member, variable=name, value=value))
        return text_of(value, variable.type, self._system)

    def send(self, line: Mapping[str, Any]) -> list[str]:
        """Send an event as soon as the step is over; return the members that get it."""
        controls = self._controls
        read = read_event(line, controls.subject, controls.cast)
        controls.act(Deed(event=line))
        return [each.name or controls.subject.name for each in read.to]

    def _perform(self, deed: Deed) -> None:
        controls = self._controls
        if deed.event is None:
            controls.instances[controls.cast[deed.member]].data[deed.variable] = deed.value
            return
        read = read_event(deed.event, controls.subject, controls.cast)
        world = controls.world
        world.clock.schedule(0, lambda: world.deliver(read.event, read.data, read.to, read.sender))


def _is_plain(value: Any) -> bool:
    return value is None or isinstance(value, (bool, int, float, str, list, dict))
