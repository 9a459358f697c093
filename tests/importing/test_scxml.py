"""SCXML documents as models: all periods of the CPSwarm dialect, and that of W3C."""

# ruff: noqa: E501 - one mistake a line

from __future__ import annotations

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.source import Source
from swarmdsl.codegen.swarm_printer.expressions import expression as written
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.importing import import_scxml
from swarmdsl.ir import (
    Address,
    EventTrigger,
    Literal,
    OutcomeTrigger,
    Send,
    State,
    StateKind,
    System,
)
from swarmdsl.syntax.types import INT, STRING

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="keeper"'
MONITOR = (
    "<datamodel><data id='invoke'><rosmonitor><topic>{}</topic><msg>{}</msg></rosmonitor></data>"
    "</datamodel><invoke type='ROS_MONITOR'/>"
)


def call(body: str, type_: str = "ROS_ACTION", more: str = "") -> str:
    return f"<datamodel><data id='invoke'>{body}{more}</data></datamodel><invoke type='{type_}'/>"


def lift(goal: str = "<goal type='empty'/>", result: str = "<result type='empty'/>") -> str:
    action = "<name>cmd/lift</name><action>arm_msgs/Lift</action>"
    return f"<rosaction>{action}{goal}{result}</rosaction>"


def imported(body: str, attributes: str = "", adf: str = "") -> tuple[System, Diagnostics]:
    report = Diagnostics()
    text = body if body.startswith("<scxml") else f"{HEAD} {attributes}>{body}</scxml>"
    described = [Source("arm.json", adf)] if adf else []
    return import_scxml([Source("keeper.xml", text)], described, "keeper", report), report


def states(system: System) -> dict[str, State]:
    return {state.id: state for state in system.machines[0].walk()}


def said(report: Diagnostics) -> list[tuple[str, str]]:
    return [(f.name, f.primary.span.text if f.primary else "") for f in report]


def ways(state: State) -> list[tuple[list[str], str | None]]:
    """Return the triggers, by name, and the target of each transition."""
    return [
        (
            [
                t.event if isinstance(t, EventTrigger) else getattr(t, "outcome", "done")
                for t in each.triggers
            ],
            each.target,
        )
        for each in state.transitions
    ]


ALL_HANDLED = "<transition event='succeeded aborted' target='End'/>"
END = "<final id='End'/>"


# ---- the idiom of monitors


def threads(name: str, inside: str, event: str, topic: str, target: str) -> str:
    monitor = (
        f"<state id='{name}EventMonitoring'>{MONITOR.format(topic, 'swarmros/SimpleEvent')}</state>"
    )
    way = f"<transition event='{event}' target='{target}'/>"
    return f"<parallel id='{name}Threads'>{inside}{monitor}{way}</parallel>"


def test_threads_behavior_and_monitoring_are_one_state() -> None:
    body = threads(
        "Rest", "<state id='RestBehavior'/>", "shiftStart", "bridge/events/shift_start", "End"
    )
    system, report = imported(body + END, "initial='RestThreads'")

    assert said(report) == []
    assert system.machines[0].initial == "Rest"
    assert [state.kind for state in states(system).values()] == [StateKind.SIMPLE, StateKind.FINAL]
    assert ways(states(system)["Rest"]) == [(["ShiftStart"], "End")]
    (event,) = system.events
    assert (event.name, event.swarm, event.topic, str(event.type)) == (
        *("ShiftStart", True, "shift_start", "swarmros/SimpleEvent"),
    )


@pytest.mark.parametrize("mistake", ["", "&nbsp;"])
def test_a_document_without_the_namespace(mistake: str) -> None:
    system, report = imported(
        f'<scxml name="keeper"><state id="a">{mistake}<transition event="go" target="b"/></state>'
        '<final id="b"/></scxml>'
    )

    assert [state.name for state in system.machines[0].states] == ["A", "B"]
    assert ("repaired-dialect", "scxml") in said(report)
    assert ("malformed-xml", "&nbsp;") in said(report) or not mistake


