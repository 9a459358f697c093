"""SCXML of W3C: what a model can say does the same in it, and what it cannot is told."""

# ruff: noqa: E501 - one document a line

from __future__ import annotations

import random
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case
from swarmdsl.base.source import Source
from swarmdsl.codegen.exchange import scxml
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Event
from swarmdsl.importing import import_scxml
from swarmdsl.importing.command import run as import_files
from swarmdsl.ir import System

from ..agreement.engines import Document

HEAD = (
    '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="m" datamodel="ecmascript"'
)
WALKS, STEPS = 20, 20


def document(body: str, attributes: str = "") -> str:
    return f"{HEAD} {attributes}>{body}</scxml>"


def imported(body: str, attributes: str = "") -> tuple[System, list[tuple[str, str]]]:
    """The system, and what is said but for events without a topic."""
    report = Diagnostics()
    system = import_scxml([Source("m.xml", document(body, attributes))], [], "m", report)
    said = [(f.name, f.message) for f in report if " has no topic" not in f.message]
    return system, said


def text(body: str, attributes: str = "") -> str:
    return print_system(imported(body, attributes)[0])


# ---- what does the same

SAME = {
    "delay": """<state id='a'><onentry><send event='t' id='x' delay='1s'/></onentry><onexit><cancel sendid='x'/></onexit>
        <transition event='t' target='b'/><transition event='e1' target='a'/></state>
      <state id='b'><transition event='e2' target='a'/></state>""",
    "delays": """<state id='a'><onentry><send event='t1' id='x' delay='1.5s'/><send event='t2' id='y' delayexpr="'2s'"/></onentry>
        <onexit><cancel sendid='x'/><cancel sendid='y'/></onexit>
        <transition event='t1' cond='n > 2' target='b'/><transition event='t2' target='c'/><transition event='e1'><assign location='n' expr='n + 1'/></transition></state>
      <state id='b'><transition event='e2' target='a'><assign location='n' expr='0'/></transition></state>
      <state id='c'><transition event='e1 e2' target='a'/></state><datamodel><data id='n' expr='0'/></datamodel>""",
    "computed delay": """<datamodel><data id='n' expr='500'/></datamodel>
      <state id='a'><onentry><send event='t' id='x' delayexpr="n + 'ms'"/></onentry><onexit><cancel sendid='x'/></onexit>
        <transition event='t' target='b'/><transition event='e1' target='b'/></state>
      <state id='b'><transition event='e2' target='a'><assign location='n' expr='n + 500'/></transition></state>""",
    "ends": """<state id='a'><state id='x'><transition event='e1' target='f'/><transition event='e2' target='g'/></state>
        <final id='f'><onentry><raise event='found'/></onentry></final><final id='g'><onentry><raise event='lost'/></onentry></final>
        <transition event='found' target='b'/><transition event='lost' target='c'/></state>
      <state id='b'><transition event='e1' target='a'/></state><state id='c'><transition event='e2' target='a'/></state>""",
    "choices": """<datamodel><data id='n' expr='0'/></datamodel>
      <state id='a'><transition event='e1' target='b'><if cond='n == 0'><assign location='n' expr='1'/><elseif cond='n == 1'/><assign location='n' expr='5'/><else/><assign location='n' expr='0'/></if></transition>
        <transition event='e2' cond='n > 3' target='c'/></state>
      <state id='b'><transition event='e1' target='a'/><transition event='e2'><if cond='n == 5'><assign location='n' expr='n + 1'/></if></transition></state>
      <state id='c'><transition event='e1' cond='n == 6' target='a'><assign location='n' expr='0'/></transition></state>""",
    "active": """<parallel id='p'><state id='l'><state id='l1'><transition event='e1' target='l2'/></state><state id='l2'><transition event='e2' target='l1'/></state></state>
      <state id='r'><state id='r1'><transition event='e1' cond="In('l2')" target='r2'/></state><state id='r2'><transition event='e2' cond="!In('l1')" target='r1'/><transition cond="In('q')" target='r1'/></state></state>
      <transition event='e3' cond="In('r2')" target='q'/></parallel><state id='q'><transition event='e1' target='p'/></state>""",
    "targets": """<state id='a'><transition event='e1' target='l1 r1'/><transition event='e2' target='l2 r1'/><transition event='e3' target='p'/></state>
      <parallel id='p'><state id='l'><state id='l1'><transition event='e1' target='l2'/></state><state id='l2'/></state>
        <state id='r'><state id='r1'><transition event='e2' target='r2'/></state><state id='r2'/></state><transition event='e3' target='a'/></parallel>""",
    "initial": """<state id='a' initial='l2 r1'><parallel id='p'><state id='l'><state id='l1'/><state id='l2'><transition event='e1' target='l1'/></state></state>
        <state id='r'><state id='r1'><transition event='e2' target='r2'/></state><state id='r2'/></state></parallel><transition event='e3' target='a'/></state>""",
    "deep initial": """<state id='a'><initial><transition target='c'/></initial><state id='b'><state id='c'><transition event='e1' target='d'/></state><state id='d'/></state>
        <transition event='e2' target='a'/></state>""",
    "history": """<state id='a'><history id='h' type='deep'><transition target='c'/></history><state id='b'><state id='c'><transition event='e1' target='d'/></state><state id='d'/></state>
        <state id='e'/><transition event='e2' target='q'/><transition event='e3' target='e'/></state><state id='q'><transition event='e1' target='h'/></state>""",
    "held back": """<state id='a'><state id='b'><transition event='e1'/><transition event='e2' target='c'/></state><state id='c'/><transition event='e1' target='q'/></state>
      <state id='q'><transition event='e2' target='a'/></state>""",
    "wildcards": """<state id='a'><transition event='e1.*' target='b'/><transition event='*' target='c'/></state><state id='b'><transition event='e1.x' target='a'/></state>
      <state id='c'><transition event='e2 e1' target='a'/></state>""",
    "only a wildcard": """<state id='a'><transition event='e1.*' target='b'/></state><state id='b'><transition event='e2' target='a'/></state>""",
    "send": """<state id='a'><transition event='e1' target='b'><send event='e2'/></transition></state><state id='b'><transition event='e2' target='c'/></state>
      <state id='c'><transition event='e3' target='a'/></state>""",
    "values": """<datamodel><data id='n' expr='-2'/><data id='s' expr="'a'"/><data id='x'>1.5</data></datamodel>
      <state id='a'><transition event='e1' cond="Math.abs(n) >= 2 &amp;&amp; s != 'b'" target='b'><assign location='n' expr='Math.max(n, x) * 2'/></transition></state>
      <state id='b'><transition event='e2' cond='n / 2 == x' target='c'><assign location='s' expr="s + 'c'"/></transition></state>
      <state id='c'><transition event='e3' cond='s.length == 2' target='a'/></state>""",
    "text": """<datamodel><data id='s'>some
        words</data><data id='n'>2</data></datamodel>
      <state id='a'><transition event='e1' cond="s == 'some words'" target='b'><assign location='s'>n</assign></transition></state>
      <state id='b'><transition event='e2' cond="s == 'n'" target='a'><assign location='s'>"some words"</assign></transition></state>""",
}  # fmt: skip


