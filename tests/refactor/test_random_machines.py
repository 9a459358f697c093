"""Refactorings of random machines keep what they do, their comments, and the layout."""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.lowering import lower
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Parallel, State, StateMachine, walk
from swarmdsl.syntax.formatter import format_source
from swarmdsl.tools.refactor.extract_machine import extract_machine
from swarmdsl.tools.refactor.inline_state import inline_state
from swarmdsl.tools.refactor.selected_states import Selection, selected_states
from swarmdsl.tools.refactor.wrap_states import new_name, wrap_states

from .random_machines import random_model
from .traces import behaviour, comments

SEEDS = range(12)
CHANGES: Sequence[Callable[[Workspace, File, Selection], dict[Path, str]]] = (
    *(wrap_states, extract_machine, extract_machine, inline_state),
)


def test_traces_stay(tmp_path: Path) -> None:
    done: Counter[str] = Counter()
    for seed in SEEDS:
        path = tmp_path / f"model{seed}.swarm"
        path.write_text(random_model(seed), encoding="utf-8")
        workspace = Workspace([path])
        file = workspace.file(path)
        if workspace.report.has_errors or file is None:
            continue
        before = lower(workspace.project)
        for change in CHANGES:
            selection = _selection(file, Random(f"{seed} {change.__name__}"), change)
            try:
                texts = change(workspace, file, selection)
            except RefusedError:
                continue
            done[change.__name__] += 1
            done["ends"] += "on done.To" in texts[path]
            assert format_source(Source("", texts[path]), Diagnostics()) == texts[path]
            lost = comments(file.source.text) - comments(texts[path])
            assert lost == Counter()
            inlined = change is inline_state
            gone = selection.states[0].name if inlined else new_name(selection)
            with workspace.overriding(texts):
                behaviour(before, lower(workspace.project), "M", str(gone))
    assert (
        min(done[each] for each in ("wrap_states", "extract_machine", "inline_state", "ends")) > 0
    )


def _selection(file: File, dice: Random, change: Callable[..., object]) -> Selection:
    """Return a state alone, or with some after it; one that can be dissolved for that."""
    [machine] = [each for each in file.model.declarations if isinstance(each, StateMachine)]
    states = [each for each in walk(machine) if isinstance(each, (State, Parallel))]
    composite = [each for each in states if any(isinstance(i, State) for i in each.items)]
    if change is inline_state and composite:
        states = composite
    span = dice.choice(states).span.absolute
    more = 0 if change is inline_state else dice.choice((0, 0, 100, 400))
    last = re.compile(r"\s+final End").search(file.source.text)
    end = min(span.end + more, last.start() if last is not None else span.end)
    alone = change is inline_state
    found = selected_states(file, Span(file.source, span.start, span.start if alone else end))
    assert found is not None
    return found
