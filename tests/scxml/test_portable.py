"""A model and the portable document made of it do the same, whatever happens to them."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.exchange import scxml
from swarmdsl.codegen.exchange.scxml.ecmascript import SELF
from swarmdsl.codegen.exchange.scxml.ids import data_ids, state_ids
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.codegen.shared.identity import uses_self
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Envelope, Event, Instance, Machine, Observer, Run, Transition
from swarmdsl.execution.scxml import read
from swarmdsl.execution.simulate.machines.machine_data import first_data
from swarmdsl.execution.simulate.machines.table import table
from swarmdsl.ir import Action, Array, Primitive, Service, System

from ..agreement.scripts import as_headers_say
from ..engine.world import StillWorld
from ..exchange.scxml_machines import with_documents

ROOT = Path(__file__).resolve().parents[2]
MODELS = [
    *(ROOT / "examples" / "search_and_rescue", ROOT / "examples" / "minimal"),
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
]
WALKS, STEPS = 8, 40

# What the models above have little of: results, and what happens while they are stored.
LIVELY = """
package lively
action Go { goal { speed : float64 } result { count : int32, name : string } }
message Report { id : string, level : int32 }
message Nothing { }
function go : abstraction { action "cmd/go" : Go }
function look : abstraction { action "cmd/look" : Go }
event Start : Nothing
event Stop : Nothing
event Found : Report
endless statemachine Lively {
  param speed : float64 = 0.5
  var n : int32 = 0
  var sum : int32 = 0
  var last : Report
  var word : string
  initial Work
  state Work {
    entry / sum = sum + 1
    exit / sum = sum + n, last.level = n
    initial Go
    state Go {
      do go(speed = speed * n) gives (count => n, name => last.id)
      exit / word = last.id + "!"
      on succeeded [n % 3 == 0] -> Look
      on succeeded -> Go
      on aborted / n = n - 1 -> Fork
      after 1 s [n > 4] -> Look
      after 2 s -> Fork
    }
    state Look {
      do look(speed = 1.0) gives (count => last.level)
      exit / sum = sum + last.level
      on succeeded / n = last.level -> Fork
      on aborted -> Over
      on preempted -> Go
      on Stop / n = n * 2
    }
    choice Fork { [n > 5] / n = 0 -> Both; [n < 0] / n = 1 -> Go; else -> Over }
    parallel state Both {
      region L {
        initial A
        state A {
          do go(speed = 2.0) gives (count => n)
          on succeeded, Stop -> B
          on aborted -> B
        }
        state B { on Found [event.level > 3] / last = event -> E; on Start -> A }
        final E
      }
      region R {
        initial C
        state C { do look(speed = sum); on succeeded -> D; on aborted -> C }
        state D { on Start -> C; on Stop -> F; after 1500 ms -> G }
        final F
        final G
      }
      internal on Start [n > 2] / n = n - 1 -> A
      internal on Found / sum = sum - 1 -> C
      on R.done.G -> Look
      on done -> Over
    }
    final Over
    deep history Back -> Look
    history Near -> Go
    on done -> Rest
    on Stop [sum > 30] / sum = 0 -> Rest
    internal on Found [event.level == 1] -> Look
  }
  state Rest {
    on Start -> Work.Back
    on Stop -> Work.Near
    on Found / send Found(level = n + event.level, id = word) -> Work
    after 3 s -> Work.Both.B
    [n > 12] / n = 0 -> Work
  }
}
"""


class World(StillWorld):
    """Remembers the runs that have not ended, and lets those that are cancelled stop at once."""

    def __init__(self) -> None:
        super().__init__()
        self.going: list[Run] = []
        self.sent: list[Event] = []

    def send(self, instance: Instance, event: Event) -> None:
        self.sent.append(event)

    def start(self, run: Run) -> None:
        super().start(run)
        self.going.append(run)

    def cancel(self, run: Run) -> None:
        super().cancel(run)
        self.going.remove(run)
        run.end("preempted")


class Runner:
    """One of the two."""

    def __init__(self, machine: Machine, data: dict[str, Any] | None = None) -> None:
        self.world = World()
        self.instance = Instance(machine, self.world, data=data)

    def told(self) -> Any:
        return (
            self.instance.configuration.innermost,
            self.instance.final,
            {name: plain(value) for name, value in self.instance.data.items()},
            [(run.activity.name, plain(run.goal)) for run in self.world.going],
        )


def plain(value: Any) -> Any:
    """A value in which numbers of the two are the same; durations are in other units."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, list):
        return [plain(each) for each in value]
    return round(value, 9) if isinstance(value, float) else value


def random_value(type_: ir.Type, system: System, dice: random.Random) -> Any:
    """A value of a type, mostly small."""
    match type_:
        case Primitive(name="bool"):
            return dice.random() < 0.5
        case Primitive(name="string" | "wstring"):
            return dice.choice(["", "a", "b"])
        case Primitive(name="float32" | "float64"):
            return dice.choice([0, 0.125, 0.25, 1, 5.5, 100])
        case Primitive():
            return dice.randrange(0, 8)
        case Array():
            return default_value(type_, system)
    known = system.interface(type_)
    return message(known.fields, system, dice) if isinstance(known, ir.Message) else {}


def message(fields: Any, system: System, dice: random.Random) -> dict[str, Any]:
    return {each.name: random_value(each.type, system, dice) for each in fields}


