"""The page on tests has every key and every code."""

from __future__ import annotations

import re
from pathlib import Path

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.execution.testing.keys import ACTIONS, CLAIM, FILE, TEST, TIMES, WAIT

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "testing.md").read_text(encoding="utf-8")


def test_all_keys() -> None:
    keys = {
        *FILE,
        *TEST,
        *CLAIM,
        *TIMES,
        *WAIT,
        *(key for step in ACTIONS.values() for key in step),
    }
    code = " ".join(re.findall(r"```.*?```|`[^`]+`", PAGE, re.DOTALL))

    assert {"passing", "sends", "as"} <= keys
    assert {key for key in keys if not re.search(rf"\b{key}\b", code)} == set()


def test_all_codes() -> None:
    codes = {entry.code for entry in CODES.values() if "SW11" < entry.code < "SW12"}

    assert codes
    assert codes - set(re.findall(r"SW\d{4}", PAGE)) == set()
