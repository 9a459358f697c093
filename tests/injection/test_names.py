"""Names of files, worlds and packages, and options: safe, or rejected at their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import yaml

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen import registry
from swarmdsl.codegen.emit import Request, emit
from swarmdsl.codegen.options import options_of
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.syntax.parser.literals import quoted

from .conftest import Make
from .model import HOSTILE, model
from .readers import content, with_strings
from .test_targets import FOR_PEOPLE, ROS2, VARIANTS, Variant, differences, name_of

TEXT_OPTIONS = [
    (target, name)
    for target in registry.BUILT_IN
    for name, option in options_of(registry.load(target)).items()
    if option.type is str and not option.choices
]
# Options that are any text on one line, and what is before it.
FREE = {"license": "", "maintainer": "", "copyright": "2026 ", "ros": "", "workspace": ""}


def test_world_files(checked: Callable[..., System]) -> None:
    """In a launch file `$(` begins a substitution, and a file has a name of one line."""
    for text in HOSTILE:
        source = model([text], "x", worlds=True)
        report = Diagnostics()
        output = emit(checked(source), [Request("smach", {"simulation": "true"})], report)
        # Messages do not take all of them as constants.
        found = [each for each in report if each.name != "unsupported-construct"]
        name = text.rpartition("/")[2]
        safe = name.isprintable() and not set("\\:") & set(name) and "$(" not in name
        if safe:
            assert found == []
            continue
        (fault,) = found
        assert (fault.name, fault.primary is not None) == ("bad-identifier", True)
        place = fault.primary.span
        assert place.source.line_text(place.line).endswith("// world 0"), fault
        assert quoted(text) in place.source.line_text(place.line)
        assert not output or all("\n" not in file.path for file in output["smach"])


@pytest.mark.parametrize("text", HOSTILE)
def test_names_of_topics(text: str, tmp_path: Path) -> None:
    if text in ("true", "null"):
        return  # names like any other
    written = f"event E : std_msgs/Empty on {quoted(text)}"
    (tmp_path / "model.swarm").write_text(f"package p\n{written}\n", encoding="utf-8")
    (fault,) = pipeline.check([tmp_path / "model.swarm"]).report
    assert fault.name == "bad-topic"
    assert fault.primary is not None
    assert fault.primary.span.text == quoted(text)


@pytest.mark.parametrize(
    ("target", "options"),
    [("smach", {}), ("ros2", {}), ("skeleton", {"ros": "1"}), ("skeleton", {"ros": "2"})],
)
def test_names_that_yaml_takes_for_truth_values(
    target: str, options: dict[str, str], make: Make
) -> None:
    names = ("yes", "No", "OFF", "null", "y")
    params = "".join(f"param {name} : int32 = 1\n" for name in names)
    values = "".join(f"{name} = 2\n" for name in names)
    text = f"""package p
sensor Eye {{ {params} out seen : std_msgs/Empty }}
endless statemachine Work {{ {params} initial A
state A {{ after 1 s [{" + ".join(names)} > 5] -> A }} }}
member Bot {{ behavior Work\n{params.replace("1", "2")} no : Eye {{ {values} }} }}
swarm Team {{ bot : Bot }}
"""
    files = make(text, target, options).files
    read = [yaml.safe_load(each) for path, each in files.items() if path.endswith(".yaml")]
    keys = [set(each) for given in filter(None, read) for each in tables(given)]
    assert set(names) in keys
    assert all(isinstance(key, str) for each in keys for key in each)


def tables(value: object) -> Iterator[dict[object, object]]:
    if isinstance(value, dict):
        yield value
        for each in value.values():
            yield from tables(each)


@pytest.mark.parametrize(("target", "name"), TEXT_OPTIONS)
def test_options(target: str, name: str, checked: Callable[..., System]) -> None:
    system = checked(model([], "x"))
    before = FREE.get(name, "")
    given = {"ros": "2"} if (target, name) == ("smach", "copyright") else {}

    def files(value: str) -> dict[str, str] | None:
        report = Diagnostics()
        output = emit(system, [Request(target, {**given, name: before + value})], report)
        if report.has_errors:
            return None
        return {file.path: file.text for file in output[target]}

    taken = [text for text in HOSTILE if (made := files(text)) is not None and made]
    if name not in FREE:
        assert set(taken) <= {"true", "null", "1e3", "2026-11-23", "0x10", "", "   "}
        return
    text = " ".join(taken)
    plain, made = files("PLAIN"), files(text)
    assert plain is not None
    assert made is not None
    for path in made:
        if made[path] != plain[path] and not FOR_PEOPLE.search(path):
            expected = with_strings(
                content(path, plain[path]), lambda each: each.replace("PLAIN", text)
            )
            assert list(differences(expected, content(path, made[path]))) == [], path


# Lines end in it, and Python would take it for the name of an encoding.
FILE = """*a"b--coding=utf-7 ?? $(eval 1) {{ x }}''' \n\r\x85\u2028c\x7f\x9f\\"""


@pytest.mark.parametrize("variant", VARIANTS, ids=name_of)
def test_names_of_model_files(variant: Variant, make: Make) -> None:
    target, options = variant
    ros = 2 if name_of(variant) in ROS2 else 1
    plain = make(model([], "x"), target, options, "PLAIN.swarm").files
    made = make(model([], "x"), target, options, f"{FILE}.swarm").files
    assert made.keys() == plain.keys()
    for path, text in made.items():
        if text != plain[path] and not FOR_PEOPLE.search(path):
            # Parts of code refer to lines of the model.
            expected = with_strings(content(path, plain[path], ros), without_place)
            found = with_strings(content(path, text, ros), without_place)
            assert list(differences(expected, found)) == [], path


def without_place(text: str) -> str:
    name, _, line = text.rpartition(":")
    return line if name.endswith(".swarm") else text
