"""A portable document has all of the machine it was made of: a reader gets it back."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from swarmdsl import compiler
from swarmdsl.exchange.scxml import ecmascript
from swarmdsl.exchange.scxml.ids import data_ids
from swarmdsl.ir import (
    Assignment,
    DoneTrigger,
    Effect,
    EventTrigger,
    Expression,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    System,
    TimeTrigger,
    Transition,
    Trigger,
    doc_of,
)
from swarmdsl.translate import translate

Compile = Callable[[str], System]
Emit = Callable[..., dict[str, str]]

ROOT = Path(__file__).resolve().parents[2]
MODELS = [
    *(ROOT / "examples" / "search_and_rescue", ROOT / "examples" / "minimal"),
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
]
S = "{http://www.w3.org/2005/07/scxml}"
SW = "{urn:swarmdsl:scxml}"
VERTICES = tuple(S + tag for tag in ("state", "parallel", "final", "history"))

EVERYTHING = """
/// Looks twice.
statemachine Look {
  /// How often.
  param limit : int32 = 2
  var seen : int32 = 0
  initial Try
  state Try { do ask(times = 1) on succeeded -> Ok on aborted [seen < limit] -> Try
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
      state A { do go(by fill) gives by read on succeeded, aborted -> E }
      final E
    }
    region R { initial A state A { on Start -> E on Abort -> Out.Back } final E }
    /// One is enough.
    on L.done -> Sub
    on done   -> Sub
  }
  state Sub = Look { on done.Ok -> Stop on done -> Out }
  /// The end.
  final Stop
}
"""


class Reader:
    """Makes of a document what `told` makes of a machine: plain data to compare."""

    def __init__(self, document: str) -> None:
        self.root = etree.fromstring(document.encode())
        self.paths: dict[str, str] = {}
        for element in self.vertices(self.root):
            self.find_paths(element, "")
        self.events = {e.get("name") for e in self.root.findall(f"{SW}event")}

    def vertices(self, element: Any) -> list[Any]:
        return [child for child in element if child.tag in VERTICES]

    def name(self, element: Any) -> str:
        vertex = element.find(f"{SW}vertex")
        given = vertex.get("name") if vertex is not None else None
        return str(given or element.get("id"))

    def find_paths(self, element: Any, above: str) -> None:
        path = f"{above}.{self.name(element)}" if above else self.name(element)
        self.paths[element.get("id")] = path
        for child in self.vertices(element):
            self.find_paths(child, path)

    def machine(self) -> dict[str, Any]:
        values = {data.get("id"): data.get("expr") for data in self.root.iter(f"{S}data")}
        return {
            "name": self.root.get("name"),
            "initial": self.paths[self.root.get("initial")],
            "endless": self.root.find(f"{SW}endless") is not None,
            "doc": self.root.findtext(f"{SW}doc") or "",
            **{
                f"{tag}s": [
                    (e.get("name"), e.get("type"), values[e.get("location")], self.doc(e))
                    for e in self.root.findall(f"{SW}{tag}")
                ]
                for tag in ("parameter", "variable")
            },
            "states": [self.state(child, None) for child in self.vertices(self.root)],
        }

    def doc(self, element: Any) -> str:
        return element.findtext(f"{SW}doc") or ""

    def above(self, element: Any) -> str:
        """The comment above an element."""
        comment = element.getprevious() if element is not None else None
        found = comment is not None and comment.tag is etree.Comment
        return comment.text.strip().replace("- -", "--") if found else ""

    def state(self, element: Any, parent: Any) -> dict[str, Any]:
        submachine = element.find(f"{SW}submachine")
        initial = element.get("initial")
        return {
            "id": self.paths[element.get("id")],
            "name": self.name(element),
            "kind": self.kind(element, parent),
            "initial": self.paths[initial] if initial else None,
            "doc": self.doc(element),
            "deep": element.get("type") == "deep",
            "submachine": submachine.get("name") if submachine is not None else None,
            "docs": [self.above(element.find(f"{S}{tag}")) for tag in ("onentry", "onexit")],
            "entry": self.effects(element.iterfind(f"{S}onentry/*")),
            "exit": self.effects(element.iterfind(f"{S}onexit/*")),
            "activity": self.activity(element.find(f"{SW}activity")),
            "transitions": [
                self.transition(t, element)
                for t in element.findall(f"{S}transition")
                if t.find(f"{S}raise") is None
            ],
            "states": [self.state(child, element) for child in self.vertices(element)],
        }

    def kind(self, element: Any, parent: Any) -> str:
        vertex = element.find(f"{SW}vertex")
        if vertex is not None and vertex.get("kind"):
            return str(vertex.get("kind"))
        if element.tag != f"{S}state":
            return str(element.tag.removeprefix(S))
        if parent is not None and parent.tag == f"{S}parallel":
            return "region"
        return "composite" if self.vertices(element) else "simple"

    def activity(self, element: Any) -> Any:
        if element is None:
            return None
        *_, goal, result = element
        return {
            "doc": self.doc(element),
            "function": element.get("function"),
            "callbacks": (goal.get("callback"), result.get("callback")),
            "arguments": [(e.get("field"), e.get("expr")) for e in goal],
            "results": [(e.get("field"), e.get("location")) for e in result],
        }

    def transition(self, element: Any, state: Any) -> dict[str, Any]:
        target = element.get("target")
        sends = state.iterfind(f"{S}onentry/{S}send[@id]")
        delays = {send.get("id"): self.delay(send) for send in sends}
        fields = {
            a[1] for a in (self.activity(state.find(f"{SW}activity")) or {"results": ()})["results"]
        }
        effects = self.effects(element)
        if any(
            "do." in event or "gives." in event for event in (element.get("event") or "").split()
        ):
            stored = [e for e in effects if e[1] in fields and str(e[2]).startswith("_event.data.")]
            effects = [e for e in effects if e not in stored]
        events = (element.get("event") or "").split()
        return {
            "triggers": [self.trigger(event, delays) for event in events],
            "doc": self.above(element),
            "guard": element.get("cond"),
            "internal": element.get("type") == "internal",
            "target": self.paths[target] if target else None,
            "effects": effects,
        }

    def delay(self, send: Any) -> str:
        return str(send.get("delay") or send.get("delayexpr"))

    def trigger(self, event: str, delays: dict[str, str]) -> tuple[str, ...]:
        if event in self.events:
            return ("event", event)
        if event.startswith("after."):
            return ("after", delays[event])
        if event.startswith("done.state."):
            return ("done", self.paths[event.removeprefix("done.state.")])
        if event.startswith("final."):
            return ("final", self.paths[event.removeprefix("final.")])
        _, state, outcome = event.split(".")
        return ("outcome", self.paths[state], outcome)

    def effects(self, elements: Any) -> list[tuple[Any, ...]]:
        found: list[tuple[Any, ...]] = []
        for element in elements:
            if element.tag == f"{S}assign":
                found.append(("assign", element.get("location"), element.get("expr")))
            elif element.tag == f"{S}send" and element.get("id") is None:
                params = [(param.get("name"), param.get("expr")) for param in element]
                found.append(("send", element.get("event"), params))
        return found


class Teller:
    """Says the same of the machine itself; expressions as they are written in a document."""

    def __init__(self, machine: StateMachine, system: System) -> None:
        self.source = machine
        self.system = system
        self.dialect = ecmascript.dialect(data_ids(machine))
        self.all = {state.id: state for state in machine.walk()}

    def text(self, expression: Expression | None) -> str | None:
        return translate(expression, self.dialect) if expression is not None else None

    def machine(self) -> dict[str, Any]:
        machine = self.source
        return {
            "name": machine.name,
            "initial": machine.initial,
            "endless": machine.endless,
            "doc": machine.doc,
            "parameters": [
                (p.name, str(p.type), self.text(p.default), p.doc) for p in machine.params
            ],
            "variables": [
                (
                    v.name,
                    str(v.type),
                    self.text(v.initial) or ecmascript.first_value(v.type, self.system),
                    v.doc,
                )
                for v in machine.variables
            ],
            "states": [self.state(state) for state in machine.states],
        }

    def state(self, state: State) -> dict[str, Any]:
        return {
            "id": state.id,
            "name": state.name,
            "kind": state.kind.value,
            "initial": state.initial,
            "doc": state.doc,
            "deep": state.deep,
            "submachine": state.submachine,
            "docs": [doc_of(state.docs, word) for word in ("entry", "exit")],
            "entry": [self.effect(effect) for effect in state.entry],
            "exit": [self.effect(effect) for effect in state.exit],
            "activity": self.activity(state),
            "transitions": [self.transition(each, state) for each in state.transitions],
            "states": [self.state(child) for child in state.states],
        }

    def activity(self, state: State) -> Any:
        if state.activity is None:
            return None
        return {
            "doc": state.activity.doc,
            "function": state.activity.function,
            "callbacks": (state.activity.goal_callback, state.activity.result_callback),
            "arguments": [(field, self.text(value)) for field, value in state.activity.arguments],
            "results": [
                (each.field, self.location(each.variable, each.path))
                for each in state.activity.results
            ],
        }

    def transition(self, transition: Transition, state: State) -> dict[str, Any]:
        handled = [t for each in state.transitions for t in each.triggers]
        return {
            "triggers": [
                told for each in transition.triggers for told in self.trigger(each, handled)
            ],
            "doc": transition.doc,
            "guard": self.text(transition.guard),
            "internal": transition.internal,
            "target": transition.target,
            "effects": [self.effect(effect) for effect in transition.effects],
        }

    def trigger(self, trigger: Trigger, handled: list[Trigger]) -> Iterator[tuple[Any, ...]]:
        match trigger:
            case EventTrigger(event=event):
                yield ("event", event)
            case OutcomeTrigger(state=state, outcome=outcome):
                yield ("outcome", state, outcome)
                if outcome == "aborted" and OutcomeTrigger(state, "preempted") not in handled:
                    yield ("outcome", state, "preempted")
            case TimeTrigger(delay=delay):
                text = self.text(delay)
                yield (
                    "after",
                    f"{text}ms"
                    if str(text).isdigit()
                    else f'Math.max(0, Math.ceil({text})) + "ms"',
                )
            case DoneTrigger(state=state, final=None):
                finals = [c.id for c in self.all[state].states if c.kind is StateKind.FINAL]
                told = {
                    t.state
                    for s in self.all.values()
                    for each in s.transitions
                    for t in each.triggers
                    if isinstance(t, DoneTrigger) and t.final is not None
                }
                yield from [("final", f) for f in finals] if state in told else [("done", state)]
            case DoneTrigger(final=final):
                yield ("final", final)

    def effect(self, effect: Effect) -> tuple[Any, ...]:
        if isinstance(effect, Assignment):
            value = ecmascript.stored(effect.value, self.dialect)
            return ("assign", self.location(effect.variable, effect.path), value)
        arguments = [(n, ecmascript.stored(v, self.dialect)) for n, v in effect.arguments]
        return ("send", effect.event, arguments)

    def location(self, variable: str, path: tuple[str, ...]) -> str:
        return ".".join((self.dialect.variable(variable), *path))


def check(system: System, emit: Emit) -> None:
    files = emit(system)
    for machine in system.machines:
        read = Reader(files[f"{machine.name}.scxml"]).machine()
        assert read == Teller(machine, system).machine()


def test_every_construct(compiled: Compile, emit: Emit) -> None:
    check(compiled(EVERYTHING), emit)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: str(path.relative_to(ROOT)))
def test_models(model: Path, emit: Emit) -> None:
    system = compiler.check([model]).system
    assert system is not None
    check(system, emit)
