"""The engine follows SCXML 1.0, Appendix D: a test for each rule of it."""

from __future__ import annotations

import re

import pytest

from swarmdsl.execution.engine import (
    Event,
    ExecutionError,
    Guard,
    Instance,
    Kind,
    LoopError,
    Machine,
    State,
    TableError,
    Transition,
)

from .world import StillWorld, Trace, after, note, on, started


def noisy(name: str, *states: State, **rest: object) -> State:
    """A state whose entry and exit are noted."""
    return State(
        name,
        states=states,
        entry=(note(f"+{name}"),),
        exit=(note(f"-{name}"),),
        **rest,  # type: ignore[arg-type]
    )


def region(name: str, *states: State) -> State:
    return State(name, states=states)


def two_regions(*on_whole: Transition, left: State, right: State) -> Machine:
    whole = State("P", Kind.PARALLEL, (left, right), transitions=on_whole)
    return Machine("m", (whole, State("out")))


# ---- selectTransitions


def test_the_first_transition_in_document_order_is_taken() -> None:
    machine = Machine(
        "m", (State("a", transitions=(on("e", "b"), on("e", "c"))), *map(State, "bc"))
    )

    assert after(started(machine), "e") == ["b"]


def test_a_guard_that_does_not_hold_lets_the_next_one_through() -> None:
    no = on("e", "b", guard=lambda instance, event: False)
    machine = Machine("m", (State("a", transitions=(no, on("e", "c"))), *map(State, "bc")))

    assert after(started(machine), "e") == ["c"]


def test_an_inner_transition_comes_before_an_outer_one() -> None:
    inner = State("inner", transitions=(on("e", "b"),))
    machine = Machine(
        "m", (State("a", states=(inner,), transitions=(on("e", "c"),)), *map(State, "bc"))
    )

    assert after(started(machine), "e") == ["b"]


def test_an_outer_transition_is_taken_where_the_inner_guards_fail() -> None:
    inner = State("inner", transitions=(on("e", "b", guard=lambda i, e: e.data),))
    machine = Machine(
        "m", (State("a", states=(inner,), transitions=(on("e", "c"),)), *map(State, "bc"))
    )

    assert after(started(machine), "e") == ["c"]


def test_guards_see_the_event() -> None:
    wanted = on("e", "b", guard=lambda instance, event: event.data > 3)
    instance = started(Machine("m", (State("a", transitions=(wanted,)), State("b"))))

    instance.receive(Event("e", 3))
    assert instance.configuration.ids == ["a"]
    instance.receive(Event("e", 4))
    assert instance.configuration.ids == ["b"]


def test_an_event_without_a_transition_is_lost() -> None:
    machine = Machine(
        "m", (State("a", transitions=(on("e", "b"),)), State("b", transitions=(on("f", "a"),)))
    )

    assert after(started(machine), "f", "unknown", "e") == ["b"]


@pytest.mark.parametrize(
    ("pattern", "name", "fits"),
    [
        ("a.b", "a.b", True),
        ("a.b", "a.b.c", False),
        ("a.b.*", "a.b", True),
        ("a.b.*", "a.b.c.d", True),
        ("a.b.*", "a.bc", False),
        ("a.b.*", "a", False),
        ("*", "anything.at.all", True),
        ("x a.*", "a.b", True),
    ],
)
def test_names_of_events(pattern: str, name: str, fits: bool) -> None:
    machine = Machine("m", (State("a", transitions=(on(pattern, "b"),)), State("b")))

    assert after(started(machine), name) == (["b"] if fits else ["a"])


def test_a_star_is_no_eventless_transition() -> None:
    machine = Machine("m", (State("a", transitions=(on("*", "b"),)), State("b")))

    assert started(machine).configuration.ids == ["a"]


# ---- removeConflictingTransitions


def test_regions_that_agree_both_move() -> None:
    left = region("L", State("l1", transitions=(on("e", "l2"),)), State("l2"))
    right = region("R", State("r1", transitions=(on("e", "r2"),)), State("r2"))

    assert after(started(two_regions(left=left, right=right)), "e") == ["l2", "r2"]


