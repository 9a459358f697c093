"""The table that `swarmc targets smach` prints for ROS 2 says what the generator does."""

from __future__ import annotations

import pytest

from swarmdsl.codegen.registry import load

from ...ros2_outcomes.table import MODELS, Generate, Reported, check_row

TABLE = load("smach").mapping_with["ros=2"]
OWN = {
    "name that userdata cannot have": """
        var keys : int32
        state A { on Go [keys > 1] -> End; on Stop / keys = 2 }""",
}


def test_every_construct_has_a_row() -> None:
    assert {each.construct for each in TABLE} == {*MODELS, *OWN}


@pytest.mark.parametrize("number", range(len(TABLE)), ids=[each.construct for each in TABLE])
def test_the_table_is_true(number: int, generate: Generate, reported: Reported) -> None:
    body = {**MODELS, **OWN}[TABLE[number].construct]
    check_row(TABLE[number], body, "smach", "_smach", generate, reported)
