"""Complete output for a model: the IR and the files of every target.

`pytest --bless` writes what is expected anew; read the difference before you commit it.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.render import render
from swarmdsl.codegen import registry
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.ir.dump import dump

from .targets import COMPOSED

ROOT = Path(__file__).resolve().parents[1]
GOLDEN = ROOT / "tests" / "golden"
SHOWN = Path("examples", "search_and_rescue")
CASES = {
    "minimal": ROOT / "examples" / "minimal",
    "search_and_rescue": ROOT / SHOWN,
    **{model.parent.name: model for model in sorted(GOLDEN.glob("*/model.swarm"))},
}


@pytest.fixture
def made(case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Everything made of a case, as text by path."""
    monkeypatch.chdir(ROOT)
    return make(CASES[case], tmp_path / "out")


# The engine is that of this project, which tests of the targets compare with it.
ENGINE = re.compile(r"(smach|ros2|smach_ros2|yasmin)/\w+/(src/\w+/engine/\w+|\w+/engine)\.py")
# What else is the same in each package is looked at in one.
SAME_IN_ALL = re.compile(
    r"smach/\w+/src/\w+/(actions|chart|containers|identity|node|services|states)\.py"
    r"|ros2/\w+/(\w+/(alarms|diagnostics|functions|host|identity|members|node|parameters|topics|tracing"
    r"|values)\.py"
    r"|test/test_(copyright|flake8|pep257)\.py|setup\.cfg)"
    r"|(yasmin|smach_ros2)/\w+/\w+/(following|library|node|runner|states)\.py"
)


# A map of the usual cells has millions of them.
OPTIONS = {"nav2_map": {"resolution": "5"}}


def make(model: Path, out: Path) -> dict[str, str]:
    model = model.relative_to(ROOT)
    checked = pipeline.check([model])
    assert checked.system is not None, [found.message for found in checked.report]
    texts = {"ir.txt": dump(checked.system)}
    # What is to be filled in has golden files of its own, in tests/skeleton.
    for target in [name for name in registry.BUILT_IN if name not in {"skeleton", *COMPOSED}]:
        result = pipeline.build([model], [Request(target, OPTIONS.get(target, {}))], out)
        if len(result.report):
            texts[f"{target}.diagnostics.txt"] = rendered(result)
    pipeline.build([model], [Request("smach", {"ros": "2"})], out / "with")
    (out / "with" / "smach").rename(out / "smach_ros2")
    for path in sorted(out.rglob("*")):
        name = path.relative_to(out).as_posix()
        common = ENGINE.fullmatch(name) or (model != SHOWN and SAME_IN_ALL.fullmatch(name))
        if path.is_file() and not path.name.startswith(".swarmdsl") and not common:
            text = path.read_text(encoding="utf-8")
            # Targets `yasmin` and, on ROS 2, `smach` add to the package of `ros2`.
            base = out / re.sub("^(yasmin|smach_ros2)/", "ros2/", name)
            if base == path or not base.exists() or base.read_text(encoding="utf-8") != text:
                texts[name] = text
    return texts


def rendered(result: pipeline.Result) -> str:
    from io import StringIO

    stream = StringIO()
    render(result.report, "concise", stream)
    return stream.getvalue()


@pytest.mark.parametrize("case", CASES)
def test_golden(case: str, made: dict[str, str], request: pytest.FixtureRequest) -> None:
    expected = GOLDEN / case / "expected"
    if request.config.getoption("--bless"):
        for path in sorted(expected.rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        for name, text in made.items():
            (expected / name).parent.mkdir(parents=True, exist_ok=True)
            (expected / name).write_text(text, encoding="utf-8")
    known = {
        path.relative_to(expected).as_posix(): path.read_text(encoding="utf-8")
        for path in expected.rglob("*")
        if path.is_file()
    }

    assert sorted(known) == sorted(made)
    for name, text in made.items():
        assert known[name] == text, name


@pytest.mark.parametrize("case", CASES)
def test_same_input_same_bytes(case: str, made: dict[str, str], tmp_path: Path) -> None:
    assert make(CASES[case], tmp_path / "again") == made
