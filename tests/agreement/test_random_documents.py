"""Documents made by chance do the same in every engine.

They have all that SCXML says of states and transitions, histories in regions and conditions
on states among it, and are made without what some engine is known to do otherwise: regions that
disagree about an event, parallel states before others, and a parallel state at the top.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable

import pytest

from swarmdsl.execution.engine import LoopError

from .engines import ENGINES, Document, Step
from .replay import difference, installed
from .scripts import Script

FEW, MANY = 25, 80
"""Numbers of documents; many with `--agreement`."""
WALKS, STEPS = 4, 15
EVENTS = ("a", "b", "c")


class Maker:
    """Makes a document by throwing dice."""

    def __init__(self, seed: int) -> None:
        self.dice = random.Random(seed)
        self.count = 0
        self.inside: dict[str, list[str]] = {}
        self.tree = ("state", "s0", [self.shape(3) for _ in range(self.dice.randrange(2, 5))])
        self._note(self.tree)

    def shape(self, depth: int, region: bool = False) -> tuple[str, str, list]:
        """A state and what is in it, without transitions."""
        self.count += 1
        name = f"s{self.count}"
        chance = self.dice.random()
        if not region and depth < 3 and chance < 0.12:
            return "final", name, []
        if depth == 0 or (chance < 0.45 and not region):
            return "state", name, []
        kind = "parallel" if chance > 0.7 and not region else "state"
        number = self.dice.randrange(2 if kind == "parallel" else 1, 4)
        inner = [self.shape(depth - 1, kind == "parallel") for _ in range(number)]
        if self.dice.random() < 0.5:
            inner.append(("history", f"h{name}", []))
        order = ["history", "state", "final", "parallel"]
        return kind, name, sorted(inner, key=lambda each: order.index(each[0]))

    def _note(self, shape: tuple[str, str, list]) -> list[str]:
        """Note what is inside of each state."""
        _, name, inner = shape
        self.inside[name] = [below for each in inner for below in self._note(each)]
        return [name, *self.inside[name]]

    @property
    def document(self) -> bytes:
        body = self.state(self.tree, "s0")
        head = 'xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"'
        return f"<scxml {head}>{body}</scxml>".encode()

    def state(self, shape: tuple[str, str, list], region: str) -> str:
        """The element of a state whose transitions lead to what is in `region`."""
        kind, name, inner = shape
        if kind == "history":
            depth = self.dice.choice(["deep", "shallow"])
            around = name.removeprefix("h")
            ways = [each for each in self.inside[around] if not each.startswith("h")]
            if depth == "shallow":
                ways = [each for each in ways if each in self.children[around]]
            target = self.dice.choice(ways)
            return f'<history id="{name}" type="{depth}"><transition target="{target}"/></history>'
        self.children = {**getattr(self, "children", {}), name: [each[1] for each in inner]}
        parts = []
        if self.dice.random() < 0.1:
            parts.append(f'<onentry><raise event="{self.dice.choice(EVENTS)}"/></onentry>')
        if kind != "final":
            parts += [self.transition(name, region) for _ in range(self.dice.randrange(1, 5))]
        parts += [self.state(each, each[1] if kind == "parallel" else region) for each in inner]
        states = [each[1] for each in inner if each[0] != "history"]
        initial = f' initial="{self.dice.choice(states)}"' if states and kind == "state" else ""
        return f'<{kind} id="{name}"{initial}>{"".join(parts)}</{kind}>'

    def transition(self, name: str, region: str) -> str:
        """A transition of a state; that of a region leads to what is in it."""
        chance = self.dice.random()
        event = f' event="{self.dice.choice(EVENTS)}"'
        if chance < 0.04:
            event = ""
        elif chance < 0.15:
            event = f' event="{self.dice.choice(["done.state", "*", "a b", "done.state.s1"])}"'
        targets = self.inside[region]
        led = self.dice.choice(targets) if targets and self.dice.random() < 0.9 else ""
        target = f' target="{led}"' if led else ""
        condition = ""
        if self.dice.random() < 0.35 or not (event and target):
            state = self.dice.choice([each for each in self.inside if not each.startswith("h")])
            condition = f" cond=\"{self.dice.choice(['', '!'])}In('{state}')\""
        # What is not internal would leave the region itself, and the others with it.
        inward = led in self.inside[name] and (name == region or self.dice.random() < 0.3)
        internal = ' type="internal"' if inward else ""
        raised = f'<raise event="{self.dice.choice(EVENTS)}"/>' if self.dice.random() < 0.05 else ""
        return f"<transition{event}{condition}{target}{internal}>{raised}</transition>"


def script(document: bytes, dice: random.Random) -> Script:
    """Record our engine on random events, up to the first endless loop."""
    engine = Document(document)
    steps, expected = [], [engine.active]
    while engine.instance.running and len(steps) < STEPS:
        step = Step(dice.choice(EVENTS))
        try:
            engine.take(step)
        except LoopError:
            break
        steps.append(step)
        expected.append(engine.active)
    return Script(tuple(steps), tuple(expected))


def test_engines_agree_about_documents(
    agree: Callable[..., None], pytestconfig: pytest.Config
) -> None:
    scripts: Counter[str] = Counter()
    for seed in range(MANY if pytestconfig.getoption("--agreement") else FEW):
        document = Maker(seed).document
        dice = random.Random(seed)
        try:
            made = [script(document, dice) for _ in range(WALKS)]
        except LoopError:
            continue
        for engine in installed():
            found = [difference(ENGINES[engine], document, each) for each in made]
            assert found == [None] * len(found), (engine, document.decode())
            scripts[engine] += len(found)
    for engine, number in scripts.items():
        agree("documents made by chance", engine, number, number)