def test_a_behavior_keeps_its_states() -> None:
    inside = (
        f"<state id='WorkBehavior'><state id='Lift'>{call(lift())}{ALL_HANDLED}</state></state>"
    )
    system, report = imported(threads("Work", inside, "stop", "stop", "End") + END)

    assert said(report) == []
    assert states(system)["Work"].kind is StateKind.COMPOSITE
    assert ways(states(system)["Work"]) == [(["Stop"], "End")]
    assert ways(states(system)["Work.Lift"]) == [(["succeeded", "aborted"], "End")]
    assert not system.events[0].swarm


def test_each_event_goes_with_the_monitor_of_its_name() -> None:
    monitors = "".join(
        f"<state id='{n}'>{MONITOR.format(topic, type_)}</state>"
        for n, topic, type_ in (("A", "robot/low_battery", "m/Low"), ("B", "other", "m/Other"))
    )
    body = f"<parallel id='P'><state id='S'/>{monitors}<transition event='odd' target='End'/><transition event='lowBattery' target='End'/></parallel>{END}"
    system, report = imported(body)

    assert said(report) == []
    assert {e.name: (e.topic, str(e.type)) for e in system.events} == {
        "LowBattery": ("robot/low_battery", "m/Low"),
        "Odd": ("other", "m/Other"),
    }


def test_a_parallel_of_more_than_monitors_has_regions() -> None:
    one = f"<state id='L'><state id='L1'>{call(lift())}{ALL_HANDLED}</state></state>"
    other = f"<state id='R'>{call(lift())}{ALL_HANDLED}</state>"
    system, report = imported(f"<parallel id='P'>{one}{other}</parallel>{END}")

    assert said(report) == []
    assert [(s.id, s.kind) for s in states(system)["P"].states] == [
        ("P.L", StateKind.REGION),
        ("P.RRegion", StateKind.REGION),
    ]


def test_a_topic_carries_one_type() -> None:
    monitors = "".join(
        f"<state id='{n}'>{MONITOR.format('state', type_)}</state>"
        for n, type_ in (("A", "m/Low"), ("B", "m/Other"))
    )
    body = f"<parallel id='P'><state id='S'/>{monitors}<transition event='a' target='End'/><transition event='b' target='End'/></parallel>{END}"
    system, report = imported(body)

    assert said(report) == [("left-out", "rosmonitor")]
    assert [str(event.type) for event in system.events] == ["m/Low", "m/Low"]


def test_a_region_that_something_leads_to() -> None:
    regions = "<state id='L'><state id='L1'/></state><state id='R'><state id='R1'/></state>"
    system, report = imported(
        f"<state id='A'><transition event='e' target='R'/></state><parallel id='P'>{regions}</parallel>"
    )

    assert said(report) == [("assumed", "e")]
    assert ways(states(system)["A"]) == [(["E"], "P.RRegion.R")]
    assert print_system(system)


# ---- outcomes


def test_an_outcome_that_a_container_handles_is_that_of_what_is_inside() -> None:
    inner = f"<state id='A'>{call(lift())}<transition event='aborted' target='A'/></state>"
    body = f"<state id='Outer'>{inner}<transition event='succeeded' target='End'/></state>{END}"
    system, report = imported(body)

    assert said(report) == []
    assert ways(states(system)["Outer"]) == []
    assert ways(states(system)["Outer.A"]) == [(["aborted"], "Outer.A"), (["succeeded"], "End")]


def test_what_nobody_handles_ends_the_machine() -> None:
    system, report = imported(f"<state id='A'>{call(lift())}</state>")

    assert [(f.name, f.message) for f in report] == [
        (
            "open-outcome",
            "no transition handles `succeeded` and `aborted` of `A`: the machine ends then",
        )
    ]
    assert ways(states(system)["A"]) == [(["succeeded"], "Succeeded"), (["aborted"], "Aborted")]
    assert not system.machines[0].endless