class Walker:
    """An engine whose machine hears of what it sends."""

    def __init__(self, text: str) -> None:
        self.engine = Document(text.encode())
        self.sent: list[Event] = []
        self.engine.world.send = lambda instance, event: self.sent.append(event)  # type: ignore[method-assign]

    @property
    def active(self) -> set[str]:
        instance = self.engine.instance
        ids = [instance.final] if instance.final else instance.configuration.innermost
        return {camel_case(each.rpartition("-")[2]) for each in ids}

    def take(self, event: str) -> None:
        self.engine.instance.receive(Event(event))
        while self.sent:
            self.engine.instance.receive(self.sent.pop(0))

    def wait(self) -> None:
        self.engine.world.clock.advance(700_000_000)


@pytest.mark.parametrize("body", SAME.values(), ids=SAME)
def test_the_model_does_the_same(body: str, tmp_path: Path) -> None:
    path, model = tmp_path / "m.xml", tmp_path / "m.swarm"
    path.write_text(document(body), encoding="utf-8")
    done = import_files("scxml", [path], [], model, force=False)
    assert "left-out" not in [found.name for found in done.report]
    system = pipeline.check([model]).system
    assert system is not None
    (file,) = scxml.emit(system, scxml.Options("portable"), Diagnostics())
    events = [event for event in ("e1", "e2", "e3", "e1.x") if event in body]
    seen: set[frozenset[str]] = set()
    for seed in range(WALKS):
        dice = random.Random(seed)
        before, after = Walker(document(body)), Walker(file.text)
        for _ in range(STEPS):
            assert after.active == before.active
            seen.add(frozenset(before.active))
            if dice.random() < 0.3:
                before.wait()
                after.wait()
            else:
                event = dice.choice(events)
                before.take(event)
                after.take(camel_case(event.replace(".", "_")))
    assert len(seen) > 1


