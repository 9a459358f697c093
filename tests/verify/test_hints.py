"""Hints at what could prevent a run."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .test_saved_test import EXAMPLES

Verified = Callable[..., str]
LANDING, ASKING = EXAMPLES["landing"], EXAMPLES["asking"]
WATCHED = EXAMPLES["watched"] + "property Ends of Field : each drone : in Land leads to in Down\n"


@pytest.fixture
def verified(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Verified:
    """Verify a property of a model, and return what is printed."""

    def verified(text: str, name: str, *options: str) -> str:
        path = tmp_path / "model.swarm"
        path.write_text(text, encoding="utf-8")
        run(["verify", str(path), "--property", name, *options])
        return capsys.readouterr().out

    return verified


def helps(out: str) -> list[str]:
    return re.findall(r"= help: (.*)", out)


def test_an_ignored_event_of_another_robot_is_named(verified: Verified) -> None:
    out = verified(LANDING, "AllDown")

    (told,) = helps(out)
    assert told.startswith("`drone[1]` ignores `Free` in `Circle`: handle it there with `on Free`")
    assert told.endswith("or keep it with `defer Free`")
    assert "Free (ignored)  (from drone[0])" in out
    assert re.search(r"Taken -> Wait; cancel circle  \(from drone\[0\], .*model.swarm:15\)", out)
    mended = LANDING.replace("    do circle\n", "    do circle\n    defer Free\n")
    assert re.search("AllDown +holds", verified(mended, "AllDown"))


def test_a_guard_that_was_false_is_named(verified: Verified) -> None:
    guarded = LANDING.replace(
        "    on Taken -> Wait\n", "    on Taken -> Wait\n    on Free [self.count > 9] -> Circle\n"
    )
    (told,) = helps(verified(guarded, "AllDown"))

    assert "`drone[1]` ignores `Free` in `Circle`: the guard in " in told
    assert told.endswith("model.swarm:16 is false then")


def test_a_lost_event_that_nothing_follows_is_named(verified: Verified) -> None:
    out = verified(ASKING, "CanLand", "--lossy")
    hint = "`drone[0]` waits in `Wait`, though `Ask` is lost: add `after` a time there"
    assert helps(out) == [hint]

    mended = ASKING.replace(
        "on Yes -> Land }", "on Yes -> Land\n    after 5 s / send Ask -> Wait }"
    )
    assert helps(verified(mended, "CanLand", "--lossy")) == []

    ends = ASKING.replace("CanLand of", "Ends of Field : each drone : in Wait leads to in Down //")
    out = verified(ends, "Ends", "--lossy")
    assert "nothing happens to `drone[0]` and `tower[0]` any more" in out
    assert helps(out) == [hint]


def test_the_last_of_several_that_lose_an_event_is_named(verified: Verified) -> None:
    two = ASKING.replace("drone : Drone", "drone : Drone[2]")
    all_ = two.replace("CanLand of", "Ends of Field : always possible some drone in Down //")
    hint = "`drone[1]` waits in `Wait`, though `Ask` is lost: add `after` a time there"
    assert helps(verified(all_, "Ends", "--lossy")) == [hint]


def test_a_function_that_never_ends_is_named(verified: Verified) -> None:
    out = verified(WATCHED, "Ends", "--never", "land")
    hint = "`drone[0]` waits in `Land` for `land`, which may never end: add `after` a time there"
    assert helps(out) == [hint]


def test_news_of_a_lost_robot_that_are_ignored_are_named(verified: Verified) -> None:
    (told,) = helps(verified(WATCHED, "Lands", "--faults", "1"))
    assert told.startswith("`drone[0]` ignores `member_lost` in `Circle`: handle it there with")


def test_an_ignored_event_after_which_nothing_happens_is_named(verified: Verified) -> None:
    text = LANDING.replace("AllDown  of", "Ends of Drones : each drone : eventually in Down //")
    out = verified(text, "Ends")

    assert "nothing happens to `drone[0]` and `drone[1]` any more" in out
    (told,) = helps(out)
    assert told.startswith("`drone[1]` ignores `Free` in `Circle`: handle it there with `on Free`")


def test_data_on_which_anything_depends_are_shown(verified: Verified) -> None:
    sorting = """package test
message Part { weight : float64, label : string, fine : bool, code : uint8, number : int32 }
event Seen : Part
endless statemachine Sort {
  initial Look
  state Look { on Seen [event.weight > 2.5 and event.label == "x" and event.fine] -> Take }
  state Take { on Seen [event.code == 7 and event.number < 0] -> Look }
}
member Arm { behavior Sort }
swarm Cell { arm : Arm }
property Takes of Cell : never arm in Take
"""
    shown = r"Seen -> Take  \(code = 0, fine = true, label = \"x\", number = 0, \.\.\., .*swarm:6\)"
    assert re.search(shown, verified(sorting, "Takes"))


def test_robots_that_only_start_are_left_out_of_long_runs(verified: Verified) -> None:
    out = verified(LANDING.replace("[2..4]", "[2..*]"), "OneLands", "--size", "drone=50")

    assert "note: 48 robots only start, and are left out here\n" in out
    assert re.findall(r"note: +\d\.000  (\S+) +(\S+)", out) == [
        ("drone[0]", "(start)"),
        ("drone[1]", "(start)"),
        ("drone[0]", "do.Circle.succeeded"),
        ("drone[1]", "do.Circle.succeeded"),
    ]


def test_nothing_is_hinted_where_the_run_does_not_show_it(verified: Verified) -> None:
    out = verified(LANDING, "OneLands")

    assert "SW1701" in out
    assert helps(out) == []
