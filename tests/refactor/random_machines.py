"""Random state machines as text: nested, with regions, histories, timers and comments."""

from __future__ import annotations

from random import Random

_PRELUDE = """\
package test

action Try { }
function attempt : abstraction { action "attempt" : Try }
event Here : std_msgs/Empty
event More : std_msgs/Empty
swarm event Go : std_msgs/Empty
swarm event Stop : std_msgs/Empty
swarm event Tick : std_msgs/Empty
"""
_EVENTS = ("Go", "Go", "Stop", "Stop", "Tick")


def random_model(seed: int) -> str:
    """Return a model with one machine."""
    return _Writer(Random(seed)).model()


class _Writer:
    """Writes a machine; names of states are unique, but for some."""

    def __init__(self, chance: Random) -> None:
        self._chance = chance
        self._number = 0
        # A machine has a few of these, so that not all of them stand in the way of each other.
        self._local, self._defers, self._guards, self._time, self._common, self._variables = (
            chance.random() < share for share in (0.3, 0.2, 0.3, 0.4, 0.6, 0.5)
        )

    def model(self) -> str:
        body = self._body(0, "M", [])
        return (
            f"{_PRELUDE}\nstatemachine M {{\n  var n : int32 = 0\n  var k : int32 = 0\n{body}\n"
            "  final End\n}\n\nmember Robot { behavior M }\n"
        )

    def _maybe(self, share: float) -> bool:
        return self._chance.random() < share

    def _name(self) -> str:
        self._number += 1
        return f"S{self._number}"

    def _body(self, depth: int, owner: str, around: list[str]) -> str:
        names = [
            self._name() for _ in range(self._chance.randint(1 if depth else 2, 4 - depth // 2))
        ]
        targets = [*names, *names, *around, *(["End"] if depth == 0 else [])]
        pieces = [f"initial {names[0]}"]
        if depth and self._maybe(0.12):
            deep = "deep " if self._maybe(0.5) else ""
            back = self._name()
            pieces.append(f"{deep}history {back}")
            targets.append(f"{owner}.{back}" if self._maybe(0.5) else back)
        if self._maybe(0.15):
            choice = self._name()
            pieces.append(
                f"choice {choice} {{\n[self.index < 2] -> {names[-1]}\n"
                f"else / {self._effect()} -> {self._chance.choice(names)}\n}}"
            )
            targets.append(choice)
        if depth and self._maybe(0.2):
            final = self._name()
            pieces.append(f"final {final}")
            targets.append(final)
        common = [self._transition(targets) for _ in range(2)] if self._common else []
        states = [self._state(each, depth, targets, common) for each in names]
        self._chance.shuffle(states)
        return "\n".join(map(self._commented, [*pieces, *states]))

    def _state(self, name: str, depth: int, targets: list[str], common: list[str]) -> str:
        kind = self._chance.random()
        lines = []
        if depth < 2 and kind < 0.3:
            lines.append(self._body(depth + 1, name, targets))
            if "final S" in lines[0] and self._maybe(0.7):
                lines.append(f"on done -> {self._target(targets)}")
        elif depth < 2 and kind < 0.38:
            regions = (
                f"region R{self._name()} {{\n{self._body(depth + 1, name, [])}\n}}"
                for _ in range(2)
            )
            lines += regions
            head = f"parallel state {name}"
            return self._with(head, [*lines, *self._items(targets, common)])
        elif kind < 0.5:
            lines += [
                "do attempt",
                f"on succeeded -> {self._target(targets)}",
                "on aborted, preempted",
            ]
            lines[-1] += f" -> {self._target(targets)}"
        return self._with(f"state {name}", [*lines, *self._items(targets, common)])

    def _with(self, head: str, lines: list[str]) -> str:
        return f"{head} {{\n" + "\n".join(map(self._commented, lines)) + "\n}" if lines else head

    def _items(self, targets: list[str], common: list[str]) -> list[str]:
        lines = []
        if self._defers and self._maybe(0.2):
            lines.append(f"defer {self._chance.choice(_EVENTS)}")
        if self._maybe(0.1):
            lines.append(f"entry / {self._effect()}")
        if self._maybe(0.1):
            lines.append(f"exit / {self._effect()}")
        lines += [self._transition(targets) for _ in range(self._chance.randint(0, 2))]
        if self._time and self._maybe(0.2):
            lines.append(f"after {self._chance.choice((1, 2, 5))} s -> {self._target(targets)}")
        if self._guards and self._variables and self._maybe(0.2):
            lines.append(f"[n > 2] / n = 0 -> {self._target(targets)}")
        if self._maybe(0.7):
            lines += common
        return lines

    def _transition(self, targets: list[str]) -> str:
        events = self._chance.choice(_EVENTS)
        if self._local and self._maybe(0.3):
            events = self._chance.choice(("Here", "More"))
        if self._maybe(0.15):
            events += ", " + self._chance.choice([each for each in _EVENTS if each != events])
        guard = ""
        if self._maybe(0.25):
            guards = ("n < 2", "k == 0", "n > k", "elapsed() > 1 s")
            guard = f" [{self._chance.choice(guards if self._variables else guards[-1:])}]"
        effects = f" / {self._effect()}" if self._maybe(0.3) else ""
        if effects and self._maybe(0.2):
            return f"on {events}{guard}{effects}"
        return f"on {events}{guard}{effects} -> {self._target(targets)}"

    def _effect(self) -> str:
        if self._local and self._maybe(0.4):
            return self._chance.choice(("send Here", "send More", "send Here, send More"))
        if not self._variables:
            return "send Tick"
        return self._chance.choice(
            ("n = n + 1", "k = k * 3 % 7 + n", "n = 0", "send Tick", "k = k + 1")
        )

    def _target(self, targets: list[str]) -> str:
        return self._chance.choice(targets)

    def _commented(self, text: str) -> str:
        """Put comments around a statement, each of its own words."""
        if self._maybe(0.15):
            self._number += 1
            text = f"{self._chance.choice(('//', '///'))} above {self._number}\n{text}"
        if self._maybe(0.15):
            self._number += 1
            text = f"{text}  // behind {self._number}"
        return f"\n{text}" if self._maybe(0.2) else text
