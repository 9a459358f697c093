"""Activities of active states, the servers they need, and delays."""

from __future__ import annotations

import pytest

from swarmdsl.execution.engine import (
    Activity,
    Event,
    ExecutionError,
    Instance,
    Kind,
    Machine,
    Run,
    Servers,
    State,
    Transition,
)

from .world import StillWorld, Trace, after, note, on, started

OUTCOMES = ("succeeded", "aborted", "preempted")


def busy(name: str, *transitions: Transition, server: str = "", **rest: object) -> State:
    """A state with an activity of its own name."""
    events = {outcome: f"do.{name}.{outcome}" for outcome in OUTCOMES}
    activity = Activity(name, server or name, events, **rest)  # type: ignore[arg-type]
    return State(name, transitions=transitions, activity=activity)


def world(instance: Instance) -> StillWorld:
    assert isinstance(instance.world, StillWorld)
    return instance.world


def run_of(instance: Instance, name: str) -> Run:
    return world(instance).runs[name]


WORK = Machine(
    "m",
    (
        busy(
            "work", on("do.work.succeeded", "good"), on("do.work.aborted", "bad"), on("e", "idle")
        ),
        *map(State, ("good", "bad")),
        State("idle", transitions=(on("e", "work"),)),
    ),
)


@pytest.mark.parametrize(
    ("outcome", "state"), [("succeeded", "good"), ("aborted", "bad"), ("preempted", "work")]
)
def test_an_outcome_is_an_event(outcome: str, state: str) -> None:
    instance = started(WORK)
    assert world(instance).asked == ["start work"]
    run_of(instance, "work").end(outcome)

    assert instance.configuration.ids == [state]
    assert world(instance).asked == ["start work"]


def test_an_outcome_concerns_its_state_alone() -> None:
    regions = [
        State(
            f"R{name}",
            states=(busy(name, on(f"do.{name}.succeeded", f"{name}2")), State(f"{name}2")),
        )
        for name in "ab"
    ]
    instance = started(Machine("m", (State("P", Kind.PARALLEL, tuple(regions)),)))
    run_of(instance, "b").end("succeeded")

    assert instance.configuration.innermost == ["a", "b2"]


def test_leaving_the_state_cancels_its_activity() -> None:
    instance = started(WORK)
    after(instance, "e")

    assert world(instance).asked == ["start work", "cancel work"]


def test_the_end_of_a_cancelled_activity_is_no_event() -> None:
    instance = started(WORK)
    first = run_of(instance, "work")
    after(instance, "e")
    first.end("succeeded")

    assert instance.configuration.ids == ["idle"]


def test_the_next_activity_on_a_server_waits_until_the_cancelled_one_has_stopped() -> None:
    instance = started(WORK)
    first = run_of(instance, "work")
    after(instance, "e", "e")
    assert world(instance).asked == ["start work", "cancel work"]

    first.end("preempted")
    assert world(instance).asked == ["start work", "cancel work", "start work"]
    assert instance.configuration.ids == ["work"]
    run_of(instance, "work").end("succeeded")
    assert instance.configuration.ids == ["good"]


def test_an_activity_on_another_server_does_not_wait() -> None:
    machine = Machine("m", (busy("one", on("e", "two")), busy("two")))
    instance = started(machine)
    after(instance, "e")

    assert world(instance).asked == ["start one", "cancel one", "start two"]


def test_what_waits_for_a_server_and_is_left_is_forgotten() -> None:
    instance = started(WORK)
    first = run_of(instance, "work")
    after(instance, "e", "e", "e")
    first.end("preempted")

    assert world(instance).asked == ["start work", "cancel work"]


def test_instances_of_a_robot_share_servers() -> None:
    servers, place = Servers(), StillWorld()
    machines = (
        Machine("m", (busy("one", on("e", "idle"), server="arm"), State("idle"))),
        Machine("n", (State("idle", transitions=(on("e", "two"),)), busy("two", server="arm"))),
    )
    one, two = (Instance(machine, place, servers=servers) for machine in machines)
    one.start()
    two.start()
    after(one, "e")
    after(two, "e")
    assert place.asked == ["start one", "cancel one"]
    place.runs["one"].end("aborted")

    assert place.asked == ["start one", "cancel one", "start two"]


def test_an_activity_that_ended_is_not_cancelled() -> None:
    """Its end and the event that leaves the state may be in the queue together."""

    class Hasty(StillWorld):
        def send(self, instance: Instance, event: Event) -> None:
            self.runs["work"].end("succeeded")
            instance.receive(Event("leave"))

    state = busy(
        "work",
        on("go", effect=lambda instance, event: instance.emit(Event("x"))),
        on("leave", "idle"),
    )
    place = Hasty()
    instance = Instance(Machine("m", (state, State("idle", transitions=(on("e", "work"),)))), place)
    instance.start()
    after(instance, "go")
    assert instance.configuration.ids == ["idle"]
    after(instance, "e")

    assert place.asked == ["start work", "start work"]


