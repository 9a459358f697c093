"""Automaton of one robot, found by running its machines on each input in each state."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from itertools import chain
from operator import or_
from typing import Any, TypeVar

from swarmdsl.execution.engine import Envelope, Event
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.automata.bodies import Bodies, is_unchanged, take_back
from swarmdsl.execution.verify.automata.labels import Look, Move, Slot
from swarmdsl.execution.verify.automata.observations import moments_of
from swarmdsl.execution.verify.automata.slots import Occupied, carried, occupied
from swarmdsl.execution.verify.automata.state_key import StateKey
from swarmdsl.execution.verify.automata.valuation import Valuation
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.presence import Presence
from swarmdsl.execution.verify.robot.robot_kind import Kind
from swarmdsl.execution.verify.robot.tasks import Input, Task

Tried = TypeVar("Tried")


class Automaton:
    """States and moves of a kind of robot.

    `steps` are the moves of each state, None of those that were not looked at; `heard` are those
    that messages cause: one for each number of robots that may be near, if it asks for that. A
    robot keeps one deferred event of a name: more stay on their way, as `late`. Messages arrive in
    any order, so that this leaves out nothing.
    """

    def __init__(self, kind: Kind, alphabet: Alphabet) -> None:
        self.kind = kind
        self.alphabet = alphabet
        self.replays = 0
        self.is_too_large = False
        """True if it has more states, or moves, than are looked at."""
        self.asks_who_is_near = False
        self.steps: list[list[Move] | None] = []
        self.heard: list[dict[int, list[Move]]] = []
        self.late: list[set[int]] = []
        self.losses: list[Move | None] = []
        """For each state, the loss of the robot; None where it is lost, or cannot be."""
        self.is_lost: list[bool] = []
        self.first: Move
        self._key = StateKey(alphabet)
        self._keys: dict[Any, int] = {}
        self.bodies = Bodies(self._body_at_rest, self.apply)
        self.looks: list[Look] = []
        self.tasks: list[frozenset[Task]] = []
        """Tasks of each state: what is over some time, however long it takes."""
        self.slots: list[list[Slot]] = []
        """Running activities and delays of each state, in the order of its representative."""
        self._labels: list[list[Any]] = []
        self.deferred: list[set[str]] = []
        """Names of the deferred events of each state."""
        self.values: list[tuple[tuple[str, Any], ...]] = []
        """For each state, the values of the variables that decide on anything."""
        self._valuation = Valuation(kind)
        self._presence = Presence(kind, alphabet)
        self.gone = self._valuation.gone
        self._listening: dict[str, bool] = {}
        self._begin()

    # ---- finding the states

    def expand(self, number: int) -> None:
        """Find the moves of a state, without those that other robots cause."""
        body = self._at(number)
        inputs = [*body.inputs(), *self._presence.guesses(body)]
        if body.running:
            inputs += self._arriving(body)
        is_missed = self.kind.can_be_lost and not body.is_lost and self._shows_loss(body)
        self.bodies.keep_unchanged(number, body)
        made = []
        for each in inputs:
            for choice in self.kind.choices(each):
                made += self._tries(number, choice)
        self.steps[number] = made
        if is_missed:
            (self.losses[number],) = self._tries(number, Input("lose", -1, LOST))

    def hear(self, number: int, message: int) -> None:
        """Find the move of a state when a message arrives."""
        event = self.alphabet.messages[message].event
        given = Input("hear", -1, event.name, message)
        if event.name == DEPARTED and self._presence.departure(self._at(number), event) is None:
            # All of them are missed: it cannot be on its way.
            self.late[number].add(message)
        elif self._is_late(number, given):
            self.late[number].add(message)
        else:
            self.heard[number][message] = self._tries(number, given)

    def listens(self, message: int) -> bool:
        """Return True if a machine handles a message that can be for such a robot."""
        event = self.alphabet.messages[message].event
        name = event.name
        if name not in self._listening:
            self._listening[name] = self.kind.listens(name)
        if not self._listening[name]:
            return False
        robot = self.kind.cast[0].robot
        if self.alphabet.demands.identity:
            return robot.name != event.envelope.sender and robot.is_meant_by(event.envelope.to)
        to = event.envelope.to
        return to is None or to == robot.role or to.partition("[")[0] == robot.role

    def numbers_of_values(self) -> dict[str, int]:
        """Return how many values the variables have that decide on anything."""
        values: dict[str, set[Any]] = {}
        for each in self.values:
            for name, value in each:
                values.setdefault(name, set()).add(value)
        return {name: len(found) for name, found in values.items()}

    def every_move(self) -> Iterator[Move]:
        """Yield the start and the moves of all states, whatever the other robots do."""
        yield self.first
        yield from (loss for loss in self.losses if loss is not None)
        for steps, heard in zip(self.steps, self.heard, strict=True):
            yield from steps or ()
            yield from chain(*heard.values())

    def lengths(self) -> set[int]:
        """Return the lengths of all delays."""
        return {
            each.length
            for move in self.every_move()
            for each in move.carried
            if each.length is not None
        }

    def parts(self) -> Iterator[tuple[Any, Any]]:
        """Yield the active states and the deferred events of each state, unless it is lost."""
        for (key, _), lost in zip(self._keys, self.is_lost, strict=True):
            if not lost:
                yield tuple(each[:3] for each in key[0]), tuple(each[4] for each in key[0])

    @property
    def is_complete(self) -> bool:
        """True if all moves are known."""
        listened = [n for n in range(len(self.alphabet.messages)) if self.listens(n)]
        return all(
            steps is not None and all(number in heard or number in late for number in listened)
            for steps, heard, late in zip(self.steps, self.heard, self.late, strict=True)
        )

    def _arriving(self, body: Body) -> Iterator[Input]:
        """Yield the events from outside that may still come."""
        for event, messages in self.kind.outside.messages.items():
            once = self.kind.outside.once.get(event, frozenset())
            for index in range(len(messages)):
                if index not in once or (event, index) not in body.used:
                    yield Input("outside", -1, event, index)

    # ---- running

    def apply(self, body: Body, given: Input, event: Event | None = None) -> None:
        """Let an input happen to a body; `event` is the very one that arrives."""
        body.near.choose(given.near)
        match given.kind:
            case "end":
                state, outcome, result = given.choice
                values = self.kind.ends[given.name].results
                body.end(
                    given._replace(choice=state),
                    outcome,
                    values[result] if result is not None else None,
                )
            case "time":
                body.fire(given)
            case "inside":
                body.deliver_inside()
            case "outside":
                messages = self.kind.outside.messages[given.name]
                if given.choice in self.kind.outside.once.get(given.name, ()):
                    body.used.add((given.name, given.choice))
                body.receive(Event(given.name, messages[given.choice]))
            case "lose":
                body.lose()
            case "return":
                body.come_back()
            case "view":
                body.receive(self._presence.guessed(body, given))
            case "hear":
                body.receive(event or self._heard_event(body, given.choice))

    def _shows_loss(self, body: Body) -> bool:
        """Return True if anybody can tell that a robot is lost; not of all machines that ended.

        One that starts anew is lost as often as the scenario has it.
        """
        if self.kind.absences:
            return len(body.absences) < len(self.kind.absences)
        return body.running or self.kind.has_heartbeat

    def _heard_event(self, body: Body, message: int) -> Event:
        event = self.alphabet.messages[message].event
        if event.name == DEPARTED:
            found = self._presence.departure(body, event)
            assert found is not None, "nobody is given up twice"
            return found
        envelope = Envelope(event.envelope.sender, 0, event.envelope.to)
        return Event(event.name, event.data, envelope=envelope)

    def _at(self, number: int) -> Body:
        """Return a body in a state."""
        self.replays += 1
        return self.bodies.at(number)

    def _body_at_rest(self) -> Body:
        kind = self.kind
        system = self.alphabet.system
        clock = Clock()
        return Body(kind.cast, system, clock, kind.crew, kind.silent, kind.others, kind.absences)

    def _begin(self) -> None:
        body = self._body_at_rest()
        given = Input("start", -1, "")
        self.first = self._move(body, given, body.start, [0] * len(self.kind.cast), None)
        self.asks_at_start = body.near.is_asked

    def _is_late(self, number: int, given: Input) -> bool:
        """Return True if an event would be deferred after another one, so that it may as well wait.

        It must not if a machine of the robot does anything else with it.
        """

        def is_deferred(body: Body, each: Input) -> bool:
            self.apply(body, each)
            return all(line.deferred for line in body.lines)

        if given.name not in self.deferred[number]:
            return False
        return all(self._each(number, given, is_deferred))

    def _tries(self, number: int, given: Input) -> list[Move]:
        """Return the moves on an input."""

        def move(body: Body, each: Input) -> Move:
            held = list(self.looks[number].held)
            return self._move(body, each, lambda: self.apply(body, each), held, number)

        return list(self._each(number, given, move))

    def _each(
        self, number: int, given: Input, act: Callable[[Body, Input], Tried]
    ) -> Iterator[Tried]:
        """Let a robot act on an input, for each number of robots nearby, the fewest first."""
        todo: deque[tuple[int, ...]] = deque([()])
        while todo:
            body = self._at(number)
            known = len(self.steps)
            yield act(body, given._replace(near=todo.popleft()))
            todo += body.near.others()
            self.asks_who_is_near |= body.near.is_asked
            self.is_too_large |= body.near.has_too_many
            if known < len(self.steps):
                self.bodies.keep_new(known, body)
            elif self._changes_nothing(given, body):
                take_back(body)
                self.bodies.keep_unchanged(number, body)

    def _changes_nothing(self, given: Input, body: Body) -> bool:
        """Return True if a body is as before an input."""
        is_event = given.kind in ("hear", "outside") and given.name not in (JOINED, DEPARTED)
        return is_event and not self.kind.outside.once.get(given.name) and is_unchanged(body)

    def _move(
        self,
        body: Body,
        given: Input,
        act: Callable[[], None],
        held: list[int],
        source: int | None,
    ) -> Move:
        """Let a body act, and return what that shows; `held` are the facts of its machines."""
        shown: list[tuple[int, int]] = []
        numbers = {actor.name: n for n, actor in enumerate(body.cast)}

        def see(line: Line) -> None:
            actor = numbers[line.actor.name]
            held[actor], momentary = self._valuation.at(line, body)
            if line.event == LOST:
                # No fact holds for a lost robot.
                held[:] = [self.gone] + [0] * (len(held) - 1)
            shown.append((actor, reduce(or_, held, momentary)))

        body.seen = see
        if given.kind == "return":
            held[:] = [0] * len(held)
        before, running = list(body.tasks()), occupied(body, self._key.waiting)
        act()
        left = {id(each) for _, each in body.tasks()}
        ended = frozenset(task for task, each in before if id(each) not in left)
        moments = moments_of(body, shown)
        sends = tuple(map(self.alphabet.number, body.sent))
        origin = None if source is None else (source, given)
        after = occupied(body, self._key.waiting)
        target = self._add(body, tuple(held), origin, after)
        taken = carried(running, after, self._labels[target])
        return Move(given, moments, sends, target, ended, taken)

    def _add(
        self,
        body: Body,
        held: tuple[int, ...],
        origin: tuple[int, Input] | None,
        running: Sequence[Occupied],
    ) -> int:
        key = (self._key.of(body), held)
        if key not in self._keys:
            self._keys[key] = len(self.steps)
            self.steps.append(None)
            self.losses.append(None)
            self.is_lost.append(body.is_lost)
            self.heard.append({})
            self.late.append(set())
            self.deferred.append(
                {each.name for one in body.instances for each in one._deferred or ()}
            )
            self.bodies.add(origin)
            shown = [
                (number, state)
                for number, instance in enumerate(() if body.is_lost else body.instances)
                for state in (
                    [instance.final]
                    if instance.final is not None
                    else instance.configuration.innermost
                )
            ]
            quiet = not (body.runs or body.delays or body.inside)
            holding = reduce(or_, held, 0)
            self.looks.append(Look(not body.running, holding, tuple(shown), quiet, held))
            self.tasks.append(frozenset(task for task, _ in body.tasks()))
            self.slots.append([each.slot for each in running])
            self._labels.append([each.label for each in running])
            self.values.append(self._key.kept(body))
        return self._keys[key]