def test_a_bare_outcome_of_a_state_that_does_nothing() -> None:
    idle = "<state id='Idle'><transition event='succeeded' target='A'/><transition event='aborted' target='A'/></state>"
    system, report = imported(f"{idle}<state id='A'>{call(lift())}{ALL_HANDLED}</state>{END}")

    assert said(report) == [("repaired-dialect", "succeeded"), ("left-out", "aborted")]
    assert ways(states(system)["Idle"]) == [([], "A")]


# ---- policies, by period


@pytest.mark.parametrize(
    ("goal", "faults"),
    [
        ("<goal type='empty'/>", 0),
        ("<goal empty='true'/>", 1),
        ("<goal/>", 1),
        ("", 1),
        ("<goal type='fixed'/>", 1),
    ],
)
def test_empty_goals(goal: str, faults: int) -> None:
    system, report = imported(f"<state id='A'>{call(lift(goal))}{ALL_HANDLED}</state>{END}")

    assert [name for name, _ in said(report)] == ["repaired-dialect"] * faults
    activity = states(system)["A"].activity
    assert activity is not None
    assert (activity.function, activity.arguments, activity.goal_callback) == ("lift", (), None)


ADF = """{"runtime-env": "ROS", "functions": [{"name": "raise_arm", "category": "swarm-lib",
  "api": {"comm_model": {"paradigm": "rosaction", "definition": {"name": "cmd/lift", "class": "arm_msgs/Lift",
    "goal": {"fields": [{"class": "float64", "name": "height"}, {"class": "uint8", "name": "speed"}]}}}}}]}"""


@pytest.mark.parametrize(
    ("goal", "names"),
    [
        ("<goal type='fixed'><param>1.5</param><param>2</param></goal>", []),
        ("<goal type='object'><param>1.5</param><param>2</param></goal>", ["repaired-dialect"]),
        ("<goal empty='false'><param>1.5</param><param>2</param></goal>", ["repaired-dialect"]),
        (
            "<goal type='fixed'><param>1.5</param><param>2</param><param>3</param></goal>",
            ["left-out"],
        ),
    ],
)
def test_values_in_their_order_are_those_of_the_fields(goal: str, names: list[str]) -> None:
    system, report = imported(
        f"<state id='A'>{call(lift(goal))}{ALL_HANDLED}</state>{END}", adf=ADF
    )

    assert [name for name, _ in said(report)] == names
    activity = states(system)["A"].activity
    assert activity is not None
    assert activity.function == "raise_arm"
    assert [(name, getattr(v, "value", None)) for name, v in activity.arguments] == [
        ("height", 1.5),
        ("speed", 2),
    ]


def test_a_field_without_a_value_is_zero() -> None:
    goal = "<goal type='fixed'><param>1.5</param></goal>"
    system, report = imported(
        f"<state id='A'>{call(lift(goal))}{ALL_HANDLED}</state>{END}", adf=ADF
    )

    assert [name for name, _ in said(report)] == ["assumed"]
    activity = states(system)["A"].activity
    assert activity is not None
    assert [getattr(v, "value", None) for _, v in activity.arguments] == [1.5, 0]


def test_code_in_a_goal_needs_a_callback() -> None:
    goal = "<goal type='fixed'><param>rospy.Duration(1)</param></goal>"
    system, report = imported(f"<state id='A'>{call(lift(goal))}{ALL_HANDLED}</state>{END}")

    assert "left-out" in [name for name, _ in said(report)]
    activity = states(system)["A"].activity
    assert activity is not None
    assert activity.goal_callback == "lift_goal"


@pytest.mark.parametrize(
    ("mappings", "faults"),
    [
        ("<mappings><map><x>height</x><y>top</y></map></mappings>", 0),
        ("<mappings><x>height</x><y>top</y></mappings>", 1),
    ],
)
@pytest.mark.parametrize("policy", ["userdata", "slot"])
def test_variables_go_by_the_mappings(mappings: str, faults: int, policy: str) -> None:
    goal = f"<goal type='{policy}'><var>height</var></goal>"
    body = f"<state id='A'>{call(lift(goal), more=mappings)}{ALL_HANDLED}</state>{END}"
    system, report = imported(body)

    assert [n for n, _ in said(report)].count("repaired-dialect") == faults + (policy == "slot")
    activity = states(system)["A"].activity
    assert activity is not None
    assert [(name, getattr(v, "name", None)) for name, v in activity.arguments] == [
        ("height", "top")
    ]
    assert [(v.name, str(v.type)) for v in system.machines[0].variables] == [("top", "string")]


