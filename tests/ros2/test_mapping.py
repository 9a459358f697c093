"""The table that `swarmc targets ros2` prints says what the generator does."""

import importlib.util
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.codegen.api import OutputFile, Support
from swarmdsl.codegen.registry import load


def _constructs() -> ModuleType:
    """The models that the table of target `smach` is tested with: a model for each construct."""
    path = Path(__file__).parents[1] / "smach" / "test_mapping.py"
    spec = importlib.util.spec_from_file_location("smach_mapping", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_OF_SMACH = _constructs()
HEADER, PARTS, MODELS = _OF_SMACH.HEADER, _OF_SMACH.PARTS, _OF_SMACH.FOR_ROS_2


def test_every_construct_has_a_model() -> None:
    assert [each.construct for each in load("ros2").mapping] == list(MODELS)


@pytest.mark.parametrize("number", range(len(MODELS)), ids=list(MODELS))
def test_the_table_is_true(
    number: int,
    generate: Callable[..., dict[str, OutputFile]],
    reported: Callable[..., list[tuple[str, str, str]]],
) -> None:
    mapped = load("ros2").mapping[number]
    body = MODELS[mapped.construct]
    end = "" if body == "final A" else "final End"
    model = f"{HEADER}statemachine Work {{ initial A; {body} {end} }}"
    if mapped.construct in _OF_SMACH.CONTRACTS:
        contracted = model + _OF_SMACH.CONTRACTED(_OF_SMACH.CONTRACTS[mapped.construct])
        path, options = _OF_SMACH.WATCHING[mapped.construct]
        (word,) = re.findall("`([^`]*)`", mapped.means)
        assert word in generate(contracted, **options)[f"lab_behavior/{path}"].text
        return
    if mapped.construct == "connector":
        (word,) = re.findall("`([^`]*)`", mapped.means)
        assert word in generate(model + PARTS)["lab_behavior/launch/uavs.launch.py"].text
        return
    if mapped.support is Support.REJECTED:
        (code,) = re.findall(r"\((SW\d{4})\)", mapped.means)
        assert [CODES[name].code for name, _, _ in reported(model)] == [code]
        return
    (text,) = [
        file.text for path, file in generate(model).items() if path.endswith("behavior/work.py")
    ]
    # Without what is imported, and in one line.
    built = " ".join(text[text.index("class Data") :].split())
    words = re.findall("`([^`]*)`", mapped.means)
    assert words
    for word in words:
        assert word in built, word