def result(function: str, system: System, dice: random.Random) -> dict[str, Any]:
    known = system.interface(system.function(function).communication.type)
    match known:
        case Action(result=fields) | Service(response=fields):
            return message(fields, system, dice)
    return {}


def has_durations(machine: ir.StateMachine) -> bool:
    """Return True if data hold durations: ms in a document, ns here."""
    held = [*machine.variables, *machine.params]
    return any(str(each.type) == "duration" for each in held)


def test_what_the_models_have_little_of(compiled: Callable[[str], System]) -> None:
    system = compiled(LIVELY)
    (machine,) = system.machines
    document = portable(machine, system)
    taken: set[object] = set()
    for seed in range(60):
        taken |= walk(machine, system, document, random.Random(seed))

    held = [t for state in machine.walk() for t in state.transitions]
    not_taken = [t.origin.text for t in held if t.origin and t.origin.start not in taken]
    # The defaults of histories are no transitions of their own.
    assert not_taken == ["deep history Back -> Look", "history Near -> Go"]


@pytest.mark.parametrize("model", MODELS, ids=lambda path: str(path.relative_to(ROOT)))
def test_models(model: Path) -> None:
    system = pipeline.check([model]).system
    assert system is not None
    system = with_documents(system)
    for machine in system.machines:
        document = portable(machine, system)
        for seed in range(WALKS):
            walk(machine, system, document, random.Random(seed))


def portable(machine: ir.StateMachine, system: System) -> Machine:
    """The portable document of a machine, read again."""
    files = {f.path: f.text for f in scxml.emit(system, scxml.Options("portable"), Diagnostics())}
    report = Diagnostics()
    document = read(Source("m.scxml", files[f"{machine.name}.scxml"]), report)
    assert document is not None, [(found.message, found.primary) for found in report]
    assert not list(report)
    return document


class Taken(Observer):
    """Source positions of the transitions taken."""

    def __init__(self) -> None:
        self.places: set[object] = set()

    def taken(self, instance: Instance, transition: Transition) -> None:
        self.places.add(transition.origin.origin.start)  # type: ignore[attr-defined]


def walk(
    machine: ir.StateMachine, system: System, document: Machine, dice: random.Random
) -> set[object]:
    """Let the same happen to both; return where the transitions stand that were taken."""
    names = data_ids(machine) | ({SELF: SELF} if uses_self(machine) else {})
    ids = state_ids(machine, {*names.values(), SELF})
    params = {
        p.name: random_value(p.type, system, dice) for p in machine.params if p.default is None
    }
    first = Runner(table(machine, system), first_data(machine, system, params))
    # The document has no values for these either.
    given = {names[name]: value for name, value in params.items()}
    other = Runner(document, {**document.data(), **given})
    other.instance.start()
    first.instance.observer = trace = Taken()
    first.instance.start()
    durations = has_durations(machine)
    for _ in range(STEPS):
        mine, its = first.told(), other.told()
        assert [ids[state] for state in mine[0]] == its[0]
        assert (ids[mine[1]] if mine[1] else None) == its[1]
        if not durations:
            held = {names[key]: value for key, value in mine[2].items() if key in names}
            # A document has more: since when states are active, which the engine knows.
            assert held == {key: its[2].get(key) for key in held}
            assert mine[3] == its[3]
            assert first.world.asked == other.world.asked
            for one, two in zip(first.world.sent, other.world.sent, strict=True):
                # A document leaves fields out that have their defaults.
                assert (one.name, one.envelope.to) == (two.name, two.envelope.to)
                assert plain(one.data).items() >= plain(two.data or {}).items()
        happen(first, other, system, dice)
    return trace.places


def happen(first: Runner, other: Runner, system: System, dice: random.Random) -> None:
    """Something that happens to both."""
    chance = dice.random()
    if chance < 0.4 and first.world.going:
        number = dice.randrange(len(first.world.going))
        outcome = dice.choice(["succeeded", "succeeded", "aborted", "preempted"])
        function = first.world.going[number].activity.name
        given = result(function, system, dice)
        for each in (first, other):
            each.world.going.pop(number).end(outcome, plain(given))
    elif chance < 0.55:
        for each in (first, other):
            each.world.clock.advance(700_000_000)
    elif system.events:
        event = dice.choice(system.events)
        given = random_value(event.type, system, dice)
        about = dice.choice(["", "a"]), dice.choice([0, 1_500, 4_000]) * 1_000_000
        sender, sent = as_headers_say(event, given, system, *about) if event.swarm else ("", 0)
        envelope = Envelope(sender, sent)
        in_document = {"sent": sent / 1_000_000, **plain(given)} if sent else plain(given)
        for each, data in ((first, plain(given)), (other, in_document)):
            each.instance.receive(Event(event.name, data, envelope=envelope))


def test_an_event_that_nobody_sent_has_the_time_0(compiled: Callable[[str], System]) -> None:
    system = compiled("""
        swarm event Go : std_msgs/Empty
        statemachine M {
          var at : duration = 1 s
          initial A
          state A { on Go [event.sent < 1 s] / at = event.sent -> B }
          state B { on Go [at == 0 s] -> Z }
          final Z
        }
    """)
    document = portable(system.machines[0], system)
    for data in ({}, None):
        runner = Runner(document, document.data())
        runner.instance.start()
        runner.instance.receive(Event("Go", data))
        assert runner.instance.configuration.innermost == ["B"]
        runner.instance.receive(Event("Go", data))
        assert runner.instance.final == "Z"