def test_of_two_regions_that_lead_out_the_first_one_decides() -> None:
    left = region("L", State("l1", transitions=(on("e", "l2"),)), State("l2"))
    right = region("R", State("r1", transitions=(on("e", "out"),)))
    whole = State("P", Kind.PARALLEL, (left, right))

    assert after(started(Machine("m", (whole, State("out")))), "e") == ["l2", "r1"]
    whole = State("P", Kind.PARALLEL, (right, left))
    assert after(started(Machine("m", (whole, State("out")))), "e") == ["out"]


def test_a_deeper_region_does_not_win_over_an_earlier_one() -> None:
    left = region("L", State("l1", transitions=(on("e", "out"),)))
    deep = State("r1", states=(State("r2", transitions=(on("e", "r3"),)), State("r3")))

    assert after(started(two_regions(left=left, right=region("R", deep))), "e") == ["out"]


def test_a_transition_inside_wins_over_one_of_the_state_around_from_another_region() -> None:
    # The left region has none of its own, so that of the whole is enabled there, and first.
    left = region("L", State("l1"))
    right = region("R", State("r1", transitions=(on("e", "r2"),)), State("r2"))

    instance = started(two_regions(on("e", "out"), left=left, right=right))
    assert after(instance, "e") == ["l1", "r2"]
    assert after(instance, "e") == ["out"]


@pytest.mark.parametrize("guard", [None, lambda instance, event: True])
def test_one_transition_of_the_state_around_is_taken_once(guard: Guard | None) -> None:
    whole = on("e", effect=note("once"), guard=guard)
    instance = started(
        two_regions(whole, left=region("L", State("l")), right=region("R", State("r")))
    )

    after(instance, "e")
    assert instance.data["notes"] == ["once"]


def test_a_transition_without_a_target_is_in_nobodys_way() -> None:
    left = region("L", State("l1", transitions=(on("e", effect=note("l")),)))
    right = region("R", State("r1", transitions=(on("e", "out"),)))
    instance = started(two_regions(left=left, right=right))

    assert after(instance, "e") == ["out"]
    assert instance.data["notes"] == ["l"]


# ---- exit, effect, entry


def test_the_order_of_effects() -> None:
    a = noisy("a", noisy("a1", transitions=(on("e", "b2", effect=note("e")),)))
    machine = Machine("m", (a, noisy("b", noisy("b1"), noisy("b2", noisy("b21")))))
    instance = started(machine)
    assert instance.data.pop("notes") == ["+a", "+a1"]

    after(instance, "e")
    assert instance.data["notes"] == ["-a1", "-a", "e", "+b", "+b2", "+b21"]


def test_regions_are_entered_in_document_order_and_left_in_reverse() -> None:
    whole = State(
        "P",
        Kind.PARALLEL,
        (noisy("L", noisy("l")), noisy("R", noisy("r"))),
        transitions=(on("e", "out"),),
    )
    instance = started(Machine("m", (whole, State("out"))))

    after(instance, "e")
    assert instance.data["notes"] == ["+L", "+l", "+R", "+r", "-r", "-R", "-l", "-L"]


def test_the_effects_of_both_regions_come_after_all_exits() -> None:
    left = region("L", noisy("l1", transitions=(on("e", "l2", effect=note("el")),)), noisy("l2"))
    right = region("R", noisy("r1", transitions=(on("e", "r2", effect=note("er")),)), noisy("r2"))
    instance = started(two_regions(left=left, right=right))
    instance.data.clear()

    after(instance, "e")
    assert instance.data["notes"] == ["-r1", "-l1", "el", "er", "+l2", "+r2"]


def test_a_transition_to_itself_leaves_and_enters() -> None:
    instance = started(Machine("m", (noisy("a", transitions=(on("e", "a"),)),)))

    after(instance, "e")
    assert instance.data["notes"] == ["+a", "-a", "+a"]


def test_an_external_transition_into_a_state_leaves_it() -> None:
    a = noisy("a", noisy("a1"), noisy("a2"), transitions=(on("e", "a2"),))
    instance = started(Machine("m", (a,)))
    instance.data.clear()

    assert after(instance, "e") == ["a2"]
    assert instance.data["notes"] == ["-a1", "-a", "+a", "+a2"]


