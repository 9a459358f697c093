"""The table that `swarmc targets smach` prints for ROS 2 says what the generator does."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from swarmdsl.codes import CODES
from swarmdsl.generator import Support
from swarmdsl.plugins import load

from ...yasmin.test_mapping import OWN as OF_LIBRARIES
from ..test_mapping import HEADER, PARTS
from ..test_mapping import MODELS as SAME

OWN = {
    "name that userdata cannot have": """
        var keys : int32
        state A { on Go [keys > 1] -> End  on Stop / keys = 2 }""",
}
TABLE = load("smach").mapping_with["ros=2"]
MODELS = {each.construct: {**SAME, **OF_LIBRARIES, **OWN}[each.construct] for each in TABLE}


@pytest.mark.parametrize("number", range(len(MODELS)), ids=list(MODELS))
def test_the_table_is_true(
    number: int,
    generate: Callable[..., dict[str, str]],
    reported: Callable[..., list[tuple[str, str, str]]],
) -> None:
    mapped = TABLE[number]
    body = MODELS[mapped.construct]
    end = "" if body == "final A" else "final End"
    model = f"{HEADER}statemachine Work {{ initial A {body} {end} }}"
    if mapped.construct == "connector":
        assert "remappings=" in generate(model + PARTS)["launch/uavs.launch.py"]
        return
    if mapped.support is Support.REJECTED:
        (code,) = re.findall(r"\((SW\d{4})\)", mapped.means)
        assert [CODES[name].code for name, _, _ in reported(model)] == [code]
        assert all("target `smach`" in message for _, message, _ in reported(model))
        return
    files = generate(model)
    texts = [files[f"lab_behavior/{name}.py"] for name in ("work_smach", "work")]
    # Without what is imported, and in one line.
    built = " ".join(" ".join(t.partition("\n\n")[2] or t for t in texts).split())
    for word in re.findall("`([^`]*)`", mapped.means):
        assert word in built, word
