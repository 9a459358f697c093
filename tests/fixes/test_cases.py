"""Fixes of all diagnostics of the cases in `tests/diagnostics`.

Each help that names code to write, add, declare or remove has a fix that does so; after it, the
diagnostic is gone and no new error is there.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics, Level, Severity
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.fixes import fixes_of
from swarmdsl.driver.fixes.trial import texts_with
from swarmdsl.driver.workspace import Workspace

FOLDER = Path(__file__).parents[1] / "diagnostics"
NAMES = {entry.code: name for name, entry in CODES.items()}
CASES = sorted(path.name for path in FOLDER.glob("SW*") if path.is_dir() or path.suffix != ".txt")
# Help that says what to write.
WRITES = re.compile(
    r"did you mean|\b(?:write|join|move|add|declare|bind|begin|remove (?:it|the)|leave|give it)\b"
)
# Help whose code has holes that only the author can fill, by its beginning.
HOLES = {
    "write `\\u00e9`": "the character is unknown",
    "write `history Back` in a region": "it is one of two designs",
    "a parameter is `in` or `out`": "the second name is unknown",
    "add `maximize ...`": "what is better is unknown",
    "add `fitness Name`": "the model has no fitness",
    "add `behavior` with": "which machine it runs is unknown",
    "add `on ": "where to react, and what comes then, is a decision",
    "give it a duration": "how long is a decision",
    "declare it in the model, or `import ros": "the definition is elsewhere",
    "declare both in": "it says which unit two declarations share",
    "only arrays have items": "the guard is meant, or another variable",
    "a contract belongs": "there may be several members",
    "begin the ": "which robots are meant is unknown",
    "declare a fitness": "what it measures is unknown",
}
# A diagnostic whose fix leaves another error, by case and wrong text.
FURTHER = {
    ("SW0002_import_of_a_folder", '"common"'): "the folder has no interfaces of ROS",
    ("SW0008_packages", "Camera"): "there is no such package at all",
    ("SW0103_state", "final"): "the name is also used",
    ("SW0202_enum_operation_role", "AUTOO"): "it is a value of another type",
    ("SW0202_imported_name", "uav_mavros_takof"): "its goal is not complete",
    ("SW0202_imported_name", "functions"): "a goal in it is not complete",
    ("SW0202_nothing_follows", "Strat"): "its fields are used",
    ("SW0202_nothing_follows", "Postion"): "its fields are used",
    ("SW0202_nothing_follows", "Lokking"): "its states are used",
    ("SW0202_nothing_follows", "flly"): "its fields are used",
    ("SW0202_nothing_follows", "Camra"): "its ports are used",
    ("SW0202_port", "oder"): "the ports do not fit",
    ("SW0202_type", "Staus"): "the type is in itself",
    ("SW0311_robots", "rover"): "that one is there already",
    ("SW0406_equipment", "rang"): "that one is there already",
    ("SW0546_indented", "after 20 s"): "a transition follows on the line",
    ("SW0610_folder", "stds_msgs/Header"): "the text is in a file of ROS",
    ("SW0702_operands", "round(3 s)"): "a number is no duration, which is wanted",
    ("SW0709_no_sender", "sender"): "a monitored topic is no event",
    ("SW1601_unclear_fitness", "Pace"): "it is measured in both swarms",
}


def kinds(report: Diagnostics) -> tuple[Counter[tuple[str, str]], Counter[tuple[str, str]]]:
    every = list(report)
    errors = (each for each in every if each.severity is Severity.ERROR)
    return Counter((e.code, e.message) for e in every), Counter((e.code, e.message) for e in errors)


def faults(case: str, needed: set[object]) -> Iterator[str]:
    """Faults of the fixes of a case; adds the exceptions that it needs to `needed`."""
    workspace = Workspace([Path(case)], Settings(levels={NAMES[case[:6]]: Level.WARN}))
    found = list(workspace.report)
    proposed = [fixes_of(each, workspace) for each in found]
    before, errors = kinds(workspace.report)
    for each, fixes in zip(found, proposed, strict=True):
        text = each.primary.span.text if each.primary is not None else ""
        about = f"{case}: {each.message}: {each.help}"
        further = (Path(case).stem, text)
        if fixes:
            with workspace.overriding(texts_with(fixes[:1])):
                after, errors_after = kinds(workspace.report)
            kind = (each.code, each.message)
            if after[kind] < before[kind] and not errors_after - errors:
                continue
        elif each.help is None or "`" not in each.help or not WRITES.search(each.help):
            continue
        hole = next((start for start in HOLES if each.help and each.help.startswith(start)), None)
        if further in FURTHER:
            needed.add(further)
        elif hole is not None and not fixes:
            needed.add(hole)
        else:
            yield f"{about}: {fixes[0].title if fixes else 'no fix'}"


def test_fixes_of_all_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER)
    needed: set[object] = set()
    assert [fault for case in CASES for fault in faults(case, needed)] == []
    assert {*HOLES, *FURTHER} - needed == set()
