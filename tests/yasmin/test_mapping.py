"""The table that `swarmc targets yasmin` prints says what the generator does."""

from __future__ import annotations

import pytest

from swarmdsl.codegen.registry import load

from ..ros2_outcomes.table import HEADER, MODELS, Generate, Reported, check_row

TABLE = load("yasmin").mapping
OWN = {"state called `canceled`": "state A { on Go -> canceled } state canceled { on Go -> End }"}


def test_every_construct_has_a_row() -> None:
    assert {each.construct for each in TABLE} == {*MODELS, *OWN}


@pytest.mark.parametrize("number", range(len(TABLE)), ids=[each.construct for each in TABLE])
def test_the_table_is_true(number: int, generate: Generate, reported: Reported) -> None:
    body = {**MODELS, **OWN}[TABLE[number].construct]
    check_row(TABLE[number], body, "yasmin", "_fsm", generate, reported)


def test_a_package_of_interfaces_that_would_hide_yasmin(reported: Reported) -> None:
    machine = "statemachine Work { initial A; state A { on Go -> End } final End }"
    model = HEADER.replace("package lab", "package yasmin_ros") + machine
    ((code, message, _),) = reported(model, package="lab")
    assert (code, "YASMIN has a package" in message) == ("bad-identifier", True)
