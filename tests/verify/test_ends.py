"""Proofs about how functions end, in words and with nothing but their ends."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.verify.model import Model

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


def test_how_functions_end(modelled: Callable[..., Model]) -> None:
    sentences = enumerate((*HOLDING, *FAILING))
    model = modelled(MODEL + "".join(f"property P{n} of Arms : {each}\n" for n, each in sentences))

    outcomes = [each.outcome for each in verdicts_of(model).values()]

    assert outcomes == ["holds"] * len(HOLDING) + ["fails"] * len(FAILING)