# ---- how it is said


def test_delays_are_said_as_such() -> None:
    assert "after 1500 ms -> C" in text(SAME["delays"]).replace("1.5 s", "1500 ms") or (
        "after 2 s -> C" in text(SAME["delays"])
    )
    assert "after n * 1 ms -> B" in text(SAME["computed delay"])


def test_ends_are_told_apart() -> None:
    made = text(SAME["ends"])

    assert "on done.F -> B" in made
    assert "event Found" not in made


def test_a_delay_that_nothing_cancels() -> None:
    body = "<state id='a'><onentry><send event='t' delay='1s'/></onentry><transition event='t' target='b'/></state><state id='b'/>"
    system, said = imported(body)

    assert said == [
        ("assumed", "nothing cancels the delayed event `t`: cancellation on exit is assumed")
    ]
    assert "after 1 s -> B" in print_system(system)


def test_a_delayed_event_that_others_hear() -> None:
    body = "<state id='a'><onentry><send event='t' delay='1s'/></onentry><transition event='t' target='b'/></state><state id='b'><transition event='t' target='a'/></state>"

    system, said = imported(body)

    assert said == []
    assert "entry / send T after 1 s" in print_system(system)


def test_comments_are_documentation() -> None:
    made = text(
        "<!-- Waits. --><state id='a'><!-- Now. --><transition event='e' target='b'/></state><!-- <state id='c'/> --><state id='b'/>"
    )

    assert "/// Waits.\n  state A {\n    /// Now.\n" in made
    assert "<state" not in made


def test_conditions_on_active_states_are_kept() -> None:
    made = text(SAME["active"])

    assert "var" not in made
    assert "on E1 [in(L2)] -> R2" in made
    assert "on E2 [not in(L1)] -> R1" in made


# ---- what has no place

