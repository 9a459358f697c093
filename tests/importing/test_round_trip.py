"""Real documents walk the same states before they are imported and after they are written again.

Before, a document is run as what it is in SCXML, but for two things: calls are no part of SCXML
and are taken out, and an outcome is that of one state that calls, as it is in SMACH.
"""

from __future__ import annotations

import json
import os
import random
import re
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.naming import camel_case
from swarmdsl.codegen.exchange import scxml
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Event
from swarmdsl.importing.command import run as import_files
from swarmdsl.importing.names import type_names

from ..agreement.engines import ENGINES, Document, S, Step

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
SCXML = sorted((CORPUS / "scxml").glob("*.xml"))
CHARTS = sorted((CORPUS / "statecharts").glob("*/*.scxml"))
STATES = {f"{S}{name}" for name in ("state", "parallel", "final", "history")}
OUTCOMES = ("succeeded", "aborted")
WALKS, STEPS = 12, 25
# python-statemachine reads parallel states as the last, and begins in another state then.
WITNESSES = ["document", "python-statemachine"]


def rebuilt(path: Path, folder: Path) -> bytes:
    """The portable document of the model that a file becomes."""
    model = folder / "model.swarm"
    done = import_files("scxml", [path], [], model, force=False)
    assert not done.report.has_errors
    result = pipeline.check([model])
    assert [f.message for f in result.report if f.severity is Severity.ERROR] == []
    assert result.system is not None
    (file,) = scxml.emit(result.system, scxml.Options("portable"), Diagnostics())
    return file.text.encode()


class Original:
    """A document of the CPSwarm dialect as plain SCXML."""

    def __init__(self, path: Path) -> None:
        self.root = etree.fromstring(path.read_bytes())
        self.calls = {
            state
            for state in self.root.iter(*STATES)
            if any(each.tag.endswith(("rosaction", "rosservice")) for each in self._own(state))
        }
        # What only listens is no state of its own in a model.
        self.monitors = {
            state.get("id")
            for state in self.root.iter(*STATES)
            if any(each.tag.endswith("rosmonitor") for each in self._own(state))
        }
        found: dict[str, list[etree._Element]] = {}
        for state in self.root.iter(*STATES):
            found.setdefault(state.get("id"), []).append(state)
        wanted = [
            (each, attribute, self._nearest(each, each.get(attribute), found))
            for each in self.root.iter()
            for attribute in ("target", "initial")
            if each.get(attribute)
        ]
        for name, states in found.items():
            for number, state in enumerate(states[1:], 2):
                state.set("id", f"{name}{number}")
        for each, attribute, state in wanted:
            each.set(attribute, state.get("id"))
        for transition in [*self.root.iter(f"{S}transition")]:
            self._scope(transition)
        for each in [*self.root.iter()]:
            known = each.tag in STATES or each.tag in (f"{S}transition", f"{S}scxml")
            if not known and each.getparent() is not None:
                each.getparent().remove(each)

    def _own(self, state: etree._Element) -> list[etree._Element]:
        """The elements of a state that are not those of states in it."""
        own = []
        for child in state:
            if isinstance(child.tag, str) and child.tag not in STATES:
                own += [each for each in child.iter() if isinstance(each.tag, str)]
        return own

    def _nearest(
        self, place: etree._Element, name: str, found: dict[str, list[etree._Element]]
    ) -> etree._Element:
        """The state of that name, or nearly so, with the least around it and the place."""
        states = found.get(name) or found.get(f"{name}Threads")
        states = states or next(s for n, s in found.items() if n.lower() == name.lower())
        while True:
            inside = [each for each in place.iter() if each in states]
            if inside:
                return inside[0]
            place = place.getparent()

    def _scope(self, transition: etree._Element) -> None:
        """Make outcomes those of the states that call, in a state or the states in it."""
        state = transition.getparent()
        below = [each.get("id") for each in state.iter(*STATES) if each in self.calls]
        events = (transition.get("event") or "").split()
        if not set(events) & {*OUTCOMES, "preempted"}:
            return
        if below:
            words = [f"{event}.{each}" for event in events for each in below]
            transition.set("event", " ".join(words))
        elif events == ["succeeded"]:
            # What does nothing has succeeded as soon as it is there.
            del transition.attrib["event"]
        else:
            state.remove(transition)

    @property
    def document(self) -> bytes:
        return etree.tostring(self.root)

    @property
    def conditions(self) -> bool:
        return any(each.get("cond") for each in self.root.iter(f"{S}transition"))

    @property
    def events(self) -> list[str]:
        """All that some transition waits for."""
        found = {
            each
            for transition in self.root.iter(f"{S}transition")
            for each in (transition.get("event") or "").split()
        }
        return sorted(event for event in found if not event.startswith("preempted"))


def plain(ids: frozenset[str] | set[str]) -> set[str]:
    """The names of states without what the idiom of monitors, and regions, add to them."""
    names = {re.sub("(Threads|Behavior|EventMonitoring|Monitoring)$", "", each) for each in ids}
    return {camel_case(re.sub(r"[^A-Za-z0-9]+", "_", each.split("-")[-1])) for each in names}


@pytest.mark.skipif(not SCXML, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("engine", WITNESSES)
@pytest.mark.parametrize("path", SCXML, ids=lambda path: path.stem)
def test_real_documents_walk_the_same_states(path: Path, engine: str, tmp_path: Path) -> None:
    original = Original(path)
    document = rebuilt(path, tmp_path)
    names = {
        camel_case(each.get("id").split("-")[-1]): each.get("id")
        for each in etree.fromstring(document).iter(*STATES)
    }
    events = type_names()
    moved = 0
    for seed in range(WALKS):
        dice = random.Random(seed)
        before, after = Document(original.document), ENGINES[engine](document)
        for _ in range(STEPS):
            assert plain(after.active) == plain(before.active - original.monitors)
            if not original.events:
                break
            event = dice.choice(original.events)
            word, _, state = event.partition(".")
            if state and state not in before.active:
                continue
            was = before.active
            before.take(Step(event))
            moved += before.active != was
            told = event
            if state:
                (called,) = plain({state})
                told = f"do.{names[called]}.{word}"
            after.take(Step(told if state else events.of(event)))
            if not before.instance.running:
                break
    # The conditions of one are about data that it does not have: they never hold.
    assert moved or not original.events or original.conditions


@pytest.mark.skipif(not CHARTS, reason=f"no state charts in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", CHARTS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_state_charts_follow_their_scripts(path: Path, tmp_path: Path) -> None:
    engine = Document(rebuilt(path, tmp_path))
    sent: list[Event] = []
    # What a machine sends stays on its robot, where it hears of it too.
    engine.world.send = lambda instance, event: sent.append(event)  # type: ignore[method-assign]
    script = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))

    def leaves() -> set[str]:
        return plain(set(engine.instance.configuration.innermost))

    assert leaves() == plain(set(script["initialConfiguration"]))
    for step in script["events"]:
        engine.take(Step(type_names().of(step["event"]["name"])))
        while sent:
            engine.instance.receive(sent.pop(0))
        assert leaves() == plain(set(step["nextConfiguration"]))
