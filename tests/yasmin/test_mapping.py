"""The table that `swarmc targets yasmin` prints says what the generator does."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from swarmdsl.codes import CODES
from swarmdsl.generator import Support
from swarmdsl.plugins import load

from ..smach.test_mapping import BOX, HEADER
from ..smach.test_mapping import MODELS as SAME

OWN = {
    "transition into a state": f"""
        state A {{ on Go -> Box.Deep  on Stop -> Box }}
        state Box {{ initial In {BOX} on Stop -> End }}""",
    "goal or request": SAME["goal or request of values"],
    "callback": SAME["callback for a result or response"],
    "transition from deep inside to a deep history around": """
        state A {
          initial Box
          state Box { initial In state In { on Go -> Deep } state Deep { on Go -> A.H } }
          deep history H -> Box
          on Stop -> End
        }""",
    "state called `canceled`": "state A { on Go -> canceled } state canceled { on Go -> End }",
}
MODELS = {each.construct: {**SAME, **OWN}[each.construct] for each in load("yasmin").mapping}


@pytest.mark.parametrize("number", range(len(MODELS)), ids=list(MODELS))
def test_the_table_is_true(
    number: int,
    generate: Callable[..., dict[str, str]],
    reported: Callable[..., list[tuple[str, str, str]]],
) -> None:
    mapped = load("yasmin").mapping[number]
    body = MODELS[mapped.construct]
    end = "" if body == "final A" else "final End"
    model = f"{HEADER}statemachine Work {{ initial A {body} {end} }}"
    if mapped.support is Support.REJECTED:
        (code,) = re.findall(r"\((SW\d{4})\)", mapped.means)
        assert [CODES[name].code for name, _, _ in reported(model)] == [code]
        assert all("target `yasmin`" in message for _, message, _ in reported(model))
        return
    files = generate(model)
    texts = [files[f"lab_behavior/{name}.py"] for name in ("work_fsm", "work")]
    # Without what is imported, and in one line.
    built = " ".join(" ".join(t.partition("\n\n\n")[2] or t for t in texts).split())
    built += " ".join(texts[0].split())
    for word in re.findall("`([^`]*)`", mapped.means):
        assert word in built, word