WAY = "<state id='a'>{}<transition event='e' target='b'>{}</transition></state><state id='b'/>"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("<log expr='1'/>", "`<log>` is left out: a model has no logging"),
        ("<script>x = 1</script>", "`<script>` is left out: a model has no scripts"),
        ("<foreach array='x' item='y'/>", "`<foreach>` is left out: a model has no loops"),
        ("<cancel sendid='x'/>", "`<cancel>` is left out: no delayed event has this id"),
        ("<send event='f'><param name='n' expr='1'/></send>", "`<send>` is left out: it carries data"),
        ("<send event='f' target='http://other'/>", "`<send>` is left out: its target is outside of the machine"),
        ("<send eventexpr='f'/>", "`<send>` is left out: its event is computed at run time"),
        ("<assign location='x[1]' expr='1'/>", "`<assign>` is left out: `x[1]` is not a variable or field"),
        ("<assign location='x' expr='[1]'/>", "`<assign>` is left out: `[1]` is not supported: it has no equivalent in a model"),
        ("<assign location='x' expr='x | 2'/>", "`<assign>` is left out: `x | 2` is not supported: it has no equivalent in a model"),
        ("<assign location='x' expr='++x'/>", "`<assign>` is left out: `++x` is not supported: it has no equivalent in a model"),
        ("<assign location='x' expr='&quot;a&quot; in x'/>", "`<assign>` is left out: `\"a\" in x` is not supported: it has no equivalent in a model"),
        ("<assign location='x' expr='_event.type'/>", "`<assign>` is left out: `_event.type` is not supported: `_event.type` is not a value"),
        ("<assign location='x' expr='x.concat(1)'/>", "`<assign>` is left out: `x.concat(1)` is not supported: only some functions of `Math` are supported"),
        ("<send event='f' target='#_scxml_1'/>", "`<send>` is left out: its target is outside of the machine"),
        ("<assign location='x' expr='Math.pow(x, 2)'/>", "`<assign>` is left out: `Math.pow(x, 2)` is not supported: a model has no `Math.pow`"),
        ("<assign location='x' expr='1'/><if cond='x == 1'><assign location='y' expr='1'/></if>", "`<if>` is left out: its condition reads a variable that was just changed"),
        ("<if cond='x'><if cond='y'/></if>", "`<if>` is left out: nested `<if>` is not supported"),
        ("<other:thing xmlns:other='urn:x'/>", "`<thing>` is left out: it is not SCXML"),
    ],
)  # fmt: skip
def test_content_that_is_left_out(content: str, said: str) -> None:
    system, found = imported(WAY.format("", content))

    assert ("left-out", said) in found
    assert "-> B" in print_system(system)


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ("<onentry><if cond='x'><raise event='e'/></if></onentry>", "`<if>` is left out: only transitions have conditions in a model"),
        ("<invoke src='x.scxml'/>", "`invoke` is left out: it names no ROS action, service or topic"),
        ("<transition event='error.execution' target='b'/>", "this transition is left out: a model has no event `error.execution`"),
        ("<transition event='f' cond='x ? y : z' target='b'/>", "this transition is left out: `x ? y : z` is not supported: it has no equivalent in a model"),
        ("<transition event='f' cond=\"In('b') || In('f')\" target='b'/>", "this transition is left out: `In('b') || In('f')` is not supported: state `f` cannot be tested for being active"),
        ("<transition event='f'/>", "this transition is left out: it has neither target nor effects"),
        ("<transition event='f' target='b a'/>", "this transition is left out: it has several targets"),
    ],
)  # fmt: skip
def test_states_of_which_something_is_left_out(inside: str, said: str) -> None:
    system, found = imported(WAY.format(inside, ""))

    assert ("left-out", said) in found
    assert "on E -> B" in print_system(system)


def test_what_is_done_on_the_way_into_a_state() -> None:
    body = """<state id='a'><initial><transition target='b'><log expr='1'/></transition></initial>
      <history id='h'><transition target='b'><log expr='2'/></transition></history><state id='b'/><transition event='e' target='h'/></state>"""
    _, said = imported(body)

    assert said == [
        (
            "left-out",
            "`<log>` is left out: an initial transition has no effects in a model",
        ),
        (
            "left-out",
            "`<log>` is left out: the default transition of a history has no effects in a model",
        ),
    ]


def test_histories_of_parallel_states() -> None:
    body = "<parallel id='p'><history id='h'><transition target='l'/></history><state id='l'><state id='l1'/></state></parallel><state id='a'><transition event='e' target='h'/></state>"
    _, said = imported(body, "initial='a'")

    assert said[0] == (
        "left-out",
        "this history is left out: in a model, only regions have a history",
    )
    assert said[1][0] == "unknown-state"


def test_events_that_a_machine_raises_for_itself() -> None:
    system, said = imported(WAY.format("", "<raise event='f'/>"))

    assert said == [
        ("sent-later", "`F` is sent instead of raised, after the events already queued")
    ]
    assert "on E / send F -> B" in print_system(system)


def test_one_that_holds_others_back_assigns() -> None:
    _, said = imported(SAME["held back"])

    assert [name for name, _ in said] == ["repaired-dialect"]
