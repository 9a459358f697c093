"""Round trips of models: the examples, and constructs that only lowering makes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from swarmdsl.codegen.swarm_printer.system import UnprintableError, normalized, print_system
from swarmdsl.ir import Binary, Literal, Named, Service, State, StateMachine, System, Transition
from swarmdsl.syntax.types import FLOAT, INT

from .round_trip import compiled, printed_and_compiled

ROOT = Path(__file__).resolve().parents[2]
MODELS = [
    *(path for path in sorted((ROOT / "examples").iterdir()) if path.is_dir()),
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
]

REUSE = """
event Go : std_msgs/Int32
statemachine Wait {
  param delay : duration
  param limit : int32 = 3
  param unused : string
  var tries : int32 = 0
  var spare : float64
  initial Try
  state Try {
    after (delay / 2) [tries < -limit] / tries = tries + limit -> Try
    on Go / tries = event.data -> End
  }
  final End
}
statemachine Middle {
  param pause : duration = 2 s
  var tries : int32 = 1
  initial First
  state First = Wait(delay = pause + 1 s, limit = tries, unused = "a") {
    entry / tries = 2
    on done.End -> Second
  }
  state Second = Wait(delay = pause, unused = "b") { on done -> End }
  final End
}
endless statemachine Outer {
  var first_tries : int32
  initial Both
  parallel state Both {
    region Left { initial M; state M = Middle { on done -> E } final E }
    region Right { initial M; state M = Middle(pause = 5 min) { on done -> E } final E }
    on done -> Third
  }
  state Third { initial W; state W = Wait(delay = 1 us, unused = "c", limit = first_tries) }
}
"""

PARTS = """
package lib
enum Mode : int8 { Idle = -2, Busy, Off = 7 }
struct Pose { x : float64, mode : Mode[<=4] }
event Foo : std_msgs/Int32 on "foo"
const Limit : float64 = 3
function off : swarm { service "off" : std_srvs/Empty }
sensor Cam {
  out at : Pose
  param rate : float64 = Limit
  operation zoom(in level : float64, out ok : bool)
}
"""

MISSION = """
/// The mission.
///
///   With an indented line.
package mission.first
import "parts.swarm"
struct Pose { inner : lib.Pose }
event Foo : std_msgs/Int32 on "bar"
function land : abstraction { service "land" : std_srvs/Empty }
sensor Cam extends lib.Cam { param rate : float64 = -1; operation look(
  /// Where to.
  in at : Pose) }
