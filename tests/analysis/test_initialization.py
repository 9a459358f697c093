"""Reads of variables without an initial value: paths with and without a write."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MODEL = """
event Go   : std_msgs/Empty
event Seen : std_msgs/Int32

service Ask {{
  request {{ n : int32 }}
  response {{ n : int32 }}
}}

function ask : abstraction {{ service "ask" : Ask }}

statemachine M {{
  var v : int32
{states}
  final Done
}}
"""

# Reads `v`, and leaves.
READ = "state Read { on Go / send Seen(data = v) -> Done }"


def codes(states: str, folder: Path) -> list[str]:
    path = folder / "model.swarm"
    path.write_text(MODEL.format(states=states), encoding="utf-8")
    return [found.code for found in pipeline.check([path]).report]


WRITTEN = {
    "on every way": f"""
  initial A
  state A {{
    on Go   / v = 1          -> Read
    on Seen / v = event.data -> Read
  }}
  {READ}""",
    "on entry of a state around": f"""
  initial Around
  state Around {{
    entry / v = 1
    initial Read
    {READ}
  }}""",
    "on entry of a state around that is jumped into": f"""
  initial A
  state A {{ on Go -> Around.Read }}
  state Around {{
    entry / v = 1
    initial Other
    state Other {{ on Go -> Read }}
    {READ}
  }}""",
    "on exit of the state before": f"""
  initial A
  state A {{
    exit / v = 1
    on Go -> Read
  }}
  {READ}""",
    "on exit of a state around": f"""
  initial Around
  state Around {{
    exit / v = 1
    initial Inner
    state Inner {{ on Go -> Read }}
  }}
  {READ}""",
    "before the regions are entered": f"""
  initial A
  state A {{ on Go / v = 1 -> Both }}
  parallel state Both {{
    region One {{ initial Read; {READ} }}
    region Two {{ initial Rest; state Rest }}
  }}""",
    "by the region that ends last or first": f"""
  initial Both
  parallel state Both {{
    region One {{ initial X; state X {{ on Go / v = 1 -> Over }} final Over }}
    region Two {{ initial Y; state Y {{ on Go -> End }} final End }}
    on done -> Read
  }}
  {READ}""",
    "by an activity that has succeeded": f"""
  initial A
  state A {{
    do ask(n = 1) gives (n => v)
    on succeeded -> Read
    on aborted   -> Done
  }}
  {READ}""",
    "by a choice": f"""
  param k : int32 = 0
  initial A
  state A {{ on Seen -> Fork }}
  choice Fork {{
    [k > 1] / v = 1 -> Read
    else    / v = 2 -> Read
  }}
  {READ}""",
    "before the state is left at once": """
  initial Around
  state Around {
    initial First
    state First { on done / v = 1 -> Second }
    state Second { after 3 s -> Done }
    on Go / send Seen(data = v) -> Done
  }""",
    "counted on from zero": f"""
  initial A
  state A {{ on Go / v = v + 1 -> Read }}
  {READ}""",
    "and kept by a history": f"""
  initial Around
  state Around {{
    initial First
    state First {{ on Go / v = 1 -> Read }}
    {READ}
    history Back -> First
    on Seen -> Away
  }}
  state Away {{ on Go -> Around.Back }}""",
    "in the state with the other final": f"""
  initial Around
  state Around {{
    initial X
    state X {{
      on Go / v = 1 -> Good
      on Seen       -> Bad
    }}
    final Good
    final Bad
    on done.Good -> Read
    on done      -> Done
  }}
  {READ}""",
}

UNWRITTEN = {
    "by a transition of the state around": f"""
  initial Around
  state Around {{
    initial X
    state X {{ on Go / v = 1 -> Y }}
    state Y {{ on Go -> Done }}
    after 3 s -> Read
  }}
  {READ}""",
    "when the activity failed": f"""
  initial A
  state A {{
    do ask(n = 1) gives (n => v)
    on succeeded, aborted -> Read
  }}
  {READ}""",
    "from one region, whatever the other does": f"""
  initial Both
  parallel state Both {{
    region One {{ initial X; state X {{ on Go / v = 1 }} }}
    region Two {{ initial Read; {READ} }}
  }}""",
    "in a goal": """
  initial A
  state A {
    do ask(n = v) gives (n => v)
    on succeeded, aborted -> Done
  }""",
    "in a guard": """
  initial A
  state A {
    on Go [v > 1] -> Done
    on Go / v = 1
  }""",
    "in an effect on exit, when the state around is left": """
  initial Around
  state Around {
    initial X
    state X {
      exit / send Seen(data = v)
      on Go / v = 1
    }
    on Seen -> Done
  }""",
    "by the other branch": f"""
  param k : int32 = 0
  initial A
  state A {{ on Go -> Fork }}
  choice Fork {{
    [k > 1] / v = 1 -> Read
    else            -> Read
  }}
  {READ}""",
    "when all regions have ended": f"""
  initial Both
  parallel state Both {{
    region One {{
      initial X
      state X {{
        on Go / v = 1 -> Over
        on Seen       -> Over
      }}
      final Over
    }}
    region Two {{ initial Y; state Y {{ on Go -> End }} final End }}
    on done -> Read
  }}
  {READ}""",
}


@pytest.mark.parametrize("way", WRITTEN)
def test_written_before(way: str, tmp_path: Path) -> None:
    assert codes(WRITTEN[way], tmp_path) == []


@pytest.mark.parametrize("way", UNWRITTEN)
def test_read_unwritten(way: str, tmp_path: Path) -> None:
    assert codes(UNWRITTEN[way], tmp_path) == ["SW0525"]
