"""Verdicts that are open name a way out, which leads on."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.cli import run

_PRELUDE = """package test
message Number {{ n : int32 }}
event Go : std_msgs/Empty
event Level : Number
swarm event Ask : Number
statemachine M {{
  var least : int32 = 3
  initial S0
  state S0 {{
    on Go / send Ask(n = 1), send Ask(n = 2), send Ask(n = 3) -> S1
    on Level [event.n > {level}] -> S1
  }}
  state S1 {{ on Go -> End }}
  final End
}}
endless statemachine N {{
  initial T0
  state T0 {{ on Ask [event.n == 1] -> T1 }}
  state T1 {{ on Ask [event.n == 2] -> T2 }}
  state T2 {{ on Ask [event.n == 3] -> T3 }}
  state T3
}}
member A {{ behavior M }}
member B {{ behavior N }}
swarm S {{
  a : A[1..*]
  b : B
}}
property P of S : {property}
"""


def told(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    property_: str,
    *options: str,
    level: str = "3",
) -> str:
    """Return the verdict on a property, with its reason."""
    model = folder / "model.swarm"
    model.write_text(_PRELUDE.format(property=property_, level=level), encoding="utf-8")
    run(["verify", str(model), "--property", "P", *options])
    lines = capsys.readouterr().out.splitlines()
    return next(line for line in lines if line.startswith("  P  "))


def option_in(line: str) -> list[str]:
    found = re.search(r"`(--[a-z]+) ([^`]*)`", line)
    assert found is not None, line
    return [found[1], found[2]]


def test_a_channel_that_loses_too_much_can_be_longer(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    leads = "b in T2 leads to b in T3"
    line = told(tmp_path, capsys, leads)
    assert "P  unknown" in line
    assert "one is lost in it" in line
    assert option_in(line) == ["--channel", "3"]
    assert "one is lost in it" not in told(tmp_path, capsys, leads, *option_in(line))


def test_a_search_that_ended_can_go_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    never = "never b in T3 and some a in End"
    line = told(tmp_path, capsys, never, "--limit", "3")
    assert "holds up to" in line
    assert "`--limit`" in line
    assert "`--size`" in line
    assert "holds up to" not in told(tmp_path, capsys, never, "--limit", "10k", "--channel", "3")


def test_numbers_of_robots_can_be_chosen(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = told(tmp_path, capsys, "always possible all a in End", "--size", "a=any")
    assert "P  unknown" in line
    assert "`--size a=1..3`" in line
    assert "P  holds" in told(tmp_path, capsys, "always possible all a in End", *option_in(line))


def test_a_probability_can_be_estimated(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for bound in ("at least", "at most"):
        line = told(tmp_path, capsys, f"never some a in End {bound} 0.5")
        assert "P  unknown" in line
        assert option_in(line.replace("swarmc simulate ", "")) == ["--runs", "1000"]


def test_values_that_are_not_all_tried_can_be_compared_with_constants(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    only = "each a : in S1 only after (hears Go or hears Level [event.n > 3])"
    line = told(tmp_path, capsys, only, level="least")
    assert "P  unknown" in line
    assert "compare it with constants only" in line
    assert "P  holds" in told(tmp_path, capsys, only, level="3")


def test_a_property_of_another_one_does_not_make_robots_different(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # Only the second property names a robot that is not in all swarms.
    line = told(tmp_path, capsys, "each a : in End only after in S1", "--size", "a=any")
    assert "P  holds" in line
    model = tmp_path / "model.swarm"
    text = "each a : in End only after in S1\nproperty Q of S : never a[2] in End"
    model.write_text(_PRELUDE.format(property=text, level="3"), encoding="utf-8")
    run(["verify", str(model), "--size", "a=any", "--property", "P"])
    assert "P  holds" in capsys.readouterr().out
    run(["verify", str(model), "--size", "a=any", "--property", "P", "--property", "Q"])
    told_ = capsys.readouterr().out
    assert re.search(r"P +holds", told_)
    assert "Q  unknown" in told_


_BEATS = """package test
event Go : std_msgs/Empty
endless statemachine M {
  initial Two
  state Two { on member_lost -> One }
  state One { on Go -> One }
}
member A { behavior M }
swarm S {
  a : A[2]
  heartbeat 1 s lost after 5 s
}
property P of S : never some a in One
"""
_APART = '[[faults]]\nat = "1 s"\nlasts = "9 s"\napart = [["a[0]"], ["a[1]"]]\n'


@pytest.mark.parametrize("scenario", [_APART, "[network]\nloss = 1\n"])
def test_robots_can_be_lost_instead_of_their_heartbeats(
    scenario: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, conditions = tmp_path / "model.swarm", tmp_path / "silent.toml"
    model.write_text(_BEATS, encoding="utf-8")
    conditions.write_text(scenario, encoding="utf-8")

    run(["verify", str(model), "--scenario", str(conditions)])
    out = capsys.readouterr().out
    assert re.search("P  unknown  .* robots do without others with `--faults`, and no", out), out
    run(["verify", str(model), "--faults", "1"])
    assert "P  fails" in capsys.readouterr().out