sensor Eye extends Cam { param rate : float64 = 9 }
member Bot {
  behavior Work
  param speed : float64
  cam : Eye { rate = speed * (2 + Limit) - -3 }
}
member Fast extends Bot { param speed : float64 = 1e300 }
member Slow { behavior Work; param speed : float64 = 2; param limit : int32 = 7 }
endless statemachine Work {
  param limit : int32 = 4
  var mode : Mode = Mode.Busy
  initial A
  state A {
    do Cam.zoom(level = 3)
    on succeeded, aborted [mode == Mode.Idle] / mode = Mode.Off -> B
    on succeeded, aborted -> B
  }
  state B {
    on Foo, lib.Foo [event.data > limit or speed > -Limit] -> A
    monitor "some/topic" : std_msgs/Int8 [event.data < 0] -> A
    after 0.0015 us -> A
  }
}
"""


def machine_of(system: System, name: str) -> StateMachine:
    return next(machine for machine in system.machines if machine.name == name)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_models_mean_the_same_as_their_text(model: Path, tmp_path: Path) -> None:
    system = compiled(model)

    assert printed_and_compiled(system, tmp_path) == normalized(system)


def test_machines_that_reuse_others_say_so(tmp_path: Path) -> None:
    system = _system(tmp_path, REUSE)
    text = print_system(system)

    assert normalized(system) == system
    assert printed_and_compiled(system, tmp_path) == system
    assert "state First = Wait(delay = pause + 1 s, limit = tries, unused = " in text
    assert "state M = Middle {" in text
    assert "state M = Middle(pause = 5 min) {" in text
    assert text.count("var ") == 4  # none of those that came with a reused machine


def test_what_is_not_as_lowering_puts_it_in_place_is_printed_as_states(tmp_path: Path) -> None:
    system = _system(tmp_path, REUSE)
    *others, outer = system.machines
    odd = replace(outer, variables=tuple(replace(each, doc="Changed.") for each in outer.variables))
    system = replace(system, machines=(*others, odd))
    states = list(machine_of(normalized(system), "Outer").walk())

    assert {state.submachine for state in states} == {None}
    assert [state.id for state in states] == [state.id for state in outer.walk()]
    assert machine_of(normalized(system), "Middle") == machine_of(system, "Middle")
    assert printed_and_compiled(system, tmp_path) == normalized(system)


def test_several_packages_become_one(tmp_path: Path) -> None:
    (tmp_path / "parts.swarm").write_text(PARTS, encoding="utf-8")
    system = _system(tmp_path, MISSION)
    normal = normalized(system)
    known = [each.type for each in normal.interfaces]

    assert printed_and_compiled(system, tmp_path) == normal
    assert {type_.package for type_ in known} == {"mission_first"}
    assert {"Pose", "lib_Pose", "Mode"} <= {type_.name for type_ in known}
    assert normalized(normal) == normal


def test_a_value_that_must_be_given_is_a_param_of_the_member(tmp_path: Path) -> None:
    (tmp_path / "parts.swarm").write_text(PARTS, encoding="utf-8")
    system = _system(tmp_path, MISSION)
    params = {each.name: [param.name for param in each.params] for each in system.members}
    normal = {
        each.name: [param.name for param in each.params] for each in normalized(system).members
    }

    assert params == {"Bot": ["speed"], "Fast": ["speed"], "Slow": ["speed", "limit"]}
    # `Slow` has a limit of its own, so that the behaviour as such has none.
    assert normal == {**params, "Bot": ["speed", "limit"], "Fast": ["speed", "limit"]}


def test_numbers_of_enums_and_of_constants_are_plain_numbers(tmp_path: Path) -> None:
    (tmp_path / "parts.swarm").write_text(PARTS, encoding="utf-8")
    system = _system(tmp_path, MISSION)
    (mode,) = [each for each in system.interfaces if each.type.name == "Mode"]
    work = machine_of(system, "Work")
    guard = work.states[1].transitions[0].guard

    assert [constant.value for constant in mode.constants] == [
        Literal(-2, INT),
        Literal(-1, INT),
        Literal(7, INT),
    ]
    assert work.variables[0].initial == Literal(-1, INT)
    assert isinstance(guard, Binary)
    assert guard.right.right == Literal(-3, INT)  # type: ignore[union-attr]


def test_the_type_of_an_operation_is_that_of_what_stands_there(tmp_path: Path) -> None:
    system = _system(
        tmp_path,
        """
        statemachine Inner {
          param height : float64
          var up : float64
          initial A
          state A { entry / up = height + 1; on done -> E }
          final E
        }
        statemachine Outer {
          var steps : int32
          initial S
          state S = Inner(height = steps) { on done -> E }
          final E
        }
        """,
    )
    inner, outer = (each.states[0] for each in system.machines)

    assert inner.entry[0].value.type == FLOAT  # type: ignore[union-attr]
    assert outer.states[0].entry[0].value.type == INT  # type: ignore[union-attr]


def test_a_file_without_package_keeps_its_name(tmp_path: Path) -> None:
    path = tmp_path / "my-model.swarm"
    path.write_text("struct Pose { x : float64 }", encoding="utf-8")
    system = compiled(path)

    assert system.interfaces[0].type == Named("my-model", "Pose")
    assert print_system(system) == "message Pose {\n  x : float64\n}\n"


def test_what_is_called_like_a_type_of_the_language(tmp_path: Path) -> None:
    text = "package p\nstruct string { x : float64 }\nmessage Use { a : p/string, b : string }"
    system = _system(tmp_path, text)

    assert "a : p/string\n  b : string\n" in print_system(system)
    assert printed_and_compiled(system, tmp_path) == system


def test_what_is_inherited_is_not_said_again(tmp_path: Path) -> None:
    (tmp_path / "parts.swarm").write_text(PARTS, encoding="utf-8")
    text = print_system(_system(tmp_path, MISSION))

    assert "sensor Eye extends mission_first_Cam {\n  param rate : float64 = 9\n}\n" in text
    assert "member Fast extends Bot {\n  param speed : float64 = 1e+300\n}\n" in text


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (Transition((), None, (), None), "waits for nothing"),
        (Transition((), Literal(float("inf"), FLOAT), (), "B"), "inf"),
    ],
)
def test_what_no_model_says_has_no_text(change: Transition, reason: str, tmp_path: Path) -> None:
    system = _system(
        tmp_path,
        """
        event Go : std_msgs/Empty
        function f : swarm { service "f" : std_srvs/Empty }
        endless statemachine M {
          initial A
          state A { do f; on succeeded, aborted -> B }
          state B { on Go -> A }
        }
        """,
    )
    (machine,) = system.machines
    first: State = replace(machine.states[0], transitions=(change,))
    system = replace(system, machines=(replace(machine, states=(first, *machine.states[1:])),))

    with pytest.raises(UnprintableError, match=reason):
        print_system(system)


def _system(folder: Path, text: str) -> System:
    path = folder / "model.swarm"
    path.write_text(text, encoding="utf-8")
    return compiled(path)


def test_parameters_of_operations_are_called_by_any_word(tmp_path: Path) -> None:
    path = tmp_path / "maps.swarm"
    path.write_text(
        """
        virtual Map {
          operation move(in : int32, out : int32, in to : int32, out state : uint8)
          operation put(on : int32, in in : string, out out : uint8, out from : uint8)
          operation ask(in /* where */ : int32, out
            on : uint8)
        }
        statemachine M {
          var value : uint8
          initial A
          state A {
            do Map.put(on = 3, in = "x") gives (out => value, from => value)
            on succeeded [value > 3] -> F
            on succeeded, aborted -> F
          }
          final F
        }
        """,
        encoding="utf-8",
    )
    system = compiled(path)
    services = {
        service.type.name: ([f.name for f in service.request], [f.name for f in service.response])
        for service in system.interfaces
        if isinstance(service, Service)
    }

    assert services == {
        "MapMove": (["in", "out", "to"], ["state"]),
        "MapPut": (["on", "in"], ["out", "from"]),
        "MapAsk": (["in"], ["on"]),
    }
    assert printed_and_compiled(system, tmp_path) == normalized(system)
