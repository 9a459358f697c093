"""Documented behavior of SMACH, stand-in and real; deviations of the real one."""

from __future__ import annotations

import importlib
import inspect
import sys
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture
def smach(smach_path: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    for folder in smach_path:
        monkeypatch.syspath_prepend(folder)
    yield importlib.import_module("smach")
    for name in [name for name in sys.modules if name.partition(".")[0] == "smach"]:
        del sys.modules[name]


def is_real(smach: Any) -> bool:
    return not hasattr(smach, "DEFECTS")


def ending(smach: Any, *outcomes: str, keys: dict[str, Any] | None = None) -> Any:
    """A state that ends with the first of its outcomes and stores values."""

    class Ending(smach.State):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__([*outcomes, "preempted"], output_keys=list(keys or ()))

        def execute(self, userdata: Any) -> str:
            for key, value in (keys or {}).items():
                userdata[key] = value
            return outcomes[0]

    return Ending()


def waiting(smach: Any) -> Any:
    """A state that waits until it is preempted."""

    class Waiting(smach.State):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__(["done", "preempted"])
            self.release = threading.Event()
            self.runs = threading.Event()

        def execute(self, userdata: Any) -> str:
            self.runs.set()
            while not self.release.wait(0.005):
                if self.preempt_requested():
                    self.service_preempt()
                    return "preempted"
            return "done"

    return Waiting()


def run(container: Any) -> tuple[threading.Thread, list[Any]]:
    outcomes: list[Any] = []
    thread = threading.Thread(target=lambda: outcomes.append(container.execute()), daemon=True)
    thread.start()
    return thread, outcomes


def test_a_machine_follows_its_transitions(smach: Any) -> None:
    machine = smach.StateMachine(["over"])
    with machine:
        smach.StateMachine.add("A", ending(smach, "x"), {"x": "B", "preempted": "over"})
        smach.StateMachine.add("B", ending(smach, "y"), {"y": "over", "preempted": "over"})
    assert machine.execute() == "over"
    assert machine.get_initial_states() == ["A"]
    edges = {("x", "A", "B"), ("preempted", "A", "over"), ("y", "B", "over")}
    assert edges <= set(machine.get_internal_edges())


def test_a_machine_begins_where_it_is_told(smach: Any) -> None:
    machine = smach.StateMachine(["a", "b"])
    with machine:
        smach.StateMachine.add("A", ending(smach, "x"), {"x": "a", "preempted": "a"})
        smach.StateMachine.add("B", ending(smach, "x"), {"x": "b", "preempted": "b"})
    machine.set_initial_state(["B"])
    assert machine.execute() == "b"


@pytest.mark.parametrize("transitions", [{}, {"x": "B"}])
def test_an_outcome_that_leads_nowhere_is_an_error(transitions: dict[str, str], smach: Any) -> None:
    def build() -> None:
        machine = smach.StateMachine(["over"])
        with machine:
            bound = {"preempted": "over", **transitions}
            smach.StateMachine.add("A", ending(smach, "x"), bound)
        machine.check_consistency()

    with pytest.raises(smach.InvalidTransitionError):
        build()


def test_an_outcome_that_is_not_bound_falls_through(
    smach: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def build() -> Any:
        machine = smach.StateMachine(["x", "preempted"])
        with machine:
            smach.StateMachine.add("A", ending(smach, "x"))
        return machine

    if not is_real(smach):
        with pytest.raises(smach.InvalidTransitionError):
            build().execute()
        monkeypatch.setattr(smach, "DEFECTS", {"fall-through"})
    assert build().execute() == "x"


def test_userdata_by_other_names(smach: Any) -> None:
    machine = smach.StateMachine(["over"], output_keys=["found"])
    with machine:
        state = ending(smach, "x", keys={"value": 5})
        transitions = {"x": "over", "preempted": "over"}
        smach.StateMachine.add("A", state, transitions, remapping={"value": "found"})
    outside = smach.UserData()
    assert machine.execute(outside) == "over"
    assert outside.found == 5


def test_a_machine_passes_a_preempt_on(smach: Any) -> None:
    machine = smach.StateMachine(["over", "preempted"])
    state = waiting(smach)
    with machine:
        smach.StateMachine.add("A", state, {"done": "over", "preempted": "preempted"})
    thread, outcomes = run(machine)
    assert state.runs.wait(60)
    machine.request_preempt()
    thread.join(60)
    assert outcomes == ["preempted"]
    assert not machine.preempt_requested()


def concurrence(smach: Any, *states: Any, **policy: Any) -> Any:
    policy.setdefault("default_outcome", "other")
    made = smach.Concurrence(["one", "other", "preempted"], **policy)
    with made:
        for number, state in enumerate(states):
            smach.Concurrence.add(f"S{number}", state)
    return made


def test_a_concurrence_waits_for_all(smach: Any) -> None:
    slow = waiting(smach)
    both = concurrence(smach, ending(smach, "x"), slow, outcome_map={"one": {"S1": "done"}})
    thread, outcomes = run(both)
    assert slow.runs.wait(60)
    time.sleep(0.05)
    assert thread.is_alive()
    slow.release.set()
    thread.join(60)
    assert outcomes == ["one"]


def test_the_most_specific_outcome_counts(smach: Any) -> None:
    ways = {"other": {"S0": "x"}, "one": {"S0": "x", "S1": "y"}}
    made = concurrence(
        smach,
        ending(smach, "x"),
        ending(smach, "y"),
        outcome_map=ways,
        default_outcome="preempted",
    )
    assert made.execute() == "one"


def test_a_child_that_ends_may_end_all(smach: Any) -> None:
    made = concurrence(
        smach,
        ending(smach, "x"),
        waiting(smach),
        child_termination_cb=lambda outcomes: True,
        outcome_cb=lambda outcomes: "one" if outcomes["S0"] == "x" else "other",
    )
    assert made.execute() == "one"


def test_a_concurrence_passes_a_preempt_on(smach: Any) -> None:
    states = [waiting(smach), waiting(smach)]
    made = concurrence(smach, *states)
    thread, outcomes = run(made)
    assert all(state.runs.wait(60) for state in states)
    time.sleep(0.05)
    made.request_preempt()
    thread.join(60)
    # Before 2.5.1, which has constants too, the real one looks at the outcomes of the children.
    is_older = "constants" not in inspect.signature(smach.StateMachine.add).parameters
    assert outcomes == ["other" if is_real(smach) and is_older else "preempted"]


def test_a_preempt_that_comes_too_early_is_lost(
    smach: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def preempted_early() -> tuple[Any, threading.Thread, list[Any]]:
        state = waiting(smach)
        made = concurrence(smach, state)
        made.request_preempt()
        return state, *run(made)

    if not is_real(smach):
        _, thread, outcomes = preempted_early()
        thread.join(60)
        assert outcomes == ["preempted"]
        monkeypatch.setattr(smach, "DEFECTS", {"lost-preempt"})
    state, thread, _ = preempted_early()
    thread.join(0.5)
    assert thread.is_alive()
    state.release.set()
    thread.join(60)
    assert not thread.is_alive()
