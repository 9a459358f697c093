"""States and variables that properties name: with or without regions, and of states."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.driver import pipeline

MODEL = """package lab

event Go : std_msgs/Empty
endless statemachine M {{
  initial A
  state A {{ on Go -> Both }}
  parallel state Both {{
    region Work {{
      initial Free
      state Free {{ on Go -> Bringing }}
      state Bringing {{
        var tries : int32 = 0
        var other : int32 = 0
        entry / tries = tries + 3, other = tries
        after 1 s [other == tries] -> Free
      }}
    }}
    region Look {{
      initial Free
      state Free {{
        var other : int32 = 0
        on Go / other = other + 1 -> Free
      }}
    }}
  }}
}}
property P of M : {sentence}
"""


def errors(sentence: str, folder: Path) -> list[tuple[str, str | None]]:
    file = folder / "lab.swarm"
    file.write_text(MODEL.format(sentence=sentence), encoding="utf-8")
    return [(each.code, each.help) for each in pipeline.check([file]).report]


@pytest.mark.parametrize(
    ("sentence", "verdict"),
    [
        ("never in Both.Work.Bringing", "violated"),
        ("never in Work.Bringing", "violated"),
        ("never in Both.Bringing", "violated"),
        ("never in Bringing", "violated"),
        ("never in Both and not in Look.Free", "holds"),
        ("never in Both and not in Work.Free", "violated"),
        ("never has [tries > 2]", "violated"),
        ("never has [tries > 3]", "holds"),
    ],
)
def test_a_name_means_one(
    sentence: str, verdict: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert errors(sentence, tmp_path) == []
    (tmp_path / "lab.swarmtest.toml").write_text(
        'model = "lab.swarm"\n[[test]]\nname = "it"\n'
        f'{"violates" if verdict == "violated" else "properties"} = ["P"]\n'
        'steps = [{ send = "Go" }, { send = "Go" }, { in = "Bringing" }, { pass = "2 s" }]\n',
        encoding="utf-8",
    )
    assert run(["test", str(tmp_path / "lab.swarmtest.toml")]) == 0, capsys.readouterr().out


@pytest.mark.parametrize("name", ["Free", "Both.Free"])
def test_states_of_two_regions_are_told_apart(name: str, tmp_path: Path) -> None:
    help_ = "write `Both.Work.Free` or `Both.Look.Free`"
    assert errors(f"never in {name}", tmp_path) == [("SW0203", help_)]


def test_a_variable_that_two_states_have_is_unknown(tmp_path: Path) -> None:
    ((code, help_),) = errors("never has [other > 2]", tmp_path)
    assert code == "SW0202"
    assert help_ is not None
    assert "a variable of" in help_


@pytest.mark.parametrize(
    "place", ["state A {{ on Go -> {} }}", "state A {{ on Go [in({})] -> A }}"]
)
def test_a_region_in_a_path_of_a_model_is_answered(place: str, tmp_path: Path) -> None:
    text = MODEL.format(sentence="never in A")
    text = text.replace("state A { on Go -> Both }", place.format("Both.Work.Bringing"))
    (tmp_path / "lab.swarm").write_text(text, encoding="utf-8")
    report = pipeline.check([tmp_path / "lab.swarm"]).report

    found = [(each.message, each.help) for each in report if each.code == "SW0202"]
    help_ = "paths leave out regions: write `Both.Bringing`"
    assert found == [("no state in `Both` called `Work`", help_)]