def test_results_and_callbacks_of_a_service() -> None:
    parts = "<request type='callback'/><response type='userdata'><var>ok</var></response>"
    service = f"<rosservice><name>reset</name><srv>std_srvs.srv.Trigger</srv>{parts}</rosservice>"
    system, report = imported(
        f"<state id='A'>{call(service, 'ROS_SERVICE')}{ALL_HANDLED}</state>{END}"
    )

    activity = states(system)["A"].activity
    assert activity is not None
    assert activity.goal_callback == "reset_request"
    assert str(system.functions[0].communication.type) == "std_srvs/Trigger"
    # What ROS comes with is known: it has no such field.
    assert [n for n, _ in said(report)] == ["left-out"]


def test_a_body_that_does_not_fit_its_invoke() -> None:
    service = "<rosservice><name>stop</name><srv>Empty</srv><request type='empty'/><result type='empty'/></rosservice>"
    system, report = imported(f"<state id='A'>{call(service)}{ALL_HANDLED}</state>{END}")

    assert sorted(said(report)) == [
        ("assumed", "srv"),
        ("repaired-dialect", "invoke"),
        ("repaired-dialect", "result"),
    ]
    assert system.functions[0].communication.paradigm == "service"
    assert str(system.functions[0].communication.type) == "std_srvs/Empty"


def test_an_interface_that_is_described_as_another_kind() -> None:
    service = "<rosservice><name>lift</name><srv>arm_msgs/Lift</srv><request type='empty'/><response type='empty'/></rosservice>"
    body = f"<state id='A'>{call(service, 'ROS_SERVICE')}{ALL_HANDLED}</state>{END}"
    system, report = imported(body, adf=ADF)

    assert [n for n, _ in said(report)] == ["left-out"]
    assert system.interfaces == ()


def test_fields_that_cannot_be_fields() -> None:
    goal = "<goal type='userdata'><var>a b</var><var>top</var></goal>"
    system, report = imported(f"<state id='A'>{call(lift(goal))}{ALL_HANDLED}</state>{END}")

    assert said(report) == [("assumed", "rosaction"), ("left-out", "var")]
    assert states(system)["A"].activity is not None


# ---- names


def test_ids_and_events_with_slashes_and_tasks_of_2018() -> None:
    body = """<state id='Top' initial='Top/B'>
      <state id='Top/A'><invoke id='TASK[Loop]'/><transition event='/Close' target='Top/B'/></state>
      <state id='Top/B'><transition event='/Close' target='Top/A'/></state></state>"""
    system, report = imported(body)

    assert said(report) == [
        ("renamed", "Top/A"),
        ("left-out", "invoke"),
        ("assumed", "/Close"),
        ("renamed", "Top/B"),
    ]
    assert states(system)["Top"].initial == "Top.TopB"
    assert ways(states(system)["Top.TopA"]) == [(["Close"], "Top.TopB")]
    assert system.machines[0].endless


def test_an_id_that_is_given_twice_means_the_nearest() -> None:
    body = """<state id='P'><state id='A'><transition event='e' target='Land'/></state><state id='Land'/></state>
      <state id='Q'><state id='B'><transition event='e' target='Land'/></state><state id='Land'/></state>"""
    system, report = imported(body)

    assert [n for n, _ in said(report)] == ["assumed", "repaired-dialect"]
    assert ways(states(system)["P.A"]) == [(["E"], "P.Land")]
    assert ways(states(system)["Q.B"]) == [(["E"], "Q.Land2")]


def test_a_target_that_does_not_exist() -> None:
    _, report = imported("<state id='A'><transition event='e' target='Nowhere'/></state>")

    assert ("unknown-state", "Nowhere") in said(report)
    assert report.has_errors


