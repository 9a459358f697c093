"""Round trip of a model through the portable profile of SCXML."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import Phase, assume, given, settings

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.exchange import scxml
from swarmdsl.codegen.exchange.scxml import ecmascript
from swarmdsl.codegen.exchange.scxml.ids import data_ids, state_ids
from swarmdsl.codegen.swarm_printer.system import normalized
from swarmdsl.driver import pipeline
from swarmdsl.importing import import_scxml
from swarmdsl.importing.expressions import Expressions
from swarmdsl.ir import (
    Binary,
    DoneTrigger,
    EventTrigger,
    Expression,
    Literal,
    OutcomeTrigger,
    ParamRef,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    Transition,
    Type,
)
from swarmdsl.ir.expression_printer import Dialect, translate
from swarmdsl.syntax.types import BOOL, DURATION, INT

from ..exchange.scxml_machines import with_documents
from ..swarm_printer.round_trip import printed_and_compiled
from ..swarm_printer.systems import systems

ROOT = Path(__file__).resolve().parents[2]
MODELS = [
    *sorted(path.parent for path in (ROOT / "examples").glob("*/README.md")),
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
    ROOT / "tests" / "agreement" / "machines.swarm",
]

EVERYTHING = """
package test
action Go { result { reached : bool, count : int32 } }
action Drive { goal { speed : float64, name : string } result { count : int32, name : string } }
service Ask { request { times : uint8 } response { answer : bool } }
message Report { id : string, level : int32 }
function go : abstraction { action "cmd/go" : Go }
function drive : abstraction { action "cmd/drive" : Drive }
function ask : abstraction { service "cmd/ask" : Ask }
swarm event Start : swarmros/SimpleEvent
swarm event Abort : swarmros/SimpleEvent
swarm event Found : Report
event Low : sensor_msgs/BatteryState on "battery"
/// Looks twice.
statemachine Look {
  /// How often.
  param limit : int32 = 2
  var seen : int32 = 0
  initial Try
  state Try { do ask(times = 1); on succeeded -> Ok; on aborted [seen < limit] -> Try
              on aborted -> Lost }
  final Ok
  final Lost
}
/// All there is -- in one machine.
statemachine M {
  /// Metres.
  param height : float64 = 2.5
  param given  : duration
  /// The last report.
  var last : Report
  var class : int32 = 3
  initial Out
  /// The whole.
  state Out {
    /// At first.
    entry / class = class % 5, send Start
    /// At last -- whatever happened.
    exit  / last.level = class
    initial A
    /// Waits.
    state A {
      /// A high one.
      /// Or two.
      on Found [event.level > 3 and not (class == 2)] / last = event -> B
      after 1.5 s -> B
      after given [class > 1] -> Which
      on Low / class = class + 1
      [class > 100] -> End
    }
    state B {
      /// Goes there.
      do drive(speed = height, name = last.id) gives (count => class, name => last.id)
      /// Is there.
      on succeeded -> A
      on aborted   -> Which
      on preempted -> A
    }
    choice Which {
      /// Enough.
      [class > 2] / class = 0 -> A
      else -> End
    }
    deep history Back -> A
    history Near -> B
    final End
    /// Starts anew.
    internal on Abort / class = 1 -> B
    on Start -> Par
    on done.End -> Par
  }
  parallel state Par {
    entry / class = 1
    region L {
      initial A
      state A { do go(by fill) gives by read; on succeeded, aborted -> E }
      final E
    }
    region R { initial A; state A { on Start -> E; on Abort -> Out.Back } final E }
    /// One is enough.
    on L.done -> Sub
    on done   -> Sub
  }
  state Sub = Look { on done.Ok -> Stop; on done -> Out }
  /// The end.
  final Stop
}
"""


def documents(system: System) -> list[Source]:
    made = scxml.emit(system, scxml.Options("portable"), Diagnostics())
    return [Source(file.path, file.text) for file in made]


def read_again(system: System, folder: Path) -> System:
    """The system that comes of the documents of one, by way of its text."""
    report = Diagnostics()
    back = import_scxml(documents(system), [], system.name, report)
    assert [(f.message, f.primary and f.primary.span.text) for f in report] == []
    return printed_and_compiled(back, folder)


def carried(system: System) -> System:
    """Reduce a system to what the documents of its machines hold."""
    machines = tuple(_plain(machine, system) for machine in system.machines)
    heard = {event for machine in machines for event in _events(machine)}
    called = {s.activity.function for m in machines for s in m.walk() if s.activity is not None}
    return System(
        system.name,
        system.interfaces,
        tuple(event for event in system.events if event.name in heard),
        tuple(
            replace(
                f, ports=(), params=(), model=None, communication=replace(f.communication, doc="")
            )
            for f in system.functions
            if f.name in called
        ),
        machines=machines,
    )


def _events(machine: StateMachine) -> Any:
    for state in machine.walk():
        for each in (*state.entry, *state.exit, *(e for t in state.transitions for e in t.effects)):
            if isinstance(each, Send):
                yield each.event
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, EventTrigger):
                    yield trigger.event


def _plain(machine: StateMachine, system: System) -> StateMachine:
    """The machine with one of two ways to say the same, which documents do not tell apart."""
    finals = {
        state.id: [each.id for each in state.states if each.kind is StateKind.FINAL]
        for state in machine.walk()
    }

    def transition(made: Transition, state: State) -> Transition:
        triggers = []
        aborted, preempted = (OutcomeTrigger(state.id, o) for o in ("aborted", "preempted"))
        same = all((aborted in t.triggers) == (preempted in t.triggers) for t in state.transitions)
        for trigger in made.triggers:
            if trigger == preempted and same:
                continue
            if isinstance(trigger, DoneTrigger):
                every = [DoneTrigger(trigger.state, final) for final in finals[trigger.state]]
                if all(each in made.triggers for each in every):
                    trigger = DoneTrigger(trigger.state, None)
            if trigger not in triggers:
                triggers.append(trigger)
        return replace(made, triggers=tuple(triggers))

    def plain(state: State) -> State:
        made = tuple(transition(each, state) for each in state.transitions)
        return replace(state, transitions=made, states=tuple(map(plain, state.states)))

    made = replace(machine, states=tuple(map(plain, machine.states)))
    data = data_ids(machine)
    states = state_ids(machine, {*data.values(), "self"})
    entries = {state.id: state.id for state in machine.walk()}
    return _in_text(made, ecmascript.dialect(data, system, states, entries))


def _in_text(node: Any, words: Dialect) -> Any:
    """The same with expressions as a document has them: a duration is a number there.

    ECMAScript has one type of numbers: `1.0` is `1`.
    """
    if isinstance(node, Expression):
        return re.sub(r"(?<![\w.])(\d+)\.0(?![\w.])", r"\1", translate(node, words))
    if isinstance(node, tuple):
        return tuple(_in_text(each, words) for each in node)
    if not is_dataclass(node) or isinstance(node, type):
        return node
    return replace(node, **{f.name: _in_text(getattr(node, f.name), words) for f in fields(node)})


def told_in_whole_milliseconds(node: Any) -> Any:
    """The same with durations that a document can hold exactly."""
    if isinstance(node, Literal) and node.type == DURATION:
        return replace(node, value=(node.value % 10**6 + 1) * 10**6)
    if isinstance(node, tuple):
        return tuple(map(told_in_whole_milliseconds, node))
    if not is_dataclass(node) or isinstance(node, type):
        return node
    values = {f.name: told_in_whole_milliseconds(getattr(node, f.name)) for f in fields(node)}
    return replace(node, **values)


def divides_durations(node: Any) -> bool:
    """Return True if a duration is divided by a duration; documents may hold numbers."""
    if isinstance(node, Binary) and node.operator in ("/", "%"):
        operands = (getattr(each, "type", None) for each in (node.left, node.right))
        if all(type_ == DURATION for type_ in operands):
            return True
    if isinstance(node, tuple):
        return any(map(divides_durations, node))
    if not is_dataclass(node) or isinstance(node, type):
        return False
    return any(divides_durations(getattr(node, f.name)) for f in fields(node))


def check(system: System, folder: Path) -> None:
    wanted = carried(system)
    back = carried(read_again(system, folder))
    assert {m.name: m for m in back.machines} == {m.name: m for m in wanted.machines}
    assert set(back.events) == set(wanted.events)
    assert set(back.functions) == set(wanted.functions)
    assert set(back.interfaces) <= set(system.interfaces)


def test_every_construct(compiled: Callable[[str], System], tmp_path: Path) -> None:
    check(normalized(compiled(EVERYTHING)), tmp_path)


def test_an_id_that_is_a_keyword_stays_an_id(
    compiled: Callable[[str], System], tmp_path: Path
) -> None:
    text = """package test
        swarm event Start : swarmros/SimpleEvent
        statemachine Call {
          initial A
          state A { on Start / send Start to "state" -> B }
          final B
        }"""
    check(compiled(text), tmp_path)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: str(path.relative_to(ROOT)))
def test_models(model: Path, tmp_path: Path) -> None:
    system = pipeline.check([model]).system
    assert system is not None
    check(normalized(with_documents(system)), tmp_path)


def test_fields_with_units(compiled: Callable[[str], System], tmp_path: Path) -> None:
    text = """package test
        message Seen { range : float64 in m, age : float64 in s, plain : float64 }
        struct Spot { x : float64 in m, y : float64 in m }
        action Act { goal { rest : float64 in s } result { rest : float64 in m } }
        function act : abstraction { action "act" : Act }
        event Found : Seen
        statemachine M {
          var d : duration = 3 s
          var x : float64 in m = 2 m
          var here : Spot
          var there : Spot
          initial A
          state A {
            do act(rest = d + 1 s)
            on succeeded / send Found(range = 5 m, age = elapsed(), plain = x) -> B
            on Found / send Found(range = distance(here, there))
            on aborted / send Found(range = 2 * x, age = 1500 ms, plain = 3) -> B
          }
          final B
        }"""
    check(compiled(text), tmp_path)


def test_events_of_members(compiled: Callable[[str], System], tmp_path: Path) -> None:
    """The host raises them, and the model that is made of the document declares none."""
    text = """package test
        statemachine Call {
          initial A
          state A {
            defer member_joined
            on member_lost [event.role == "scout" and event.id != self.id] -> B
          }
          state B { on member_joined -> C }
          final C
        }"""
    check(compiled(text), tmp_path)


def compiles(system: System, folder: Path) -> bool:
    try:
        printed_and_compiled(system, folder)
    except AssertionError:
        return False
    return True


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
@settings(
    max_examples=50,
    phases=[Phase.generate],  # shrinking would take minutes
)
@given(systems().filter(lambda system: bool(system.machines)))
def test_whatever_a_system_is_made_of(tmp_path: Path, system: System) -> None:
    rounded = told_in_whole_milliseconds(system)
    assume(not divides_durations(rounded))
    try:
        check(rounded, tmp_path)
    except AssertionError:
        # A sum of lengths that have been rounded may be 0, which nothing is divided by.
        assume(compiles(rounded, tmp_path))
        raise


@pytest.mark.parametrize(
    ("text", "length"),
    [
        ("n * 5", 5),
        ("5 * n", 5),
        ("n * 5 * -1.1e285", 5),
        ("n * 0x10", 16),
        ("5 * 1e300", 5),
        ("10 / 2 * Math.sqrt(n)", 10),
    ],
)
def test_which_number_is_a_length_of_time(text: str, length: int) -> None:
    """One that no duration has is a number."""

    def refer(name: str, _wanted: Type) -> ParamRef:
        return ParamRef(name, INT)

    known = Expressions({"n": INT}, refer, lambda _, __: None, lambda _: Literal(True, BOOL))
    found = [
        each.value
        for each in literals(known.read(text, DURATION))
        if isinstance(each.value, int) and each.type == DURATION
    ]
    assert found == [length * 1_000_000]


def literals(expression: Expression) -> list[Literal]:
    if isinstance(expression, Binary):
        return literals(expression.left) + literals(expression.right)
    return [expression] if isinstance(expression, Literal) else []
