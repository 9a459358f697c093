"""A preempt request reaches a SMACH machine at any time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

import pytest

from swarmdsl.execution.engine import Event
from swarmdsl.ir import System

from ...agreement.scripts import Subject
from ...ros2_outcomes.agreement import PATIENCE, Host

MODEL = """package lab
message Note { level : int32 }
event Go   : Note
event Stop : Note
statemachine Work {
  initial Both
  parallel state Both {
    region L { initial A; state A { on Go -> B }  state B { on Go -> A } }
    region R { initial C; state C { after 1 h -> C } }
    on Stop -> End
  }
  final End
}
"""
Build = Callable[..., ModuleType]


@pytest.fixture
def work(compiled: Callable[[str], System], build: Build) -> tuple[Any, Host]:
    """The machine, and what runs its engine."""
    system = compiled(MODEL)
    subject = Subject(system.machines[0], system)
    module = build(system, "Work", subject.table)
    return module.build(), Host(subject, module.CHART)


def executed(machine: Any) -> tuple[threading.Thread, list[str]]:
    ends: list[str] = []
    thread = threading.Thread(target=lambda: ends.append(machine.execute()), daemon=True)
    thread.start()
    return thread, ends


def test_before_it_begins_it_ends_without_having_begun(work: tuple[Any, Host]) -> None:
    machine, host = work
    machine.request_preempt()
    assert machine.execute() == "preempted"
    assert host.model is None


def test_it_begins_anew_after_that(work: tuple[Any, Host]) -> None:
    machine, host = work
    for number in range(1, 6):
        thread, ends = executed(machine)
        end = time.monotonic() + PATIENCE
        while "Both.R.C" not in host.told.order[2 * (number - 1) :]:
            assert time.monotonic() < end
            time.sleep(0.001)
        machine.request_preempt()
        thread.join(PATIENCE)
        assert ends == ["preempted"]
        assert not machine.preempt_requested()


def test_whenever_it_comes(work: tuple[Any, Host]) -> None:
    machine, _ = work
    for number in range(30):
        thread, ends = executed(machine)
        time.sleep(number * 0.0002)
        machine.request_preempt()
        thread.join(PATIENCE)
        assert ends == ["preempted"], f"after {number * 0.2} ms"
        machine.recall_preempt()


def test_what_fails_in_a_region_ends_the_other(
    work: tuple[Any, Host], monkeypatch: pytest.MonkeyPatch
) -> None:
    machine, host = work
    region = machine.get_children()["Both"].get_children()["L"]
    monkeypatch.setattr(region.get_children()["B"], "execute", lambda userdata: 1 / 0)
    monkeypatch.setattr(threading, "excepthook", lambda arguments: None)  # SMACH raises there
    errors: list[BaseException] = []

    def run() -> None:
        try:
            machine.execute()
        except Exception as error:
            errors.append(error)

    before = set(threading.enumerate())
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    end = time.monotonic() + PATIENCE
    while host.model is None or "Both.L.A" not in host.told.order:
        assert time.monotonic() < end
        time.sleep(0.001)
    host.model.instance.receive(Event("Go"))
    host.settle()
    thread.join(PATIENCE)
    assert errors
    assert not host.model.instance.running
    # SMACH does not wait for the other region, which still prints how it ends.
    for region_thread in set(threading.enumerate()) - before:
        region_thread.join(PATIENCE)