def test_a_transition_from_one_region_into_another() -> None:
    one = f"<state id='L'><state id='L1'>{call(lift())}<transition event='succeeded aborted' target='R1'/></state></state>"
    other = "<state id='R'><state id='R1'/></state>"
    system, report = imported(f"<parallel id='P'>{one}{other}</parallel>")

    assert said(report)[0][0] == "open-outcome"
    assert ("left-out", "R1") in said(report)
    assert ways(states(system)["P.L.L1"]) == [
        (["succeeded"], "Succeeded"),
        (["aborted"], "Aborted"),
    ]


# ---- what is not XML


def test_the_output_of_the_modelio_exporter() -> None:
    text = f"""{HEAD} initial="RestThreads">
\t<parallel id="RestThreads>
\t\t<state id= "RestBehavior">
\t\t</state>
\t\t<state id="RestEventMonitoring">{MONITOR.format("bridge/events/shift_start", "swarmros/SimpleEvent")}</state>
\t\t<transition event="shiftStart" target= "Lift" />
\t</parallel>
\t<state id= "Lift"><br>&nbsp;
\t\t<name>cmd/lift</name>
\t\t<action>arm_msgs/Lift</action>
\t\t<goal type="userdata"><var>height</var></goal>
\t\t<result type="empty"/>
\t\t<transition event="succeeded" target="Rest"/>
\t\t<transition event="aborted" target="Lift"/>
\t</state>
</scxml>"""
    system, report = imported(text)

    assert sorted((f.name, f.primary.span.line if f.primary else 0) for f in report) == [
        ("assumed", 8),
        ("malformed-xml", 2),
        ("malformed-xml", 8),
        ("malformed-xml", 8),
        ("repaired-dialect", 8),
        ("repaired-dialect", 13),
    ]
    assert ways(states(system)["Rest"]) == [(["ShiftStart"], "Lift")]
    assert ways(states(system)["Lift"]) == [(["succeeded"], "Rest"), (["aborted"], "Lift")]


def test_what_cannot_be_repaired_is_an_error() -> None:
    system, report = imported(f"{HEAD}><state id='A'></scxml>")

    assert [(f.name, f.severity) for f in report] == [("not-xml", Severity.ERROR)]
    assert not system.machines


# ---- plain SCXML


def test_plain_scxml() -> None:
    body = """<datamodel><data id="count" expr="0"/></datamodel>
    <state id="work">
      <onentry><log expr="1"/></onentry>
      <initial><transition target="b"/></initial>
      <history id="h" type="deep"><transition target="a"/></history>
      <state id="a"><transition event="go" target="b"><assign location="count" expr="count + 1"/></transition></state>
      <state id="b"><transition event="back" cond="count &lt; 3 &amp;&amp; !(count == 7)" target="a"/>
        <transition event="go.on" target="f"/></state>
      <final id="f"/>
      <transition event="pause" target="p"/>
      <transition event="done.state.work" target="end"/>
    </state>
    <parallel id="p">
      <state id="l"><state id="l1"><transition event="go.*" target="l2"/></state><final id="l2"/></state>
      <state id="r"><onentry><raise event="go"/></onentry><transition event="go" cond="f(1)" target="end"/></state>
      <transition event="done.state.l" target="work"/>
      <transition event="*" target="h"/>
    </parallel>
    <final id="end"/>"""
    system, report = imported(body, "initial='work'")
    found = states(system)

    assert [n for n, _ in said(report) if n != "assumed"] == ["left-out", "sent-later", "left-out"]
    assert found["Work"].initial == "Work.B"
    assert found["Work.H"].deep
    assert ways(found["Work"]) == [(["Pause"], "P"), (["done"], "End")]
    assert ways(found["P.L.L1"]) == [(["Go", "GoOn"], "P.L.L2")]
    assert ways(found["P"]) == [(["done"], "Work"), (["Pause", "Go", "Back", "GoOn"], "Work.H")]
    assert len(found["P.RRegion.R"].entry) == 1
    assert found["Work.B"].transitions[0].guard is not None
    assert [v.name for v in system.machines[0].variables] == ["count"]


