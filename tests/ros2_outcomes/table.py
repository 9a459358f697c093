"""The table that `swarmc targets` prints of a library says what the generator does."""

from __future__ import annotations

import re
from collections.abc import Callable

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.codegen.api import Mapped, Support

from ..smach.test_mapping import BOX, CONTRACTED, CONTRACTS, FOR_ROS_2, HEADER, PARTS, WATCHING

_ONE_ROW_HERE = (
    *("constant goal or request", "goal or request of values"),
    *("callback for a goal or request", "callback for a result or response"),
)
MODELS = {
    **{construct: body for construct, body in FOR_ROS_2.items() if construct not in _ONE_ROW_HERE},
    "transition into a state": f"""
        state A {{ on Go -> Box.Deep; on Stop -> Box }}
        state Box {{ initial In; {BOX} on Stop -> End }}""",
    "goal or request": FOR_ROS_2["goal or request of values"],
    "callback": FOR_ROS_2["callback for a result or response"],
    "transition from deep inside to a deep history around": """
        state A {
          initial Box
          state Box { initial In; state In { on Go -> Deep } state Deep { on Go -> A.H } }
          deep history H -> Box
          on Stop -> End
        }""",
}
Generate = Callable[..., dict[str, str]]
Reported = Callable[..., list[tuple[str, str, str]]]


def check_row(
    mapped: Mapped, body: str, target: str, suffix: str, generate: Generate, reported: Reported
) -> None:
    """Check what a row says of a machine with this body."""
    end = "" if body == "final A" else "final End"
    model = f"{HEADER}statemachine Work {{ initial A; {body} {end} }}"
    if mapped.construct in CONTRACTS:
        path, options = WATCHING[mapped.construct]
        (word,) = re.findall("`([^`]*)`", mapped.means)
        assert word in generate(model + CONTRACTED(CONTRACTS[mapped.construct]), **options)[path]
        return
    if mapped.construct == "connector":
        assert "remappings=" in generate(model + PARTS)["launch/uavs.launch.py"]
        return
    if mapped.support is Support.REJECTED:
        (code,) = re.findall(r"\((SW\d{4})\)", mapped.means)
        assert [CODES[name].code for name, _, _ in reported(model)] == [code]
        assert all(f"target `{target}`" in message for _, message, _ in reported(model))
        return
    files = generate(model)
    texts = [files[f"lab_behavior/{name}.py"] for name in (f"work{suffix}", "work")]
    # Without what is imported, and in one line.
    built = " ".join(" ".join(t.partition("\n\n\n")[2] or t for t in texts).split())
    built += " ".join(texts[0].split())
    for word in re.findall("`([^`]*)`", mapped.means):
        assert word in built, word
