"""A swarm with clocks, in which time passes for all robots together.

Messages on their way to a robot with clocks have an age. Robots without clocks, and what is on its
way to them, take any time.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.robot.timing import Bounds, Timing
from swarmdsl.execution.verify.swarm.groups import TICK, Clocked, Group, Step
from swarmdsl.execution.verify.swarm.network import Network

_KINDS = 1 << 20
"""Greater than the number of messages, which may grow."""


class TimedNetwork(Network):
    """Steps and ticks of a swarm; a message in a bag has its age in ticks beside its number."""

    def __init__(
        self,
        groups: Sequence[Group],
        alphabet: Alphabet,
        capacity: int,
        *,
        lossy: bool,
        timing: Timing,
        tick: int,
        base: int = 0,
    ) -> None:
        super().__init__(groups, alphabet, capacity, lossy=lossy, base=base, timing=timing)
        self.tick = tick
        self._latencies = timing
        self._times: dict[int, Bounds] = {}
        self._later: dict[int, int | None] = {}
        self._last: tuple[int, list[tuple[int, int]]] = (-1, [])

    def after(self, state: int, step: Step) -> int:
        """Return the state after a step or a tick."""
        if step is not TICK:
            return super().after(state, step)
        later = self.later(state)
        assert later is not None
        return later

    def present(self, state: int) -> list[tuple[int, int]]:
        """Return the places that are not empty, each with its number of robots."""
        # Steps and ticks ask for those of the same state.
        if self._last[0] != state:
            self._last = state, super().present(state)
        return self._last[1]

    def followers(self, state: int) -> Iterator[tuple[int, Step]]:
        """Yield the states after one step or a tick, each with the step."""
        yield from super().followers(state)
        later = self.later(state)
        if later is not None:
            yield later, TICK

    def later(self, state: int) -> int | None:
        """Return the state a tick later; None if something must happen before."""
        change = 0
        for place, count in self.present(state):
            if place not in self._later:
                self._later[place] = self._change(place)
            shift = self._later[place]
            if shift is None:
                return None
            change += count * shift
        return state + change

    def aged(self, group: int, state: int, bag: tuple[int, ...]) -> tuple[int, ...] | None:
        """Return the messages on their way to a robot a tick later; None if one must arrive."""
        automaton = self.groups[group].automaton
        if not isinstance(automaton, Clocked):
            return bag
        found = []
        for each in bag:
            age, message = divmod(each, _KINDS)
            least, most = self._time(message)
            if age == most and not automaton.is_late(state, message):
                return None
            oldest = least if most is None else most
            found.append(min(age + 1, oldest) * _KINDS + message)
        return tuple(sorted(found))

    # ---- internal

    def _change(self, number: int) -> int | None:
        """Return the difference that a tick makes to a robot at a place."""
        group, state, bag = self.places[number]
        automaton = self.groups[group].automaton
        later: int | None = state
        if isinstance(automaton, Clocked):
            later = automaton.later(state)
        old = self.aged(group, state, bag)
        if later is None or old is None:
            return None
        return self.ones[self.number(group, later, old)] - self.ones[number]

    def _time(self, message: int) -> Bounds:
        """Return the ticks after which a message can arrive, and after which it must."""
        if message not in self._times:
            repeats = self.alphabet.messages[message].repeats
            bounds = self._latencies.message(repeats=repeats)
            self._times[message] = _in_ticks(bounds, self.tick)
        return self._times[message]

    def message(self, each: int) -> int:
        """Return the message of an entry of a bag, without its age."""
        return each % _KINDS

    def _arrives(self, group: int, each: int) -> bool:
        age, message = divmod(each, _KINDS)
        is_clocked = isinstance(self.groups[group].automaton, Clocked)
        return not is_clocked or age >= self._time(message)[0]

    def _copy(self, each: int) -> int | None:
        return each

    def _with(
        self, group: int, state: int, bag: tuple[int, ...], message: int, sender: int
    ) -> tuple[int, ...]:
        """Return a bag with one more message, if the robot gets it; it is new."""
        young = tuple(each % _KINDS for each in bag)
        more = super()._with(group, state, young, message, sender)
        return bag if len(more) == len(bag) else tuple(sorted((*bag, message)))


def _in_ticks(bounds: Bounds, tick: int) -> Bounds:
    least, most = bounds
    return least // tick, most // tick if most is not None else None
