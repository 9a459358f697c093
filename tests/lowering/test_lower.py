"""Lowering of valid models: ids, expanded submachines, units, names of packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.driver import pipeline

Compiled = Callable[[str], ir.System]
EVENT = "event Go : std_msgs/Empty\n"


def states(machine: ir.StateMachine) -> dict[str, ir.State]:
    return {state.id: state for state in machine.walk()}


def machine_of(system: ir.System, name: str) -> ir.StateMachine:
    return next(machine for machine in system.machines if machine.name == name)


REUSE = f"""{EVENT}
statemachine Fly {{
  initial First
  state First = Climb {{ on done.Top -> Second }}
  state Second = Climb {{ on done -> Out }}
  final Out
}}
statemachine Climb {{
  param step : float64 = 1.5
  var height : float64 = 0.0
  initial Up
  state Up {{
    on Go [height < 3.0] / height = height + step -> Up
    on Go -> Top
  }}
  final Top
}}
"""


def test_a_reused_machine_is_put_in_place(compiled: Compiled) -> None:
    fly = machine_of(compiled(REUSE), "Fly")
    first = states(fly)["First"]

    assert list(states(fly)) == [
        *("First", "First.Up", "First.Top"),
        *("Second", "Second.Up", "Second.Top"),
        "Out",
    ]
    assert (first.kind, first.initial, first.submachine) == (
        ir.StateKind.COMPOSITE,
        "First.Up",
        "Climb",
    )
    assert [t.target for t in states(fly)["First.Up"].transitions] == ["First.Up", "First.Top"]


def test_each_use_of_a_machine_has_variables_of_its_own(compiled: Compiled) -> None:
    fly = machine_of(compiled(REUSE), "Fly")
    (effect,) = states(fly)["Second.Up"].transitions[0].effects

    assert [variable.name for variable in fly.variables] == ["first_height", "second_height"]
    assert isinstance(effect, ir.Assignment)
    assert effect.variable == "second_height"


def test_a_reused_machine_runs_with_its_defaults(compiled: Compiled) -> None:
    system = compiled(REUSE)
    (effect,) = states(machine_of(system, "Fly"))["First.Up"].transitions[0].effects
    (own,) = states(machine_of(system, "Climb"))["Up"].transitions[0].effects

    assert machine_of(system, "Fly").params == ()
    assert isinstance(effect, ir.Assignment)
    assert isinstance(effect.value, ir.Binary)
    assert effect.value.right == ir.Literal(1.5, ir.Primitive("float64"))
    assert isinstance(own, ir.Assignment)
    assert isinstance(own.value, ir.Binary)
    assert own.value.right == ir.ParamRef("step", ir.Primitive("float64"))


def test_done_names_the_final_state_by_its_id(compiled: Compiled) -> None:
    fly = machine_of(compiled(REUSE), "Fly")
    triggers = [states(fly)[name].transitions[0].triggers for name in ("First", "Second")]

    assert triggers == [
        (ir.DoneTrigger("First", "First.Top"),),
        (ir.DoneTrigger("Second", None),),
    ]


def test_names_that_would_be_alike_after_reuse_differ(compiled: Compiled) -> None:
    system = compiled(f"""{EVENT}
      statemachine M {{
        var fly_up_x : int8
        initial FlyUp
        state FlyUp = N {{ on done -> F }}
        final F
      }}
      statemachine N {{ var x : int8; initial F; final F }}
    """)

    assert [v.name for v in machine_of(system, "M").variables] == ["fly_up_x", "fly_up_x_"]


def test_ids_are_paths(compiled: Compiled) -> None:
    (machine,) = compiled(f"""{EVENT}
      statemachine M {{
        initial P
        parallel state P {{
          region Left {{ initial A; state A {{ on Go -> B }} final B }}
          region Right {{ initial A; state A {{ initial C; final C; on done -> B }} final B }}
          on Left.done.B -> F
          on done -> F
        }}
        final F
      }}
    """).machines
    parallel = states(machine)["P"]

    assert list(states(machine)) == [
        *("P", "P.Left", "P.Left.A", "P.Left.B"),
        *("P.Right", "P.Right.A", "P.Right.A.C", "P.Right.B", "F"),
    ]
    assert [transition.triggers for transition in parallel.transitions] == [
        (ir.DoneTrigger("P.Left", "P.Left.B"),),
        (ir.DoneTrigger("P", None),),
    ]


@pytest.mark.parametrize(
    ("written", "nanoseconds"),
    [("3 s", 3 * 10**9), ("1.5 ms", 1_500_000), ("2us", 2000), ("2 min", 12 * 10**10)],
)
def test_durations_are_nanoseconds(compiled: Compiled, written: str, nanoseconds: int) -> None:
    (member,) = compiled(f"member M {{ param limit : duration = {written} }}").members

    assert member.params[0].default == ir.Literal(nanoseconds, ir.Primitive("duration"))


@pytest.mark.parametrize(
    ("written", "lower", "upper"),
    [("", 1, 1), ("[3]", 3, 3), ("[1..5]", 1, 5), ("[2..*]", 2, None), ("[*]", 0, None)],
)
def test_multiplicities(compiled: Compiled, written: str, lower: int, upper: int | None) -> None:
    (swarm,) = compiled(f"member M {{ }} swarm S {{ m : M{written} }}").swarms

    assert swarm.roles[0].multiplicity == ir.Multiplicity(lower, upper)


def test_lengths_are_metres(compiled: Compiled) -> None:
    (place,) = compiled("environment E { size 1 km x 2.5 m x 30cm }").environments

    assert place.size == pytest.approx((1000, 2.5, 0.3))


def test_topics_are_names_where_none_is_given(compiled: Compiled) -> None:
    system = compiled(
        'event TargetFound : a/B\nevent Low : a/B on "battery/low"\n'
        'sensor Camera { out bigImage : a/B; out small : a/B on "s" }'
    )

    assert [event.topic for event in system.events] == ["target_found", "battery/low"]
    assert [port.topic for port in system.components[0].ports] == ["big_image", "s"]


BEHAVING = f"""{EVENT}
statemachine M {{
  param own : int32 = 1
  initial A
  state A {{ on Go [own + theirs > 3] -> F }}
  final F
}}
"""


def test_a_machine_has_the_params_of_its_members_that_it_uses(compiled: Compiled) -> None:
    member = "behavior M; param theirs : int32 = 2; param unused : int32 = 3"
    (machine,) = compiled(f"{BEHAVING} member R {{ {member} }}").machines

    assert [(p.name, p.default and p.default.value) for p in machine.params] == [  # type: ignore[union-attr]
        ("own", 1),
        ("theirs", 2),
    ]


def test_a_value_that_depends_on_the_robot_is_no_default(compiled: Compiled) -> None:
    """The machine has no param of the robot, and its own may have the same name."""
    (machine,) = compiled("""
      endless statemachine Ticking {
        param delay : duration = 1 s
        initial Wait
        state Wait { after delay -> Wait }
      }
      sensor Clock { behavior Ticking; param delay : duration }
      member R { param delay : duration; clock : Clock { delay = delay * 2 } }
    """).machines

    (delay,) = machine.params
    assert delay.default is None
    assert delay.declared == ir.Literal(1_000_000_000, ir.Primitive("duration"))


def test_members_that_disagree_leave_no_default(compiled: Compiled) -> None:
    (machine,) = compiled(
        f"{BEHAVING} member R {{ behavior M; param theirs : int32 = 2; param own : int32 = 5 }}"
        "member Q { behavior M; param theirs : int32 = 3; param own : int32 = 5 }"
    ).machines

    assert [(p.name, p.default and p.default.value) for p in machine.params] == [  # type: ignore[union-attr]
        ("own", 5),
        ("theirs", None),
    ]


BEACON = """
virtual Beacon { param period : duration = 250 ms; behavior Blink }
endless statemachine Blink {
  param period : duration
  initial On
  state On { after period -> On }
}
"""


@pytest.mark.parametrize(
    ("members", "period"),
    [
        ("", 250_000_000),
        ("member Tug { beacon : Beacon }", 250_000_000),
        ("member Tug { beacon : Beacon { period = 2 s } }", 2_000_000_000),
        ("member Tug { a : Beacon { period = 2 s }  b : Beacon { period = 2000 ms } }", 2 * 10**9),
        ("member Tug { a : Beacon { period = 2 s } } member Pram extends Tug { }", 2 * 10**9),
        ("member Tug { a : Beacon { period = 2 s }  b : Beacon }", None),
        ("member Tug { a : Beacon { period = 2 s } } member Pram { b : Beacon }", None),
    ],
)
def test_a_machine_of_a_component_has_the_values_of_the_parts(
    members: str, period: int | None, compiled: Compiled
) -> None:
    (machine,) = compiled(f"{BEACON}{members}").machines

    assert [(p.name, p.default and p.default.value) for p in machine.params] == [  # type: ignore[union-attr]
        ("period", period)
    ]


def test_names_of_two_packages_do_not_collide(tmp_path: Path) -> None:
    (tmp_path / "a.swarm").write_text("package a.x\nevent Go : std_msgs/Empty\n")
    (tmp_path / "b.swarm").write_text(
        "package b\nevent Go : std_msgs/Empty\nevent Only : std_msgs/Empty\n"
        "event a_x_Go : std_msgs/Empty\n"
        "statemachine M { initial A; state A { on Go -> F } final F }\n"
    )
    system = pipeline.check([tmp_path]).system
    assert system is not None
    names = [event.name for event in system.events]
    (trigger,) = states(system.machines[0])["A"].transitions[0].triggers

    assert names == ["a_x_Go_", "b_Go", "Only", "a_x_Go"]
    assert trigger == ir.EventTrigger("b_Go")


def test_the_system_is_called_like_the_first_package(tmp_path: Path) -> None:
    (tmp_path / "main.swarm").write_text('/// All.\npackage sar.main\nimport "b.swarm"\n')
    (tmp_path / "b.swarm").write_text("package b\nevent Go : std_msgs/Empty\n")
    system = pipeline.check([tmp_path / "main.swarm"]).system

    assert system is not None
    assert (system.name, system.doc) == ("sar.main", "All.")
    assert [event.name for event in system.events] == ["Go"]


def test_a_struct_is_a_message_that_an_event_can_carry(
    compiled: Callable[[str], ir.System],
) -> None:
    system = compiled("struct Place { x : float64 }\nevent Seen : Place\n")

    assert [(str(event.type), event.topic) for event in system.events] == [("model/Place", "seen")]
    assert [(str(known.type), known.external) for known in system.interfaces] == [
        ("model/Place", False)
    ]


def test_what_is_heard_on_one_topic_is_one_event(compiled: Callable[[str], ir.System]) -> None:
    system = compiled(
        """
        event Low : std_msgs/Empty on "battery"
        swarm event Found : std_msgs/Empty
        statemachine M {
          initial A
          state A {
            monitor "battery"             : std_msgs/Empty -> B
            monitor "bridge/events/found" : std_msgs/Empty -> B
            monitor "found"               : std_msgs/Empty -> B
            after 3 s / send Found, send Low -> B
          }
          state B { monitor "found" : std_msgs/Empty -> Done }
          final Done
        }
        """
    )
    transitions = [
        transition
        for state in system.machines[0].walk()
        for transition in state.transitions
        if not isinstance(transition.triggers[0], ir.TimeTrigger)
    ]

    assert [(event.name, event.incoming_topic) for event in system.events] == [
        ("Low", "battery"),
        ("Found", "bridge/events/found"),
        ("Found_", "found"),
    ]
    assert [transition.triggers for transition in transitions] == [
        (ir.EventTrigger(name),) for name in ("Low", "Found", "Found_", "Found_")
    ]


def test_a_constant_is_one_value_however_it_is_made(compiled: Compiled) -> None:
    # Written out, each would be twice as long as the one before.
    doubled = "".join(f"const D{n} : float64 = D{n - 1} + D{n - 1}\n" for n in range(1, 60))
    chain = "".join(f"const C{n} : int32 = C{n - 1} + 1\n" for n in range(1, 400))
    system = compiled(f"""{EVENT}
      enum Mode {{ OFF = 3, ON }}
      const D0 : float64 = 1.0
      {doubled}
      const C0 : int32 = 0
      {chain}
      const PAUSE : duration = 2 * 1.5 s
      const QUIET : bool = not (C1 > 0)
      const NAME : string = "a" + "b"
      const NEGATIVE : int32 = C1 - 3
      statemachine M {{
        param d : float64 = D59
        param c : int32 = C399
        param p : duration = PAUSE
        param q : bool = QUIET
        param s : string = NAME
        param n : int32 = -NEGATIVE
        initial A
        state A {{ on Go -> F }}
        final F
      }}
    """)

    values = {param.name: param.default for param in system.machines[0].params}
    assert values == {
        "d": ir.Literal(2.0**59, ir.Primitive("float64")),
        "c": ir.Literal(399, ir.Primitive("int64")),
        "p": ir.Literal(3_000_000_000, ir.Primitive("duration")),
        "q": ir.Literal(False, ir.Primitive("bool")),
        "s": ir.Literal("ab", ir.Primitive("string")),
        "n": ir.Literal(2, ir.Primitive("int64")),
    }


STANDARD = """
event Seen : geometry_msgs/PoseStamped
event Heard : lab/Unheard
message lab/Report { text : std_msgs/String }
event Told : lab/Report
endless statemachine Wait {
  var climbed : control_msgs/FollowJointTrajectoryFeedback
  initial A
  state A { on Seen, Heard, Told -> A }
}
"""


def test_interfaces_of_ros_are_in_the_system(compiled: Compiled) -> None:
    system = compiled(STANDARD)
    names = [str(each.type) for each in system.standard]
    pose = system.known_interface(ir.Named("geometry_msgs", "PoseStamped"))

    assert isinstance(pose, ir.Message)
    assert [field.name for field in pose.fields] == ["header", "pose"]
    assert names == sorted(names)
    assert {"geometry_msgs/Point", "std_msgs/Header", "std_msgs/String"} <= set(names)
    assert not {"lab/Report", "lab/Unheard"} & set(names)
    assert {"geometry_msgs", "std_msgs"} <= set(system.ros_packages)
    assert "lab" not in system.ros_packages


def test_what_the_model_describes_goes_before_what_ros_has(compiled: Compiled) -> None:
    system = compiled(STANDARD)
    report, unknown = ir.Named("lab", "Report"), ir.Named("lab", "Unheard")

    assert system.known_interface(report) is system.interface(report)
    assert system.interface(ir.Named("std_msgs", "String")) is None
    assert system.known_interface(unknown) is None


def test_a_service_and_an_action_may_share_a_name(compiled: Compiled) -> None:
    system = compiled(
        """
        function map : abstraction { service "map" : nav_msgs/GetMap }
        statemachine M { initial A; state A { do map; on succeeded, aborted -> B } final B }
        """
    )
    type_ = ir.Named("nav_msgs", "GetMap")
    for kind in (ir.Service, ir.Action):
        assert isinstance(system.known_interface(type_, kind), kind)


def test_connected_ports_are_groups_with_a_topic(compiled: Compiled) -> None:
    system = compiled(
        """
        sensor Camera { out image : std_msgs/String }
        controller Tracker { in view : std_msgs/String }
        member Uav {
          eye : Camera
          tracker : Tracker
          connect eye.image -> tracker.view
        }
        """
    )
    (uav,) = system.members

    assert [([str(port) for port in group.ports], group.topic) for group in uav.port_groups] == [
        (["eye.image", "tracker.view"], "image")
    ]


def test_what_is_derived_does_not_count_in_comparisons(compiled: Compiled) -> None:
    system = compiled(STANDARD)
    assert system.standard
    assert replace(system, standard=(), ros_packages=()) == system


def test_values_keep_their_names(compiled: Compiled) -> None:
    system = compiled("""
      enum Mode { MANUAL, AUTO = 4 }
      const LIMIT : float64  = 2.5
      const WAIT  : duration = 2 * 30 s
      endless statemachine M {
        var mode : Mode = Mode.AUTO
        var x    : float64 = LIMIT
        initial A
        state A {
          entry / x = -LIMIT, x = LIMIT + 1
          after WAIT [mode == Mode.MANUAL] -> A
        }
      }
    """)
    machine = machine_of(system, "M")
    mode, x = machine.variables
    assert mode.type == ir.Primitive("uint8")
    assert isinstance(mode.type, ir.Primitive)
    assert mode.type.enum == ir.Named("model", "Mode")
    assert mode.initial == ir.Literal(4, ir.INT)
    literals = [mode.initial, x.initial]
    (state,) = machine.walk()
    literals += [effect.value for effect in state.entry if isinstance(effect, ir.Assignment)]
    (transition,) = state.transitions
    assert transition.guard is not None
    found = [
        (part.value, part.name)
        for each in [*literals, transition.guard]
        if each is not None
        for part in ir.subexpressions(each)
        if isinstance(part, ir.Literal)
    ]
    assert found == [
        *((4, "Mode.AUTO"), (2.5, "LIMIT")),
        # A folded sign makes another value.
        *((-2.5, ""), (2.5, "LIMIT"), (1, ""), (0, "Mode.MANUAL")),
    ]
    (trigger,) = transition.triggers
    assert isinstance(trigger, ir.TimeTrigger)
    assert isinstance(trigger.delay, ir.Literal)
    assert trigger.delay.name == "WAIT"
