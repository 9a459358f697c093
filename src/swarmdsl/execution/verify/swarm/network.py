"""A swarm as counters: how many robots of each group are in which state, in one integer.

Robots that nothing tells apart are a group; of these only the numbers count. A group of one robot
is a robot by itself. The network keeps what is on its way to a robot as a bag: messages arrive in
any order. Of more than `capacity` messages of one event, the rest is lost.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.robot.timing import Timing
from swarmdsl.execution.verify.swarm.groups import Group, Place, Step, without
from swarmdsl.ir import Heartbeat


class Network:
    """Steps of a swarm, over packed states.

    The number of robots at place `n` has `width` bits, in the order of the places. The `base`
    lowest bits are free for an observer. Between them is a sum of numbers, one for each robot by
    its place: Python hashes an integer modulo 2**61 - 1, so that counters alone would have few
    different hashes.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        alphabet: Alphabet,
        capacity: int,
        *,
        lossy: bool,
        base: int = 0,
        timing: Timing | None = None,
        eager: bool = False,
        lonely: bool = False,
        faults: int = 0,
        spared: str | None = None,
        heartbeat: Heartbeat | None = None,
        latencies: Timing | None = None,
    ) -> None:
        self.groups = groups
        self.alphabet = alphabet
        self.capacity = capacity
        self.lossy = lossy
        self.base = base
        self.timing = timing
        """Times that runs must fit; None if functions and events take any time."""
        self.eager = eager
        """True if only runs are looked at in which messages arrive before anything else happens."""
        self._lonely = lonely
        """True if only runs are looked at in which nobody is near another robot, or takes one for
        lost that it could hear."""
        self.faults = faults
        """Number of robots that can be lost."""
        self._spared = spared
        self.heartbeat = heartbeat
        self.latencies = timing or latencies
        """Times that events between robots take; None for any."""
        self._gone: set[int] = set()
        """Places of lost robots."""
        self._losses: dict[int, list[Step]] = {}
        self._rotten: dict[int, list[Step]] = {}
        self.width = max(len(group.robots) for group in groups).bit_length()
        self.mask = (1 << self.width) - 1
        self._counters = base + _SALT.bit_length() + sum(len(g.robots) for g in groups).bit_length()
        """The first bit of the counters."""
        self.places: list[Place] = []
        self.ones: list[int] = []
        """A robot at each place, as a summand."""
        self.steps: list[list[Step] | None] = []
        self.plain: list[list[int]] = []
        """Differences that the steps without messages of a place make."""
        self.casts: list[list[tuple[int, dict[int, int], tuple[int, ...], int]]] = []
        """Those with messages: difference, differences that the messages make to robots by their
        places, as far as known, messages, and group of the sender."""
        self.full: Counter[str] = Counter()
        """Events of which messages were lost because there were too many."""
        self._overflows: set[tuple[int, tuple[int, ...], int]] = set()
        """Places at which messages of a group exceed the capacity."""
        self.cut = False
        """True if a state was reached whose moves are not known."""
        self._numbers: dict[Place, int] = {}
        self._heard: dict[tuple[tuple[int, ...], int], dict[int, int]] = {}

    # ---- states

    def start(self) -> int:
        """Return the state in which all robots have started."""
        state = 0
        for number, group in enumerate(self.groups):
            first = group.automaton.first
            bag: tuple[int, ...] = ()
            for other, source in enumerate(self.groups):
                senders = len(source.robots) - (source is group)
                for _ in range(min(senders, self.capacity + 1)):
                    for message in source.automaton.first.sends:
                        bag = self._with(number, first.target, bag, message, other)
            ended = group.automaton.ended(first.target)
            place = self.number(number, first.target, () if ended else bag)
            state += len(group.robots) * self.ones[place]
        return state

    def number(self, group: int, state: int, bag: tuple[int, ...]) -> int:
        """Return the number of a place."""
        place = Place(group, state, bag)
        found = self._numbers.get(place)
        if found is None:
            found = self._numbers[place] = len(self.places)
            self.places.append(place)
            one = 1 << (self._counters + found * self.width)
            self.ones.append(one + (pow(_ROOT, found, _SALT) << self.base))
            self.steps.append(None)
            self.plain.append([])
            self.casts.append([])
            if self.faults and self.groups[group].automaton.is_lost(state):
                self._gone.add(found)
        return found

    def present(self, state: int) -> list[tuple[int, int]]:
        """Return the places that are not empty, each with its number of robots."""
        width, mask = self.width, self.mask
        state >>= self._counters
        found = []
        if len(self.places) <= _FEW:
            for place in range(len(self.places)):
                count = state >> place * width & mask
                if count:
                    found.append((place, count))
            return found
        while state:
            place = ((state & -state).bit_length() - 1) // width
            count = state >> place * width & mask
            found.append((place, count))
            state ^= count << place * width
        return found

    def is_waiting(self, step: Step, present: Sequence[tuple[int, int]]) -> bool:
        """Return True if a step must wait for messages that arrive first."""
        if not self.eager or step.move is None or step.move.given.kind == "hear":
            return False
        return any(
            other.move is not None and other.move.given.kind == "hear"
            for place, _ in present
            if self.places[place].bag
            for other in self.row(place)
        )

    def followers(self, state: int) -> Iterator[tuple[int, Step]]:
        """Yield the states after one step, each with the step."""
        present = self.present(state)
        for place, _ in present:
            for step in self.row(place):
                yield self.after(state, step), step
        for step in self.risks(present):
            yield self.after(state, step), step

    def is_looked_at(self, move: Move | None) -> bool:
        """Return True if a move does not suppose what is left out here."""
        return not (self._lonely and move is not None and move.supposes)

    def ended(self, state: int) -> bool:
        """Return True if all robots have ended."""
        return all(
            self.groups[place.group].automaton.ended(place.state)
            for place in (self.places[number] for number, _ in self.present(state))
        )

    # ---- steps

    def risks(self, present: Sequence[tuple[int, int]]) -> Iterator[Step]:
        """Yield the steps at which a robot is lost, or a reliable message of one that was."""
        if not self.faults:
            return
        lost = sum(count for place, count in present if place in self._gone)
        for place, _ in present:
            if lost < self.faults:
                yield from self._losses_at(place)
            if lost and self.lossy:
                yield from self._rotten_at(place)

    def _losses_at(self, number: int) -> list[Step]:
        """Return the loss of a robot at a place, if it can be lost."""
        found = self._losses.get(number)
        if found is None:
            group, state, _ = self.places[number]
            loss = self.groups[group].automaton.loss(state)
            found = self._losses[number] = []
            if loss is not None and self.groups[group].robots != (self._spared,):
                found.append(Step(number, loss, self.number(group, loss.target, ())))
        return found

    def _rotten_at(self, number: int) -> list[Step]:
        """Return the losses of messages that are sent again, as long as their sender is there."""
        found = self._rotten.get(number)
        if found is None:
            group, state, bag = self.places[number]
            messages = [self.alphabet.messages[each] for each in dict.fromkeys(bag)]
            found = self._rotten[number] = [
                Step(
                    number, None, self.number(group, state, without(bag, each.number)), each.number
                )
                for each in messages
                if each.reliable and not each.is_heartbeat
            ]
        return found

    def row(self, number: int) -> list[Step]:
        """Return the steps of a robot at a place."""
        found = self.steps[number]
        if found is None:
            every = self._find(number)
            found = self.steps[number] = [each for each in every if self.is_looked_at(each.move)]
            plain: dict[int, None] = {}
            casts: dict[tuple[int, tuple[int, ...], int], None] = {}
            group = self.places[number].group
            for step in found:
                change = self.ones[step.target] - self.ones[number]
                heard = self.heard(step)
                if heard:
                    casts[change, heard, group] = None
                elif change:
                    plain[change] = None
            self.plain[number] = list(plain)
            self.casts[number] = [
                (change, self.shifts(sends, sender), sends, sender)
                for change, sends, sender in casts
            ]
        return found

    def cast(self, state: int, sends: tuple[int, ...], sender: int) -> int:
        """Return the difference that messages make, also to their sender."""
        return sum(
            count * self.shift_of(place, sends, sender) for place, count in self.present(state)
        )

    def shift_of(self, place: int, sends: tuple[int, ...], sender: int) -> int:
        """Return the difference that messages make to a robot at a place."""
        shifts = self.shifts(sends, sender)
        found = shifts.get(place)
        if found is None:
            group, state, bag = self.places[place]
            before = self.full.total()
            for message in sends:
                bag = self._with(group, state, bag, message, sender)
            if self.full.total() > before:
                self._overflows.add((place, sends, sender))
            found = self.ones[self.number(group, state, bag)] - self.ones[place]
            shifts[place] = found
        return found

    def overflows(self, state: int, step: Step) -> bool:
        """Return True if messages of a step are lost for lack of capacity."""
        heard, group = self.heard(step), self.places[step.place].group
        return any((place, heard, group) in self._overflows for place, _ in self.present(state))

    def shifts(self, sends: tuple[int, ...], sender: int) -> dict[int, int]:
        """Return the known differences that messages make, by place."""
        return self._heard.setdefault((sends, sender), {})

    def after(self, state: int, step: Step) -> int:
        """Return the state after a step."""
        change = self.ones[step.target] - self.ones[step.place]
        heard = self.heard(step)
        if heard:
            group = self.places[step.place].group
            change += self.cast(state, heard, group) - self.shift_of(step.place, heard, group)
        return state + change

    def heard(self, step: Step) -> tuple[int, ...]:
        """Return the messages of a step that another robot can get."""
        sends = step.move.sends if step.move is not None else ()
        group = self.places[step.place].group
        return tuple(m for m in sends if self._somebody_hears(m, group))

    def _find(self, number: int) -> Iterator[Step]:
        group, state, bag = self.places[number]
        automaton = self.groups[group].automaton
        moves = automaton.moves(state)
        if moves is None:
            self.cut = True
            return
        for move in moves:
            yield Step(number, move, self._target(group, move.target, bag))
        for each in dict.fromkeys(bag):
            message = self.message(each)
            rest = without(bag, each)
            heard = automaton.moves_on(state, message)
            if not heard and automaton.is_late(state, message):
                continue
            if not heard:
                self.cut = True
                continue
            for move in heard if self._arrives(group, each) else ():
                yield Step(number, move, self._target(group, move.target, rest), self._copy(each))
            if self.lossy and not self.alphabet.messages[message].reliable:
                yield Step(number, None, self.number(group, state, rest), each)

    def message(self, each: int) -> int:
        """Return the message of an entry of a bag."""
        return each

    def _arrives(self, group: int, each: int) -> bool:
        """Return True if an entry of a bag can arrive at a robot of a group now."""
        return True

    def _copy(self, each: int) -> int | None:
        """Return the entry of a bag that arrives, where its message does not tell."""
        return None

    def _target(self, group: int, state: int, bag: tuple[int, ...]) -> int:
        ended = self.groups[group].automaton.ended(state)
        return self.number(group, state, () if ended else bag)

    def _somebody_hears(self, message: int, sender: int) -> bool:
        source = self.groups[sender]
        return any(group.hears(message, source) for group in self.groups)

    def _with(
        self, group: int, state: int, bag: tuple[int, ...], message: int, sender: int
    ) -> tuple[int, ...]:
        """Return a bag with one more message, if the robot gets it."""
        if not self.groups[group].hears(message, self.groups[sender]):
            return bag
        if self.groups[group].automaton.ended(state):
            return bag
        messages = self.alphabet.messages
        name = messages[message].event.name
        is_rare = messages[message].is_heartbeat
        if not is_rare and sum(messages[each].event.name == name for each in bag) >= self.capacity:
            self.full[name] += 1
            return bag
        return tuple(sorted((*bag, message)))


_SALT, _ROOT = 16_777_213, 5
"""A prime, and a number whose powers modulo the prime have different sums."""
_FEW = 40
"""Number of places up to which looking at all of them is the fastest."""