def test_an_outcome_of_an_earlier_visit_does_not_count() -> None:
    """It was in the queue when the state was left and entered again."""

    def end_and_restart(instance: Instance, event: Event) -> None:
        instance.receive(Event("again"))
        world(instance).runs["work"].end("succeeded")

    state = busy(
        "work",
        on("go", effect=end_and_restart),
        on("again", "work"),
        on("do.work.succeeded", "good"),
    )
    instance = started(Machine("m", (state, State("good"))))

    assert after(instance, "go") == ["work"]


def test_activities_start_when_the_machine_has_come_to_rest() -> None:
    """Appendix D invokes at the end of a macrostep: in the order of the document, after effects."""
    regions = tuple(
        State(f"R{name}", states=(State(f"{name}0", transitions=(on("", name),)), busy(name)))
        for name in "ab"
    )
    trace = Trace()
    started(Machine("m", (State("P", Kind.PARALLEL, regions),)), trace)

    assert trace.lines[-4:] == ["+ a", "+ b", "start a", "start b"]


def test_the_activity_of_a_state_left_at_once_is_not_started() -> None:
    instance = started(Machine("m", (busy("one", on("", "two")), State("two"))))

    assert world(instance).asked == []


def test_a_transition_without_a_target_lets_the_activity_go_on() -> None:
    instance = started(Machine("m", (busy("one", on("e", effect=note("x"))),)))
    after(instance, "e")

    assert world(instance).asked == ["start one"]


def test_a_transition_to_the_state_itself_starts_the_activity_anew() -> None:
    instance = started(Machine("m", (busy("one", on("e", "one")),)))
    first = run_of(instance, "one")
    after(instance, "e")
    first.end("preempted")

    assert world(instance).asked == ["start one", "cancel one", "start one"]


def test_the_end_of_the_machine_cancels() -> None:
    trace = Trace()
    instance = started(Machine("m", (busy("one", on("e", "end")), State("end", Kind.FINAL))), trace)
    after(instance, "e")
    assert world(instance).asked == ["start one", "cancel one"]
    assert "cancel one" in trace.lines

    instance = started(Machine("m", (busy("one"),)))
    instance.stop()
    assert world(instance).asked == ["start one", "cancel one"]


def test_goals_are_made_when_the_activity_starts() -> None:
    instance = started(
        Machine(
            "m", (busy("one", goal=lambda instance: instance.data["n"] + 1),), data=lambda: {"n": 1}
        )
    )

    assert run_of(instance, "one").goal == 2


