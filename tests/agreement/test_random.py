"""Machines made by chance do the same in every engine."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import pytest
from hypothesis import Phase, given, settings

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange import scxml
from swarmdsl.execution.engine import LoopError
from swarmdsl.ir import System

from ..swarm_printer.systems import systems
from .engines import ENGINES, with_values
from .known import expected
from .replay import difference, installed
from .scripts import Model, Subject

FEW, MANY = 25, 80
"""Numbers of models; many with `--agreement`."""


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_engines_agree_about_models(
    agree: Callable[..., None], pytestconfig: pytest.Config
) -> None:
    most = MANY if pytestconfig.getoption("--agreement") else FEW
    scripts: Counter[str] = Counter()

    @settings(max_examples=most, phases=[Phase.generate])
    @given(systems())
    def run(system: System) -> None:
        files = {
            f.path: f.text for f in scxml.emit(system, scxml.Options("portable"), Diagnostics())
        }
        for machine in system.machines:
            try:
                subject = Subject(machine, system)
                if Model(subject).went_on:
                    continue
                made = [subject.script(steps) for steps in subject.walks()]
            except LoopError:
                continue
            document = with_values(files[f"{machine.name}.scxml"], subject.given)
            for engine in installed():
                if expected(machine, engine) is None:
                    found = [difference(ENGINES[engine], document, script) for script in made]
                    assert found == [None] * len(found), (engine, document.decode())
                    scripts[engine] += len(found)

    run()
    for engine, number in scripts.items():
        agree("models made by chance", engine, number, number)