def test_an_internal_transition_does_not_leave_its_state() -> None:
    a = noisy("a", noisy("a1"), noisy("a2"), transitions=(on("e", "a2", internal=True),))
    instance = started(Machine("m", (a,)))
    instance.data.clear()

    assert after(instance, "e") == ["a2"]
    assert instance.data["notes"] == ["-a1", "+a2"]


def test_an_internal_transition_that_leads_out_is_external() -> None:
    a = noisy("a", noisy("a1"), transitions=(on("e", "b", internal=True),))

    assert after(started(Machine("m", (a, State("b")))), "e") == ["b"]


def test_an_internal_transition_of_a_parallel_state_is_external() -> None:
    """It has no domain of its own: SCXML 3.13 has internal ones of compound states only."""
    left, right = noisy("L", noisy("l1"), noisy("l2")), noisy("R", noisy("r1"), noisy("r2"))
    machine = two_regions(on("e", "l2", internal=True), left=left, right=right)
    instance = started(machine)
    after(instance)
    instance.data.clear()

    assert after(instance, "e") == ["l2", "r1"]
    assert instance.data["notes"] == ["-r1", "-R", "-l1", "-L", "+L", "+l2", "+R", "+r1"]


def test_a_transition_between_levels_stays_in_the_least_compound_ancestor() -> None:
    inner = noisy("x", noisy("x1", transitions=(on("e", "y1"),)))
    around = noisy("c", inner, noisy("y", noisy("y0"), noisy("y1")))
    instance = started(Machine("m", (noisy("top", around),)))
    instance.data.clear()

    assert after(instance, "e") == ["y1"]
    assert instance.data["notes"] == ["-x1", "-x", "+y", "+y1"]


def test_a_region_that_leads_to_itself_leaves_the_whole_parallel_state() -> None:
    """The least compound ancestor is never a parallel state."""
    right = State("R", states=(State("r1", transitions=(on("f", "r2"),)), State("r2")))
    left = State("L", states=(State("l1"),), transitions=(on("e", "L"),))
    instance = started(two_regions(left=left, right=right))

    assert after(instance, "f") == ["l1", "r2"]
    assert after(instance, "e") == ["l1", "r1"]


def test_several_targets() -> None:
    left, right = region("L", *map(State, ("l1", "l2"))), region("R", *map(State, ("r1", "r2")))
    whole = State("P", Kind.PARALLEL, (left, right))
    start = State("a", transitions=(on("e", "l2", "r2"), on("f", "r2")))

    assert after(started(Machine("m", (start, whole))), "e") == ["l2", "r2"]
    assert after(started(Machine("m", (start, whole))), "f") == ["l1", "r2"]


def test_an_initial_transition_may_lead_deep_and_has_an_effect() -> None:
    initial = Transition(targets=("a12",), effect=note("initial"))
    a = noisy("a", noisy("a1", noisy("a11"), noisy("a12")), initial=initial)
    instance = started(Machine("m", (a,)))

    assert instance.configuration.ids == ["a", "a1", "a12"]
    assert instance.data["notes"] == ["+a", "initial", "+a1", "+a12"]


def test_a_transition_into_a_state_does_not_take_its_initial_transition() -> None:
    initial = Transition(targets=("a1",), effect=note("initial"))
    a = State("a", states=(State("a1"), State("a2")), initial=initial)
    instance = started(Machine("m", (State("s", transitions=(on("e", "a2"),)), a)))

    assert after(instance, "e") == ["a2"]
    assert instance.data == {}


def test_the_first_child_is_initial_where_none_is_named() -> None:
    assert started(Machine("m", (State("b"), State("a")))).configuration.ids == ["b"]
    assert started(Machine("m", (State("b"), State("a")), ("a",))).configuration.ids == ["a"]


# ---- queues


def raising(name: str) -> object:
    return lambda instance, event: instance.raise_event(Event(name))