@pytest.mark.parametrize(
    ("cond", "guard"),
    [
        ("level == 1", "level == 1"),
        ("level !== 1.5 || open", "level != 1.5 or open"),
        ("!open &amp;&amp; !(name == 'a')", 'not open and not (name == "a")'),
        ("-level * 2 + 1 &lt;= level", "-level * 2 + 1 <= level"),
        ("In('A')", "in(A)"),
        ("level / 2 > 1", "level / 2 > 1"),
        ("Math.max(level, 2) == 3", "max(level, 2) == 3"),
        ("In('Nowhere')", None),
        ("In(level + 1)", None),
        ("In(1)", None),
        ("JSON.parse()", None),
        ("JSON.parse(level)", None),
        ("JSON.parse(JSON.stringify(level)) == 1", "level == 1"),
        ("(function (a) { return a; })(level)", None),
        ("Math.abs()", None),
        ("Math.min(level)", None),
        ("Math.PI > level", None),
        ("level.length > 1", "len(level) > 1"),
        ("level.height > 1", None),
        ("true.length > 1", None),
        ("level[0]", None),
        ("{a: 1}", None),
        ("+level == 2", "level == 2"),
        ("level % 2 == 1", None),
        ("((level % 2) + 2) % 2 == 1", "level % 2 == 1"),
        ("level > 1 ? true : false", None),
        ("typeof level == 'number'", None),
        ("level == null", None),
        ("_name == 'a'", None),
        ("Math.pow(level, 2) > 4", None),
        ("_event.data.x", None),
        ("level ==", None),
    ],
)
def test_conditions(cond: str, guard: str | None) -> None:
    body = (
        f"<state id='A'><transition event='e' cond=\"{cond}\" target='B'/></state><state id='B'/>"
    )
    system, report = imported(body)

    found = [each.guard for each in states(system)["A"].transitions]
    if guard is None:
        assert ("left-out", "transition") in said(report)
        assert found == []
    else:
        (made,) = found
        assert made is not None
        assert written(made) == guard


def test_what_only_states_that_are_stayed_in_can_have() -> None:
    way = "<transition event='e' target='A'/>"
    final = f"<final id='F'><onentry><raise event='e'/></onentry>{way}</final>"
    system, report = imported(f"<state id='A'><transition target='F'/></state>{final}{way}")

    assert said(report) == [
        ("left-out", "raise"),
        ("left-out", "transition"),
        ("left-out", "transition"),
    ]
    assert states(system)["F"].transitions == ()


def test_outcomes_are_events_like_others_where_nothing_is_called() -> None:
    system, _ = imported(
        "<state id='A'><transition event='halted' target='B'/></state><state id='B'/>"
    )

    assert ways(states(system)["A"]) == [(["Halted"], "B")]


def test_outcome_triggers_are_of_the_state_itself() -> None:
    system, _ = imported(f"<state id='A'>{call(lift())}{ALL_HANDLED}</state>{END}")

    assert states(system)["A"].transitions[0].triggers == (
        OutcomeTrigger("A", "succeeded"),
        OutcomeTrigger("A", "aborted"),
    )


@pytest.mark.parametrize(
    ("target", "address"),
    [
        ("target='uav'", Address("uav")),
        ("target='uav[2]'", Address("uav", Literal(2, INT))),
        ("target='big one'", Address(id=Literal("big one", STRING))),
        ("targetexpr=\"'uav[2]'\"", Address("uav", Literal(2, INT))),
        ("target=''", None),
        ("", None),
    ],
)
def test_the_address_of_a_swarm_event(target: str, address: Address | None) -> None:
    send = f"<send event='f' type='urn:swarmdsl:swarm' {target}/>"
    body = (
        f"<state id='A'><transition event='e' target='B'>{send}</transition></state><state id='B'/>"
    )
    system, _ = imported(body)

    ((sent,),) = (each.effects for each in states(system)["A"].transitions)
    assert isinstance(sent, Send)
    assert sent.to == address
