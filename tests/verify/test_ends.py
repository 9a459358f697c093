"""Proofs about how functions end: in each state that calls them, and in parts of robots."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.search.run import written
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

MODEL = """
package ends

function lift : abstraction { action "lift" : Lift }
action Lift { result { high : bool } }

endless statemachine Lifting {
  initial Wait
  state Wait { after 1 s -> Lift }
  state Lift {
    do lift
    on succeeded -> Lift
    on aborted -> Wait
    on preempted
    after 5 s -> Wait
  }
}
member Arm { behavior Lifting }
swarm Arms { arm : Arm[2] }
"""
HOLDING = (
    "each arm : never ends lift as aborted and in Lift",
    "each arm : never ends lift as succeeded and in Wait",
    "each arm : never ends lift and cancels lift",
    "some arm ends lift as preempted only after some arm starts lift",
    "each arm : starts lift leads to ends lift or cancels lift",
    "each arm : after ends lift as preempted until in Wait, ends lift at most 1 times",
)
FAILING = (
    "each arm : never ends lift and in Lift",
    "each arm : never ends lift as preempted",
    "never arm[1] ends lift as succeeded",
    "each arm : ends lift as succeeded leads to ends lift as aborted",
    "each arm : ends lift as aborted leads to ends lift as succeeded",
)

# The same function in two states of a composite one with a history, and in a submachine.
STATES = """
package ends

function lift : abstraction { action "lift" : Lift }
action Lift { result { high : bool } }
event Go   : std_msgs/Empty
event Stop : std_msgs/Empty

statemachine Raising {
  initial Raise
  state Raise {
    do lift
    on succeeded -> High
    on aborted -> Raise
  }
  final High
}

endless statemachine Working {
  initial Job
  state Job {
    initial First
    state First {
      defer Go
      do lift
      on succeeded -> Second
      on aborted -> First
    }
    state Second {
      do lift
      on succeeded, aborted -> First
      on Go -> Sub
    }
    history Back
    on Stop -> Pause
  }
  state Pause { on Go -> Job.Back }
  state Sub = Raising {
    on done -> Job
    on Stop -> Pause
  }
}
member Arm { behavior Working }
swarm Arms { arm : Arm }
"""
HOLDING_IN_STATES = (
    "each arm : never ends lift as aborted and (in Second or in Pause)",
    "each arm : never ends lift and in Pause",
    "each arm : after in Pause until starts lift, ends lift at most 0 times",
    "each arm : starts lift leads to ends lift or cancels lift",
    "each arm : never ends lift and cancels lift",
    # A deferred event is recalled at a moment of its own.
    "each arm : never ends lift and hears Go",
    "each arm : never ends lift as succeeded and in Sub",
)
FAILING_IN_STATES = (
    "each arm : never ends lift as succeeded and in First",
    "each arm : never ends lift as succeeded and in Second",
    "each arm : never ends lift as aborted and in Sub",
    "each arm : after in Sub, ends lift at most 1 times",
    "each arm : starts lift leads to ends lift as succeeded",
)
# Two functions at a time, and a part of the robot that calls one of them, too.
REGIONS = """
package ends

function lift : abstraction { action "lift" : Lift }
function look : abstraction { service "look" : std_srvs/Trigger }
action Lift { result { high : bool } }

statemachine Winding {
  initial Wind
  state Wind {
    do lift
    on succeeded -> Wound
    on aborted -> Wind
  }
  final Wound
}
controller Winch { behavior Winding }

endless statemachine Working {
  initial Both
  parallel state Both {
    region Left {
      initial Up
      state Up {
        do lift
        on succeeded -> Held
        on aborted -> Up
      }
      state Held { after 2 s -> Up }
    }
    region Right {
      initial Look
      state Look {
        do look
        on succeeded -> Look
        on aborted -> Rest
      }
    }
  }
  state Rest { after 5 s -> Both }
}
member Arm {
  behavior Working
  @PART@
}
swarm Arms { arm : Arm }
"""
HOLDING_IN_REGIONS = (
    "each arm : never ends look as succeeded and (cancels lift or in Rest)",
    "each arm : never ends look as aborted and not in Rest",
    "each arm : never ends look and ends lift",
    "each arm : in Rest only after ends look as aborted",
)
FAILING_IN_REGIONS = (
    "each arm : never ends look as aborted and cancels lift",
    "each arm : never ends look as succeeded and in Held",
    "each arm : never ends lift as aborted",
)
OF_A_PART = (
    # Without a part, `lift` is cancelled in `Rest`, and its success ends `Up`.
    "each arm : never ends lift and in Rest",
    "each arm : never ends lift as succeeded and in Up",
)
CASES = {
    "states": (STATES, HOLDING_IN_STATES, FAILING_IN_STATES),
    "simple": (MODEL, HOLDING, FAILING),
    "regions": (
        *(REGIONS.replace("@PART@", ""), (*HOLDING_IN_REGIONS, *OF_A_PART), FAILING_IN_REGIONS),
    ),
    "parts": (
        REGIONS.replace("@PART@", "winch : Winch"),
        HOLDING_IN_REGIONS,
        (*FAILING_IN_REGIONS, *OF_A_PART),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_how_functions_end(
    name: str,
    modelled: Callable[..., Model],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    text, holding, failing = CASES[name]
    model = modelled(text + _properties((*holding, *failing)))
    verdicts = verdicts_of(model)

    outcomes = [each.outcome for each in verdicts.values()]

    assert outcomes == ["holds"] * len(holding) + ["fails"] * len(failing)
    # Its run violates a property in a replay, too.
    for number, sentence in enumerate(failing, start=len(holding)):
        verdict, trace = verdicts[f"P{number}"], tmp_path / "run.jsonl"
        assert verdict.run is not None
        trace.write_text("".join(f"{line}\n" for line in written(verdict.run)), encoding="utf-8")
        model_file = str(tmp_path / "model.swarm")
        run(["simulate", model_file, "--replay", str(trace), "--property", f"P{number}"])
        told = capsys.readouterr().err
        assert "as in the model" in told, sentence
        assert f"property `P{number}` is violated" in told, sentence


def _properties(sentences: Sequence[str]) -> str:
    return "".join(f"property P{n} of Arms : {each}\n" for n, each in enumerate(sentences))