def test_a_raised_event_comes_before_those_from_outside() -> None:
    def both(instance: Instance, event: Event) -> None:
        instance.receive(Event("outside"))
        instance.raise_event(Event("inside"))

    b = State("b", transitions=(on("outside", "wrong"), on("inside", "c")))
    c = State("c", transitions=(on("outside", "d"),))
    start = State("a", transitions=(on("e", "b", effect=both),))
    machine = Machine("m", (start, b, c, State("d"), State("wrong")))

    assert after(started(machine), "e") == ["d"]


def test_an_eventless_transition_comes_before_a_raised_event() -> None:
    b = State("b", transitions=(on("inside", "wrong"), on("", "c")))
    start = State("a", transitions=(on("e", "b", effect=raising("inside")),))
    machine = Machine("m", (start, b, State("c"), State("wrong")))

    assert after(started(machine), "e") == ["c"]


def test_raised_events_are_looked_at_in_order() -> None:
    def both(instance: Instance, event: Event) -> None:
        instance.raise_event(Event("one"))
        instance.raise_event(Event("two"))

    notes = (on("one", effect=note("1")), on("two", effect=note("2")))
    instance = started(Machine("m", (State("a", transitions=(on("e", effect=both), *notes)),)))

    after(instance, "e")
    assert instance.data["notes"] == ["1", "2"]


def test_an_eventless_transition_sees_the_event_before_it() -> None:
    b = State("b", transitions=(on("", "c", guard=lambda instance, event: event.data == 7),))
    instance = started(Machine("m", (State("a", transitions=(on("e", "b"),)), b, State("c"))))

    instance.receive(Event("e", 7))
    assert instance.configuration.ids == ["c"]


def test_an_eventless_transition_is_looked_at_again_after_each_event() -> None:
    def count(instance: Instance, event: Event) -> None:
        instance.data["n"] = instance.data.get("n", 0) + 1

    enough = on("", "b", guard=lambda instance, event: instance.data.get("n", 0) >= 2)
    machine = Machine("m", (State("a", transitions=(on("e", effect=count), enough)), State("b")))
    instance = started(machine)

    assert after(instance, "e") == ["a"]
    assert after(instance, "e") == ["b"]


def test_in_sees_what_is_active_at_that_moment() -> None:
    found: list[tuple[bool, bool]] = []

    def look(instance: Instance, event: Event) -> None:
        found.append((instance.active("a"), instance.active("b")))

    a = State("a", exit=(look,), transitions=(on("e", "b", effect=look),))
    machine = Machine("m", (a, State("b", entry=(look,))))
    after(started(machine), "e")

    assert found == [(True, False), (False, False), (False, True)]


# ---- done events


def test_a_final_state_completes_the_state_around_it() -> None:
    a = State(
        "a",
        states=(State("a1", transitions=(on("e", "end"),)), State("end", Kind.FINAL)),
        transitions=(on("done.state.a", "b"),),
    )

    assert after(started(Machine("m", (a, State("b")))), "e") == ["b"]


def finishing(name: str, event: str) -> State:
    """A region that is done with an event."""
    return region(
        name,
        State(f"{name}1", transitions=(on(event, f"{name}end"),)),
        State(f"{name}end", Kind.FINAL),
    )


def test_a_parallel_state_is_done_when_all_its_regions_are() -> None:
    machine = two_regions(
        on("done.state.P", "out"), left=finishing("L", "e"), right=finishing("R", "f")
    )
    instance = started(machine)

    assert after(instance, "e") == ["Lend", "R1"]
    assert after(instance, "f") == ["out"]


def test_regions_that_end_together() -> None:
    trace = Trace()
    machine = two_regions(left=finishing("L", "e"), right=finishing("R", "e"))
    after(started(machine, trace), "e")

    events = [line[2:] for line in trace.lines if line.startswith("?")]
    assert events == ["e", "done.state.L", "done.state.R", "done.state.P"]


def test_a_parallel_state_in_another_counts_as_final_but_is_not_told() -> None:
    """Appendix D raises the events of the final state's parent and grandparent, and no more."""
    inner = State("Q", Kind.PARALLEL, (finishing("A", "a"), finishing("B", "b")))
    outer = State(
        "P", Kind.PARALLEL, (inner, finishing("C", "c")), transitions=(on("done.state.P", "out"),)
    )
    machine = Machine("m", (outer, State("out")))

    assert after(started(machine), "a", "b", "c") == ["out"]
    assert after(started(machine), "c", "a", "b") == ["Aend", "Bend", "Cend"]


