"""Mistakes put into models on purpose, one at a time.

A mutant of a model lacks a transition or a send, has the opposite of a guard, or another target of
a transition.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from swarmdsl.base.source import Span
from swarmdsl.ir import Send, State, StateKind, StateMachine, System, Transition

_TARGET = re.compile(r"(->\s*(?:\w+\.)*)(\w+)\s*$")
_SECTION = re.compile(r"(?:/|\b(?:entry|exit)\s*/)\s*$")


class Mutant(NamedTuple):
    """A mistake in a machine: its kind, its place, and the text that is there instead."""

    machine: str
    kind: str
    place: Span
    text: str

    def __str__(self) -> str:
        path, line = self.place.source.name, self.place.line
        was, now = (" ".join(each.split()) for each in (self.place.text, self.text))
        return f"{Path(path).name}:{line} {self.kind}: {was} => {now or 'nothing'}"

    def write(self, model: Path, folder: Path) -> Path:
        """Copy a model to a folder, with the mistake in it."""
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(model, folder)
        source, start, end = self.place
        assert source.path is not None
        path = folder / source.path.resolve().relative_to(model.resolve())
        path.write_text(source.text[:start] + self.text + source.text[end:], encoding="utf-8")
        return folder


def mutants(system: System, model: Path) -> Iterator[Mutant]:
    """Yield the mutants of the machines in the files of a folder, in the order of the text."""
    found: dict[tuple[str, Span], Mutant] = {}
    for machine in system.machines_by_name.values():
        for state in machine.walk():
            for each in _of_state(machine, state):
                path = each.place.source.path
                if path is not None and model.resolve() in path.resolve().parents:
                    found.setdefault((each.kind, each.place), each)
    yield from found.values()


def _of_state(machine: StateMachine, state: State) -> Iterator[Mutant]:
    name = machine.name
    for transition in state.transitions:
        place = _absolute(transition.origin)
        if place is None or state.kind == StateKind.HISTORY:
            continue
        if transition.triggers:
            yield Mutant(name, "no transition", place, "")
        guard = _absolute(getattr(transition.guard, "origin", None))
        if guard is not None:
            yield Mutant(name, "opposite guard", guard, f"not ({guard.text})")
        yield from _other_target(machine, transition, place)
        yield from _without_sends(name, transition.effects)
    yield from _without_sends(name, state.entry)
    yield from _without_sends(name, state.exit)


def _other_target(machine: StateMachine, transition: Transition, place: Span) -> Iterator[Mutant]:
    """Yield a mutant whose transition leads to the state after its target, around the same one."""
    if transition.target is None:
        return
    around = transition.target.rpartition(".")[0]
    beside = [
        state.name
        for state in machine.walk()
        if state.id.rpartition(".")[0] == around and state.kind != StateKind.REGION
    ]
    written = _TARGET.search(place.text)
    if written is None or written[2] not in beside or len(beside) == 1:
        return
    other = beside[(beside.index(written[2]) + 1) % len(beside)]
    start = place.start + written.start(2)
    yield Mutant(
        machine.name, "other target", Span(place.source, start, start + len(written[2])), other
    )


def _without_sends(machine: str, effects: tuple[object, ...]) -> Iterator[Mutant]:
    for effect in effects:
        place = _absolute(effect.origin) if isinstance(effect, Send) else None
        if place is not None:
            yield Mutant(machine, "no send", _with_separator(place), "")


def _with_separator(place: Span) -> Span:
    """Return an effect with the comma beside it, or with what begins effects if it is alone."""
    source, start, end = place
    before, after = source.text[:start], source.text[end:]
    if after.lstrip().startswith(","):
        return Span(source, start, end + after.index(",") + 1)
    if before.rstrip().endswith(","):
        return Span(source, len(before.rstrip()) - 1, end)
    section = _SECTION.search(before)
    return Span(source, section.start() if section is not None else start, end)


def _absolute(place: Span | None) -> Span | None:
    return place.absolute if place is not None else None