def test_a_goal_without_a_value_aborts_the_activity() -> None:
    machine = Machine(
        "m", (busy("one", on("do.one.aborted", "bad"), goal=lambda instance: 1 // 0), State("bad"))
    )
    instance = started(machine)

    assert instance.configuration.ids == ["bad"]
    assert world(instance).asked == []
    assert len(world(instance).errors) == 1


def test_results_are_stored_before_a_guard_looks() -> None:
    def store(instance: Instance, event: Event) -> None:
        instance.data["n"] = event.data

    seen = on("do.one.succeeded", "good", guard=lambda instance, event: instance.data["n"] == 5)
    instance = started(Machine("m", (busy("one", seen, finalize=store), State("good"))))
    run_of(instance, "one").end("succeeded", 5)

    assert instance.configuration.ids == ["good"]


def test_a_result_is_seen_by_a_guard_without_a_trigger() -> None:
    def store(instance: Instance, event: Event) -> None:
        instance.data["result"] = event.data

    seen = on("", "good", guard=lambda instance, event: "result" in instance.data)
    instance = started(Machine("m", (busy("one", seen, finalize=store), State("good"))))
    run_of(instance, "one").end("succeeded", 5)

    assert instance.configuration.ids == ["good"]


def test_only_success_has_results() -> None:
    instance = started(Machine("m", (busy("one", finalize=note("stored")),)))
    run_of(instance, "one").end("aborted", 5)

    assert instance.data == {}


def test_a_result_that_cannot_be_stored_is_an_error() -> None:
    def fail(instance: Instance, event: Event) -> None:
        raise ExecutionError("no such field")

    machine = Machine("m", (busy("one", on("error.execution", "bad"), finalize=fail), State("bad")))
    instance = started(machine)
    run_of(instance, "one").end("succeeded")

    assert instance.configuration.ids == ["bad"]
    assert world(instance).errors == ["no such field"]


def test_an_activity_ends_once() -> None:
    again = busy("work", on("do.work.succeeded", "work"))
    instance = started(Machine("m", (again,)))
    first = run_of(instance, "work")
    first.end("succeeded")
    first.end("aborted")

    assert world(instance).asked == ["start work", "start work"]


def test_all_that_waited_for_a_server_begin() -> None:
    regions = [State(f"R{each}", states=(busy(each, server="arm"),)) for each in ("one", "two")]
    whole = State("P", Kind.PARALLEL, tuple(regions))
    instance = started(Machine("m", (busy("old", on("e", "P"), server="arm"), whole)))
    after(instance, "e")
    assert world(instance).asked == ["start old", "cancel old"]

    run_of(instance, "old").end("preempted")
    assert world(instance).asked[2:] == ["start one", "start two"]


def test_an_activity_that_ended_in_the_step_that_leaves_its_state_is_not_cancelled() -> None:
    def finish(instance: Instance, event: Event) -> None:
        run_of(instance, "one").end("succeeded")

    one = busy("one", on("e", "two"), server="arm")._replace(exit=(finish,))
    two = busy("two", on("do.one.succeeded", "wrong"), server="arm")
    instance = started(Machine("m", (one, two, State("wrong"))))
    after(instance, "e")

    assert instance.configuration.ids == ["two"]
    assert world(instance).asked == ["start one", "start two"]


# ---- delays


def delayed(delay: int) -> State:
    """A state that is left after so many nanoseconds."""
    return State(
        "a",
        entry=(lambda instance, event: instance.send_after(Event("late"), delay, "timer"),),
        exit=(lambda instance, event: instance.cancel("timer"),),
        transitions=(on("late", "b"), on("e", "c"), on("again", "a"), on("stay", effect=note("x"))),
    )


def delaying(delay: int = 100) -> Machine:
    return Machine(
        "m", (delayed(delay), State("b"), State("c", transitions=(on("e", "a"), on("late", "b"))))
    )


def test_a_delay_passes() -> None:
    instance = started(delaying())
    world(instance).clock.advance(99)
    assert instance.configuration.ids == ["a"]
    world(instance).clock.advance(1)
    assert instance.configuration.ids == ["b"]


def test_leaving_the_state_cancels_the_delay() -> None:
    instance = started(delaying())
    after(instance, "e")
    world(instance).clock.advance(1000)

    assert instance.configuration.ids == ["c"]


def test_the_end_of_the_machine_cancels_every_delay() -> None:
    send = lambda instance, event: instance.send_after(Event("late"), 100)  # noqa: E731
    first = State("a", entry=(send,), transitions=(on("e", "end"),))
    instance = started(Machine("m", (first, State("end", Kind.FINAL))))
    assert world(instance).clock.next == 100
    after(instance, "e")

    assert world(instance).clock.next is None


def test_a_delay_begins_anew_with_the_state() -> None:
    instance = started(delaying())
    world(instance).clock.advance(60)
    after(instance, "again")
    world(instance).clock.advance(60)
    assert instance.configuration.ids == ["a"]
    world(instance).clock.advance(40)
    assert instance.configuration.ids == ["b"]


def test_a_transition_without_a_target_lets_the_delay_go_on() -> None:
    instance = started(delaying())
    world(instance).clock.advance(60)
    after(instance, "stay")
    world(instance).clock.advance(40)

    assert instance.configuration.ids == ["b"]


@pytest.mark.parametrize("delay", [0, -5])
def test_a_delay_that_is_over_is_an_event_at_once(delay: int) -> None:
    assert started(delaying(delay)).configuration.ids == ["b"]


def test_a_delayed_event_that_is_cancelled_while_it_waits_does_not_count() -> None:
    def leave_late(instance: Instance, event: Event) -> None:
        instance.receive(Event("e"))
        world(instance).clock.advance(100)

    a = delayed(100)
    go = on("go", effect=leave_late)
    a = State("a", entry=a.entry, exit=a.exit, transitions=(*a.transitions, go))
    instance = started(Machine("m", (a, State("b"), State("c", transitions=(on("late", "b"),)))))

    assert after(instance, "go") == ["c"]


def test_delays_end_with_the_machine() -> None:
    instance = started(delaying())
    instance.stop()

    assert world(instance).clock.next is None


def test_events_of_the_same_moment_come_in_the_order_they_were_sent() -> None:
    def both(instance: Instance, event: Event) -> None:
        instance.send_after(Event("one"), 10)
        instance.send_after(Event("two"), 10)

    a = State(
        "a", entry=(both,), transitions=(on("one", effect=note("1")), on("two", effect=note("2")))
    )
    instance = started(Machine("m", (a,)))
    world(instance).clock.advance(10)

    assert instance.data["notes"] == ["1", "2"]


def test_events_to_others() -> None:
    trace = Trace()
    say = on("e", effect=lambda instance, event: instance.emit(Event("hello", 3)))
    instance = started(Machine("m", (State("a", transitions=(say,)),)), trace)
    after(instance, "e")

    assert world(instance).asked == ["send hello 3"]
    assert trace.lines[-1] == "send hello"
