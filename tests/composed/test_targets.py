"""Targets `promela`, `murphi` and `jani`: files, tables of constructs, and their limits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.codegen.api import Support
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline
from swarmdsl.execution.verify.swarm import model as models

from ..agreement.witnesses import MISSING, check

LANDING = Path(__file__).parent / "landing.swarm"
GOLDEN = Path(__file__).parent / "golden"
SUFFIX = {"promela": "pml", "murphi": "m", "jani": "jani"}

HEAD = """package p
swarm event Go : std_msgs/Empty
swarm event Told : std_msgs/String
"""
TAIL = "member A { behavior M }\nswarm S { a : A[2] }\n"
MACHINE = "statemachine M {\n  initial X\n  state X { on Go -> Y }\n  final Y\n}\n"


def build(path: Path, out: Path, target: str = "promela", **options: str) -> pipeline.Result:
    return pipeline.build([path], [Request(target, options)], out)


@pytest.fixture
def made(tmp_path: Path) -> Path:
    path = tmp_path / "model.swarm"
    path.write_text(HEAD + MACHINE + TAIL, encoding="utf-8")
    return path


@pytest.mark.parametrize("target", SUFFIX)
def test_files_are_as_before(target: str, tmp_path: Path, bless: bool) -> None:
    build(LANDING, tmp_path, target)
    files = {path.name: path.read_text("utf-8") for path in tmp_path.glob(f"{target}/*")}
    if bless:
        for name, text in files.items():
            (GOLDEN / name).write_text(text, encoding="utf-8")

    before = GOLDEN.glob(f"*.{SUFFIX[target]}")
    assert files == {path.name: path.read_text("utf-8") for path in before}


@pytest.mark.parametrize("target", SUFFIX)
def test_the_table_is_true(target: str, tmp_path: Path) -> None:
    generator = load(target)
    build(LANDING, tmp_path, target)
    text = "".join(path.read_text("utf-8") for path in tmp_path.glob(f"{target}/*"))

    for row in generator.mapping:  # type: ignore[union-attr]
        quoted = re.findall(r"`([^`]+)`", row.means)
        if row.support is Support.REJECTED:
            assert re.search(r"\(SW\d{4}\)", row.means)
        else:
            assert [each for each in quoted if each != "lossy" and each not in text] == []


@pytest.mark.parametrize(
    ("sentence", "reason"),
    [
        ("each a : eventually in Y", "it is about what must happen"),
        ("each a : always possible in Y", "`always possible` is not about single runs"),
        ("each a : eventually in Y within 3 s", "it is about time"),
        ("never count(a in Y) > 1 at least 0.9", "it is about a probability"),
    ],
)
def test_properties_that_are_left_out(made: Path, sentence: str, reason: str) -> None:
    text = made.read_text("utf-8")
    made.write_text(f"{text}property P of S : {sentence}\n", encoding="utf-8")

    found = build(made, made.parent / "out").report

    (left,) = [each for each in found if each.code == "SW0916"]
    assert left.message == f"target `promela` cannot represent property `P`: {reason}"
    assert left.primary is not None
    assert left.primary.span.text == "P"
    assert [path.name for path in made.parent.glob("out/promela/*")] == ["S.pml"]


def test_a_robot_with_too_many_states(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(models, "MOST_STATES", 50)
    machine = """statemachine M {
  var n : uint32
  initial X
  state X {
    on Go / n = n + 1 -> X
    on Told [n > 1000] -> Y
  }
  final Y
}
"""
    made.write_text(HEAD + machine + TAIL, encoding="utf-8")

    found = list(build(made, made.parent / "out").report)

    (left,) = [each for each in found if each.code == "SW0916"]
    assert "a `a` has too many states: bound `M.n`" in left.message
    assert not (made.parent / "out" / "promela").exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"size": "b=2"}, "no swarm has a role `b`"),
        ({"size": "a"}, "must be numbers of members"),
        ({"size": "a=1, a=2"}, "must be numbers of members"),
        ({"size": "a=201"}, "must be numbers of members"),
        ({"size": "a=3"}, "`S` has 2 `a`"),
        ({"channel": "0"}, "must be a number from 1 to 200"),
    ],
)
def test_mistakes_in_options(made: Path, options: dict[str, str], words: str) -> None:
    found = build(made, made.parent / "out", **options).report

    (mistake,) = found
    assert mistake.code == "SW0904"
    assert words in mistake.message


def test_params_without_values_are_told(made: Path) -> None:
    text = made.read_text("utf-8").replace("{\n  initial", "{\n  param speed : float64\n  initial")
    made.write_text(text, encoding="utf-8")

    found = list(build(made, made.parent / "out").report)

    assert "param `speed` of `M` has no value" in found[0].message


@pytest.mark.parametrize(
    "target",
    [
        pytest.param(target, marks=pytest.mark.skipif(reason != "", reason=reason))
        for target, reason in MISSING.items()
    ],
)
def test_loss_and_data_reach_the_checkers(target: str, tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    path.write_text(
        """package p
message Word { text : string }
swarm event Told : Word
event Go : std_msgs/Empty
statemachine M {
  initial X
  state X {
    on Go / send Told(text = "*/ #define X \\\\ \\"") -> Y
    on Told [event.text == "*/ #define X \\\\ \\""] -> Z
  }
  state Y { on Told -> Z }
  final Z
}
member A { behavior M }
swarm S { a : A[2] }
property Both of S : never count(a in Z) == 2
property Some of S : all a in Z only after some a in Z
""",
        encoding="utf-8",
    )

    assert not build(path, tmp_path / "out", target, lossy="true").report.has_errors

    made = tmp_path / "out" / target
    files = [made / f"S_{name}.{SUFFIX[target]}" for name in ("Both", "Some")]
    assert [found.violated for found in check(target, files, tmp_path)] == [True, False]
