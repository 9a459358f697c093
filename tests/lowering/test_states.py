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


def test_a_variable_of_a_state_starts_when_the_state_is_entered(
    compiled: Callable[[str], ir.System],
) -> None:
    system = compiled("""
        event At : geometry_msgs/Point
        statemachine Inner {
          initial A
          state A { var n : int32 = 1; after 1 s / n = n + 1 -> Z }
          final Z
        }
        endless statemachine M {
          var a_n : int32 = 0
          initial A
          state A {
            var n : int32
            var place : geometry_msgs/Point
            on At [n == a_n and place.x == 0] / place = event, n = 3, a_n = 4 -> P
          }
          parallel state P {
            var all : string = "x"
            region R { var here : bool; initial X; state X { after 1 s [here] / all = all -> X } }
          }
          state B = Inner
        }
    """)
    machine = system.machines_by_name["M"]
    states = {state.id: state for state in machine.walk()}

    def first(state: str) -> list[tuple[str, object]]:
        return [
            (each.variable, getattr(each.value, "value", None) or each.value)
            for each in states[state].entry
            if isinstance(each, ir.Assignment)
        ]

    assert [variable.name for variable in machine.variables] == [
        *("a_n", "a_n_", "a_place", "p_all", "p_r_here", "a_place_blank", "b_a_n"),
    ]
    (number, zero), (place, blank) = first("A")
    assert (number, zero) == ("a_n_", ir.Literal(0, ir.Primitive("int32")))
    assert (place, isinstance(blank, ir.VariableRef) and blank.name) == ("a_place", "a_place_blank")
    assert [name for name, _ in first("P")] == ["p_all", "p_r_here"]
    assert first("B.A") == [("b_a_n", 1)]
    (transition,) = states["A"].transitions
    assert [each.variable for each in transition.effects if isinstance(each, ir.Assignment)] == [
        *("a_place", "a_n_", "a_n"),
    ]
