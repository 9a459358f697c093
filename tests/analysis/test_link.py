"""Resolution of names in a file, across files and inside a state machine."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Connector,
    DoneTrigger,
    Event,
    EventTrigger,
    Field,
    Initial,
    NameUse,
    Node,
    Param,
    Region,
    State,
    StateMachine,
    Transition,
    Variable,
    walk,
)
from swarmdsl.syntax.types import Array, Named, Primitive, Type

Linked = Callable[..., Project]
EVENT = "event Go : std_msgs/Empty\n"


def nodes(project: Project) -> list[Node]:
    return [node for file in project.files for node in walk(file.model)]


def targets(project: Project) -> list[str]:
    """Return the targets of transitions: the line of the state's declaration."""
    found = []
    for node in nodes(project):
        if isinstance(node, Transition):
            assert node.target.target is not None
            found.append(f"{node.target.name}:{node.target.target.name.span.line}")
    return found


# ---- across files


def test_an_own_declaration_wins_over_an_imported_one(linked: Linked) -> None:
    project = linked(
        'import "other.swarm"\nevent Go : std_msgs/Int32\nstatemachine M { initial A; '
        "state A { on Go -> F; on other.Go -> F } final F }",
        other="event Go : std_msgs/Empty",
    )
    events = [node.event.target for node in nodes(project) if isinstance(node, EventTrigger)]

    assert [event.type.name for event in events if event] == ["std_msgs/Int32", "std_msgs/Empty"]


def test_a_qualified_name_means_the_files_own_package_too(linked: Linked) -> None:
    project = linked(
        "package a.b\nevent Go : std_msgs/Empty\n"
        "statemachine M { initial A; state A { on a.b.Go -> F } final F }"
    )
    (trigger,) = [node for node in nodes(project) if isinstance(node, EventTrigger)]

    assert isinstance(trigger.event.target, Event)


@pytest.mark.parametrize(
    ("written", "type_"),
    [
        ("float64", Primitive("float64")),
        ("geometry_msgs/Pose[]", Array(Named("geometry_msgs", "Pose"))),
        ("uint8[16]", Array(Primitive("uint8"), 16)),
        ("Point", Named("main", "Point")),
        ("Metres", Primitive("float32")),
        ("Metres[3]", Array(Primitive("float32"), 3)),
        ("Row", Array(Primitive("float32"), 2)),
        ("Far", Named("other_package", "Far")),
    ],
)
def test_types(linked: Linked, written: str, type_: Type) -> None:
    project = linked(
        f'import "other.swarm"\nstruct Wanted {{ it : {written} }}\n'
        "type Row = Length[2]\ntype Metres = Length\nstruct Point { }\ntype Length = float32\n",
        other="package other.package\nstruct Far { }",
    )
    field = next(node for node in nodes(project) if isinstance(node, Field))

    assert field.type.type == type_


# ---- inside a machine

NESTED = f"""{EVENT}
statemachine M {{
  initial A
  state A {{
    initial B
    state B {{ on Go -> C; on Go -> D; on Go -> A; on Go -> A.C.E; on Go -> Out }}
    state C {{
      initial E
      state E {{ on Go -> E }}
      state D
    }}
    state D
    on Go -> B
    on Go -> Out
  }}
  state D
  choice Q {{ else -> D }}
  final Out
}}
"""


def test_states_are_looked_for_beside_then_outwards_then_inside(linked: Linked) -> None:
    assert targets(linked(NESTED)) == [
        *("C:8", "D:13", "A:5", "A.C.E:10", "Out:19"),
        *("E:10", "B:7", "Out:19"),
    ]


def test_an_initial_state_is_looked_for_inside_only(linked: Linked) -> None:
    initials = [node.target.target for node in nodes(linked(NESTED)) if isinstance(node, Initial)]

    assert [target and str(target.name) for target in initials] == ["A", "B", "E"]


REGIONS = f"""{EVENT}
statemachine M {{
  initial P
  parallel state P {{
    region Left {{
      initial On
      state On {{ on Go -> Off; on Go -> End }}
      final Off
    }}
    region Right {{
      initial End
      final End
    }}
    on Left.done     -> End
    on Left.done.Off -> P.Off
  }}
  final End
}}
"""


def test_a_state_outside_wins_over_one_in_another_region(linked: Linked) -> None:
    assert targets(linked(REGIONS)) == ["Off:9", "End:18", "End:18", "P.Off:9"]


def test_done_of_a_region(linked: Linked) -> None:
    triggers = [node for node in nodes(linked(REGIONS)) if isinstance(node, DoneTrigger)]
    first, second = triggers

    assert isinstance(first.region and first.region.target, Region)
    assert second.final is not None
    assert second.final.target is not None
    assert second.final.target.name.span.line == 9


def test_done_of_a_submachine(linked: Linked) -> None:
    project = linked(
        "statemachine M { initial A; state A = N { on done.Lost -> F } final F }\n"
        "statemachine N { initial Lost; final Lost }"
    )
    trigger = next(node for node in nodes(project) if isinstance(node, DoneTrigger))
    state = next(node for node in nodes(project) if isinstance(node, State))

    assert trigger.final is not None
    assert trigger.final.target is not None
    assert state.machine is not None
    assert isinstance(state.machine.target, StateMachine)


# ---- values and ports


def test_values_are_those_of_the_machine_and_of_the_members_that_behave_so(linked: Linked) -> None:
    project = linked(
        f"{EVENT}statemachine M {{ var x : int8; param y : int8 = 1; initial A\n"
        "state A { on Go [x < y and y < z] -> F } final F }\n"
        "member R { behavior M; param z : int8 = 3; param y : int8 = 2 }"
    )
    uses = {node.name: node.target for node in nodes(project) if isinstance(node, NameUse)}

    assert isinstance(uses["x"], Variable)
    assert isinstance(uses["y"], Param)
    assert isinstance(uses["z"], Param)
    assert [uses[name] and uses[name].name.span.line for name in "xyz"] == [2, 2, 4]


def test_ends_of_connectors(linked: Linked) -> None:
    project = linked(
        "sensor Camera { out image : a/B }\nactuator Screen { in image : a/B }\n"
        "member M {\n in order : a/B\n camera : Camera\n screen : Screen\n"
        " connect camera.image -> screen.image\n connect order -> screen.image\n}"
    )
    ends = [
        (end.part and end.part.name, end.port.target and end.port.target.name.span.line)
        for node in nodes(project)
        if isinstance(node, Connector)
        for end in (node.source, node.target)
    ]

    assert ends == [("camera", 1), ("screen", 2), (None, 4), ("screen", 2)]
