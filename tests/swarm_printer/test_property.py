"""The text of any system has the meaning of the system."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import Phase, given, settings

from swarmdsl.codegen.swarm_printer.system import normalized
from swarmdsl.ir import System

from .round_trip import printed_and_compiled
from .systems import systems


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
@settings(
    max_examples=75,
    phases=[Phase.generate],  # shrinking would take minutes
)
@given(systems())
def test_the_text_of_a_system_means_that_system(tmp_path: Path, system: System) -> None:
    assert normalized(system) == system
    assert printed_and_compiled(system, tmp_path) == system
