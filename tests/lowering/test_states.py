"""Lowering of what a state machine leaves out: defaults of histories, names of topics."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl import ir


def test_a_history_without_a_target_leads_to_the_initial_state(
    compiled: Callable[[str], ir.System],
) -> None:
    (machine,) = compiled("""
        endless statemachine M {
          initial A
          state A {
            history Last; deep history All; history Other -> C
            state C
            state B
            initial B
            after 1 s -> Last; after 2 s -> All; after 3 s -> Other
          }
        }
    """).machines
    defaults = {
        state.name: [each.target for each in state.transitions]
        for state in machine.walk()
        if state.kind is ir.StateKind.HISTORY
    }

    assert defaults == {"Last": ["A.B"], "All": ["A.B"], "Other": ["A.C"]}


def test_a_monitored_topic_has_the_name_that_one_monitor_chooses(
    compiled: Callable[[str], ir.System],
) -> None:
    system = compiled("""
        endless statemachine M {
          initial A
          state A {
            monitor "camera/image" : std_msgs/Empty             -> B
            monitor "charge"       : std_msgs/Empty             -> B
            monitor "battery"      : std_msgs/Empty as Charge   -> B
          }
          state B { monitor "camera/image" : std_msgs/Empty as Image -> A }
        }
    """)

    assert [(event.name, event.topic) for event in system.events] == [
        ("Image", "camera/image"),
        ("Charge_", "charge"),
        ("Charge", "battery"),
    ]


def test_an_outcome_alone_is_handled_by_staying(compiled: Callable[[str], ir.System]) -> None:
    (machine,) = compiled("""
        function go : abstraction { action "go" : my_msgs/Go }
        endless statemachine M {
          var ready : bool = false
          initial A
          state A {
            do go
            on succeeded, aborted;
            [ready] -> B
          }
          state B { after 1 s / ready = true -> A }
        }
    """).machines
    stays, leaves = machine.states[0].transitions

    assert [trigger.outcome for trigger in stays.triggers] == ["succeeded", "aborted"]
    assert (stays.guard, stays.effects, stays.target) == (None, (), None)
    assert leaves.target == "B"
