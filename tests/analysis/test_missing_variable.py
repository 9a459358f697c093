"""Hints that declare an unresolved name in an expression."""

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MODEL = """\
package {package}
{imports}
enum Mode : uint8 {{ A, B }}
event Go : std_msgs/Empty
statemachine M {{
  var m : Mode = Mode.A
  var n : int16 = 1
  var flag : bool = false
  var dly : duration
  {value}
  initial S
  state S {{ {line} }}
  final F
}}
"""


def helps(path: Path) -> list[str | None]:
    return [each.help for each in pipeline.check([path]).report if each.name == "unresolved-name"]


def hints(folder: Path, line: str = "", value: str = "", package: str = "p") -> list[str | None]:
    path = folder / "model.swarm"
    path.write_text(MODEL.format(line=line, value=value, package=package, imports=""))
    return helps(path)


def line(name: str, type_: str) -> str:
    return f"declare it in `M`: `var {name} : {type_}`"


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("on Go [xx] -> F", "bool = false"),
        ("on Go [not xx] -> F", "bool = false"),
        ("after xx -> F", "duration"),
        ("on Go / n = xx -> F", "int16 = 0"),
        ("on Go / xx = n -> F", "int16 = 0"),
        ("on Go [n < xx] -> F", "int16 = 0"),
        ("on Go [xx == m] -> F", "Mode"),
        ("on Go [m == xx] -> F", "Mode"),
    ],
)
def test_a_certain_type_is_in_the_hint(tmp_path, text, type_):
    assert hints(tmp_path, text) == [line("xx", type_)]


@pytest.mark.parametrize(
    "text",
    [
        "on Go / xx = -3 -> F",
        "on Go [xx == -1] -> F",
        "on Go / xx = 5000000000 -> F",
        "on Go / xx = 1 + 2.5 -> F",
        "on Go / xx = 3 / 2 -> F",
        "on Go / xx = 2 * 5 s -> F",
        "after 2 * xx -> F",
        "after xx * 2 s -> F",
        "on Go / flag = xx / 2 s > 1 -> F",
        "on Go [abs(xx) > n] -> F",
    ],
)
def test_no_type_is_guessed_in_arithmetic(tmp_path, text):
    assert hints(tmp_path, text) == ["declare it in `M` with its type: `var xx : ...`"]


def test_the_order_of_names_does_not_matter(tmp_path):
    found = hints(tmp_path, "on Go [yy == m and m == xx] -> F")
    assert found == [line("yy", "Mode"), line("xx", "Mode")]


@pytest.mark.parametrize("package", ["a1", "my.model"])
def test_a_type_is_written_as_the_file_sees_it(tmp_path, package):
    assert hints(tmp_path, "on Go [xx == m] -> F", package=package) == [line("xx", "Mode")]


@pytest.mark.parametrize("kind", ["var", "param"])
def test_where_only_a_constant_can_stand(tmp_path, kind):
    found = hints(tmp_path, "on Go -> F", f"{kind} e : uint8 = start")
    assert found == ["declare it above `M`: `const start : uint8 = ...`"]


def test_an_import_is_of_the_library_that_is_used(tmp_path):
    path = tmp_path / "model.swarm"
    model = (
        "package p\n{}statemachine M {{ initial S; state S {{ on TargetFound -> F }} final F }}\n"
    )
    declared = "declare it: `event TargetFound : std_msgs/Empty`"
    for imports, expected in [
        ("", declared),
        ("import cpswarm_uint32.interfaces.*\n", "add `import cpswarm_uint32.events.TargetFound`"),
        ("import cpswarm.interfaces.*\n", "add `import cpswarm.events.TargetFound`"),
    ]:
        path.write_text(model.format(imports))
        assert helps(path) == [expected]


def test_what_a_library_has_comes_before_what_is_only_similar(tmp_path):
    path = tmp_path / "model.swarm"
    path.write_text(
        "package p\nimport cpswarm.interfaces.*\nevent MissionStarted : std_msgs/Empty\n"
        "statemachine M { initial S; state S { on MissionStart -> F } final F }\n"
    )
    assert helps(path) == ["add `import cpswarm.events.MissionStart`"]