def test_done_data() -> None:
    end = State("end", Kind.FINAL, donedata=lambda instance, event: event.data + 1)
    taken = on("done.state.a", "b", guard=lambda instance, event: event.data == 8)
    a = State("a", states=(State("a1", transitions=(on("e", "end"),)), end), transitions=(taken,))
    instance = started(Machine("m", (a, State("b"))))

    instance.receive(Event("e", 7))
    assert instance.configuration.ids == ["b"]


def test_done_data_without_a_value_is_an_error_and_then_the_event() -> None:
    end = State("end", Kind.FINAL, donedata=lambda instance, event: 1 // 0)
    failed, done = on("error.execution", "b"), on("done.state.a", "wrong")
    empty = on("done.state.a", "c", guard=lambda instance, event: event.data is None)
    a = State("a", states=(State("a1", transitions=(on("e", "end"),)), end))
    a = a._replace(transitions=(failed, done))
    machine = Machine("m", (a, State("b", transitions=(empty,)), State("c"), State("wrong")))

    assert after(started(machine), "e") == ["c"]


def test_a_guard_without_a_trigger_is_asked_after_an_event_that_nothing_waits_for() -> None:
    seen = on("", "b", guard=lambda instance, event: event.name == "x")
    instance = started(Machine("m", (State("a", transitions=(seen,)), State("b"))))

    assert after(instance, "y") == ["a"]
    assert after(instance, "x") == ["b"]


def test_a_final_state_of_the_machine_ends_it() -> None:
    machine = Machine("m", (noisy("a", transitions=(on("e", "end"),)), State("end", Kind.FINAL)))
    instance = started(machine)
    after(instance, "e")

    assert (instance.running, instance.final) == (False, "end")
    assert instance.configuration.ids == []
    assert after(instance, "e") == []


def test_the_end_leaves_all_states() -> None:
    left = noisy("L", noisy("l"))
    whole = State("P", Kind.PARALLEL, (left, region("R", State("r"))))
    instance = started(Machine("m", (whole,)))
    instance.data.clear()
    instance.stop()

    assert instance.data["notes"] == ["-l", "-L"]
    assert (instance.running, instance.final) == (False, None)


def stopping(instance: Instance, event: Event) -> bool:
    instance.stop()
    return False


@pytest.mark.parametrize(
    "transitions",
    [
        (on("e", "b", guard=stopping),),
        (on("e", "b", effect=stopping),),
        (on("e", "b"), on("", "b", guard=lambda i, e: e.name == "e" and stopping(i, e))),
        (on("e", effect=raising("x")), on("x", "b", guard=stopping)),
    ],
)
def test_a_machine_may_be_stopped_in_the_middle_of_a_step(
    transitions: tuple[Transition, ...],
) -> None:
    a = noisy("a", transitions=transitions)
    instance = started(Machine("m", (a, noisy("b", transitions=a.transitions[1:2]))))
    after(instance, "e", "e")

    assert not instance.running
    assert instance.configuration.ids == []
    notes = instance.data["notes"]
    entered = [each[1:] for each in notes if each[0] == "+"]
    assert entered == [each[1:] for each in notes if each[0] == "-"]


# ---- histories


def remembering(kind: Kind) -> Machine:
    default = Transition(targets=("a2",), effect=note("default"))
    a1 = State("a1", states=(State("a11", transitions=(on("in", "a12"),)), State("a12")))
    a2 = State("a2", transitions=(on("to", "a1"),))
    history = State("h", kind, transitions=(default,))
    a = State("a", states=(a1, a2, history), transitions=(on("out", "b"), on("again", "h")))
    return Machine("m", (State("b", transitions=(on("back", "h"), on("plain", "a"))), a))


def test_the_default_of_a_history() -> None:
    instance = started(remembering(Kind.HISTORY))

    assert after(instance, "back") == ["a2"]
    assert instance.data["notes"] == ["default"]


def test_a_history_that_holds_something_does_not_take_its_default() -> None:
    instance = started(remembering(Kind.HISTORY))

    assert after(instance, "plain", "out", "back") == ["a11"]
    assert "notes" not in instance.data


def test_a_shallow_history_restores_one_level() -> None:
    assert after(started(remembering(Kind.HISTORY)), "plain", "in", "out", "back") == ["a11"]


def test_a_deep_history_restores_all_levels() -> None:
    assert after(started(remembering(Kind.DEEP_HISTORY)), "plain", "in", "out", "back") == ["a12"]


def test_a_history_holds_what_was_left_last() -> None:
    instance = started(remembering(Kind.DEEP_HISTORY))

    assert after(instance, "plain", "in", "out", "back", "out", "plain", "out", "back") == ["a11"]


def test_a_transition_to_a_history_of_its_own_state_leads_back_at_once() -> None:
    """Histories are filled when states are left, before it is worked out what is entered."""
    instance = started(remembering(Kind.DEEP_HISTORY))

    assert after(instance, "plain", "in", "again") == ["a12"]


def test_histories_belong_to_the_instance() -> None:
    machine = remembering(Kind.DEEP_HISTORY)
    one, other = started(machine), started(machine)
    after(one, "plain", "in", "out")

    assert after(other, "back") == ["a2"]
    assert after(one, "back") == ["a12"]


def test_the_history_of_a_parallel_state_restores_all_regions() -> None:
    def switch(name: str) -> State:
        step = State(f"{name}1", transitions=(on(name, f"{name}2"),))
        return region(name.upper(), step, State(f"{name}2"))

    history = State("h", Kind.DEEP_HISTORY, transitions=(Transition(targets=("l1", "r1")),))
    whole = State(
        "P", Kind.PARALLEL, (switch("l"), switch("r"), history), transitions=(on("out", "b"),)
    )
    machine = Machine("m", (whole, State("b", transitions=(on("back", "h"),))))

    assert after(started(machine), "r", "out", "back") == ["l1", "r2"]


def test_an_initial_state_may_be_a_history() -> None:
    history = State("h", Kind.HISTORY, transitions=(Transition(targets=("a1",)),))
    a1 = State("a1", transitions=(on("to", "a2"),))
    a = State("a", states=(history, a1, State("a2")), initial=("h",), transitions=(on("out", "b"),))
    machine = Machine("m", (a, State("b", transitions=(on("back", "a"),))))

    assert after(started(machine), "to", "out", "back") == ["a2"]


# ---- errors


def broken(instance: Instance, event: Event) -> None:
    raise ExecutionError("nothing here")


def test_an_effect_that_fails_is_an_event_and_the_rest_is_done() -> None:
    b = State("b", entry=(note("1"), broken, note("2")), transitions=(on("error.execution", "c"),))
    instance = started(Machine("m", (State("a", transitions=(on("e", "b"),)), b, State("c"))))

    assert after(instance, "e") == ["c"]
    assert instance.data["notes"] == ["1", "2"]
    assert isinstance(instance.world, StillWorld)
    assert instance.world.errors == ["nothing here"]


def test_a_guard_that_fails_does_not_hold() -> None:
    divided = on("e", "b", guard=lambda instance, event: 1 / 0)
    a = State("a", transitions=(divided, on("error.*", "c")))

    assert after(started(Machine("m", (a, *map(State, "bc")))), "e") == ["c"]


def test_a_guard_of_the_state_around_fails_once() -> None:
    whole = on("e", "out", guard=broken)
    instance = started(
        two_regions(whole, left=region("L", State("l")), right=region("R", State("r")))
    )

    after(instance, "e")
    assert isinstance(instance.world, StillWorld)
    assert instance.world.errors == ["nothing here"]


def test_a_mistake_in_an_effect_is_not_hidden() -> None:
    wrong = on("e", effect=lambda instance, event: instance.nothing)  # type: ignore[attr-defined]
    instance = started(Machine("m", (State("a", transitions=(wrong,)),)))

    with pytest.raises(AttributeError):
        instance.receive(Event("e"))


def test_a_loop_of_eventless_transitions_is_an_error() -> None:
    around = State(
        "x", states=(State("b", transitions=(on("", "c"),)), State("c", transitions=(on("", "b"),)))
    )
    machine = Machine("m", (State("a", transitions=(on("e", "b"),)), around), limit=500)
    instance = started(machine)

    with pytest.raises(LoopError, match=r"loops through `b`, `c`$") as caught:
        instance.receive(Event("e"))
    assert caught.value.states == ["b", "c"]
    assert not instance.running
    instance.receive(Event("e"))


def test_a_loop_that_stays_in_a_state_names_it() -> None:
    machine = Machine("m", (State("a", transitions=(on("", effect=note("x")),)),), limit=200)

    with pytest.raises(LoopError) as caught:
        started(machine)
    assert caught.value.states == ["a"]


def test_a_guard_that_fails_over_and_over_is_a_loop() -> None:
    a = State("a", transitions=(on("", "a", guard=broken),))

    with pytest.raises(LoopError):
        started(Machine("m", (a,), limit=200))


def test_delays_of_no_length_that_lead_round_are_a_loop() -> None:
    wait = (lambda instance, event: instance.send_after(Event("t"), 0),)
    states = (
        State("a", transitions=(on("t", "b"),), entry=wait),
        State("b", transitions=(on("t", "a"),), entry=wait),
    )

    with pytest.raises(LoopError) as caught:
        started(Machine("m", states, limit=200))
    assert caught.value.states == ["a", "b"]


def test_a_long_way_is_no_loop() -> None:
    def count(instance: Instance, event: Event) -> None:
        instance.data["n"] = instance.data.get("n", 0) + 1

    go = on("", "a", effect=count, guard=lambda i, e: i.data.get("n", 0) < 5000)

    assert started(Machine("m", (State("a", transitions=(go,)),))).data["n"] == 5000


def test_an_instance_is_started_once() -> None:
    instance = started(Machine("m", (State("a"),)))

    with pytest.raises(RuntimeError, match="started once"):
        instance.start()


# ---- tables


@pytest.mark.parametrize(
    ("states", "message"),
    [
        ((State("a"), State("a")), "duplicate state `a`"),
        ((State("a", transitions=(on("e", "b"),)),), "unknown state `b`"),
        ((State("a", states=(State("b"),), initial=("c",)), State("c")), "`c` is not in `a`"),
        ((State("a", transitions=(on("e", "a", "b"),)), State("b")), "cannot be active together"),
        ((State("a", states=(State("h", Kind.HISTORY), State("b"))),), "must have one transition"),
    ],
)
def test_tables_that_are_no_machine(states: tuple[State, ...], message: str) -> None:
    with pytest.raises(TableError, match=re.escape(message)):
        Machine("m", states)


# ---- observers


def test_a_trace() -> None:
    trace = Trace()
    a = State("a", states=(State("a1", transitions=(on("e", "b"),)),))
    instance = started(Machine("m", (a, State("b"))), trace)
    after(instance, "e", "e")

    assert trace.lines == ["+ a", "+ a1", "? e", "- a1", "- a", "> b", "+ b", "? e"]


def test_an_observer_may_come_and_go() -> None:
    trace = Trace()
    machine = Machine(
        "m", (State("a", transitions=(on("e", "b"),)), State("b", transitions=(on("e", "a"),)))
    )
    instance = started(machine)
    after(instance, "e")
    instance.observer = trace
    after(instance, "e")
    instance.observer = None
    after(instance, "e")

    assert trace.lines == ["? e", "- b", "> a", "+ a"]


def test_what_a_machine_remembers_is_bounded() -> None:
    machine = Machine(
        "m", (State("a", transitions=(on("e", "b"),)), State("b", transitions=(on("e", "a"),)))
    )
    instance = started(machine)
    for number in range(50_000):
        instance.receive(Event(f"unknown{number}"))

    kept = sum(len(each._by_event) for each in machine.configurations.values())
    assert kept <= 20_001
    assert after(instance, "e") == ["b"]
