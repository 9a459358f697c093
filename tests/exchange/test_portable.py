"""The portable profile: output of constructs, and runs in a third-party engine."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from lxml import etree

from swarmdsl.ir import System

Compile = Callable[[str], System]
Emit = Callable[..., dict[str, str]]
Walk = Callable[..., list[set[str]]]

S = "{http://www.w3.org/2005/07/scxml}"
SW = "{urn:swarmdsl:scxml}"


@pytest.fixture
def written(compiled: Compile, emit: Emit) -> Callable[..., str]:
    """Return the portable document of a machine `M` with the given body."""

    def written(body: str, others: str = "", kind: str = "statemachine") -> str:
        return emit(compiled(f"{others}\n{kind} M {{\n{body}\n}}"))["M.scxml"]

    return written


@pytest.fixture
def parsed(written: Callable[..., str]) -> Callable[..., Any]:
    """Return the same as a tree."""

    def parsed(*arguments: str) -> Any:
        return etree.fromstring(written(*arguments).encode())

    return parsed


def by_id(tree: Any, name: str) -> Any:
    return tree.xpath(f"//*[@id='{name}']")[0]


def transitions(element: Any) -> list[tuple[str | None, str | None, str | None]]:
    return [
        (t.get("event"), t.get("cond"), t.get("target")) for t in element.findall(f"{S}transition")
    ]


def test_a_machine_without_data_needs_no_data_model(parsed: Any) -> None:
    tree = parsed("initial A; state A { do go; on succeeded, aborted -> B } final B")

    assert tree.get("datamodel") == "null"
    assert tree.get("initial") == "A"
    assert tree.find(f"{S}datamodel") is None
    assert transitions(by_id(tree, "A")) == [
        ("do.A.succeeded do.A.aborted do.A.preempted", None, "B")
    ]
    assert by_id(tree, "B").tag == f"{S}final"


def test_data_have_the_first_values_that_ros_gives_them(parsed: Any) -> None:
    tree = parsed(
        """
        param limit : int32
        param pause : duration = 1 min
        var a : int32; var b : bool; var c : string = "x"; var d : Report; var e : float64[2]
        var f : geometry_msgs/Vector3; var g : uav_msgs/Unheard
        initial A; state A { on Start -> A }
        """,
        "",
        "endless statemachine",
    )
    values = {data.get("id"): data.get("expr") for data in tree.iter(f"{S}data")}

    assert tree.get("datamodel") == "ecmascript"
    assert values == {
        "limit": None,
        "pause": "60000",
        "a": "0",
        "b": "false",
        "c": '"x"',
        "d": '({"id": "", "level": 0})',
        "e": "[0, 0]",
        "f": '({"x": 0, "y": 0, "z": 0})',
        "g": "({})",
    }


def test_expressions_are_ecmascript(parsed: Any) -> None:
    tree = parsed(
        """
        var n : int32; var xs : float64[]; var ok : bool
        initial A
        state A {
          on Found [not (event.level > 3 and ok) or len(xs) == 2 and sqrt(n) < 1.5]
            / n = max(n, event.level) - 1 -> A
          on Start -> B
        }
        final B
        """
    )
    (taken,) = [t for t in by_id(tree, "A").findall(f"{S}transition") if t.get("cond")]

    assert taken.get("cond") == (
        "!(_event.data.level > 3 && ok) || xs.length == 2 && "
        "(function (a) { return a >= 0 ? Math.sqrt(a) : null.value; })(n) < 1.5"
    )
    (assign,) = taken.findall(f"{S}assign")
    assert dict(assign.attrib) == {"location": "n", "expr": "Math.max(n, _event.data.level) - 1"}


def test_what_has_no_value_has_none_in_ecmascript(parsed: Any) -> None:
    tree = parsed(
        """
        var n : int32 = 3; var x : float64
        initial A
        state A { on Start / x = n / 4, x = 4 / n, n = 7 % n, n = n % 7 -> A }
        """,
        "",
        "endless statemachine",
    )

    assert [assign.get("expr") for assign in tree.iter(f"{S}assign")] == [
        "n / 4",
        "(function (a, b) { return b != 0 ? a / b : null.value; })(4, n)",
        "(function (a, b) { return b != 0 ? ((a % b) + b) % b : null.value; })(7, n)",
        "((n % 7) + 7) % 7",
    ]


def test_names_that_ecmascript_keeps_are_changed(parsed: Any) -> None:
    tree = parsed(
        "var class : int32; var _x : int32; initial A; "
        "state A { on Start [class == _x] -> B } final B"
    )

    assert [data.get("id") for data in tree.iter(f"{S}data")] == ["data_class", "data__x"]
    assert transitions(by_id(tree, "A")) == [("Start", "data_class == data__x", "B")]
    assert [v.get("name") for v in tree.findall(f"{SW}variable")] == ["class", "_x"]


def test_names_of_states_are_unique_in_the_file(parsed: Any) -> None:
    tree = parsed(
        """
        var Wait : int32
        initial P
        parallel state P {
          region L { initial Idle; state Idle { on Start -> End } final End }
          region R { initial Idle; state Idle { on Abort -> End } final End }
          on done -> Wait
        }
        state Wait { on Start [Wait > 0] -> Stop }
        final Stop
        """
    )

    ids = [element.get("id") for element in tree.iter() if element.get("id")]
    assert len(ids) == len(set(ids))
    assert not [name for name in ids if "." in name]
    assert transitions(by_id(tree, "P-L-Idle")) == [("Start", None, "P-L-End")]
    assert transitions(by_id(tree, "P-R-Idle")) == [("Abort", None, "P-R-End")]
    assert transitions(by_id(tree, "P")) == [("done.state.P", None, "Wait-state")]


def test_states_of_one_name_are_told_apart_when_it_runs(written: Any, walk: Walk) -> None:
    document = written(
        """
        initial P
        parallel state P {
          region L {
            initial Work
            state Work { do go; on succeeded -> End; on aborted -> Work }
            final End
          }
          region R {
            initial Work
            state Work { do go; on succeeded -> End; on aborted -> Work }
            final End
          }
          on done -> Stop
        }
        final Stop
        """
    )

    first, second, third = walk(document, ["do.P-R-Work.succeeded", "do.P-L-Work.succeeded"])

    assert first == {"P", "L", "R", "P-L-Work", "P-R-Work"}
    assert second == {"P", "L", "R", "P-L-Work", "P-R-End"}
    assert third == {"Stop"}


def test_a_choice_takes_the_first_branch_that_holds(written: Any, walk: Walk) -> None:
    document = written(
        """
        var n : int32 = 0
        initial A
        state A { on Found / n = event.level -> Which }
        choice Which {
          [n > 5]          -> High
          [n > 2] / n = 99 -> Middle
          else             -> A
        }
        state Middle { on Start [n == 99] -> A }
        final High
        """
    )

    assert walk(document, [("Found", {"level": 1}), ("Found", {"level": 4}), "Start"]) == [
        {"A"},
        {"A"},
        {"Middle"},
        {"A"},
    ]
    assert walk(document, [("Found", {"level": 6})])[-1] == {"High"}


def test_an_inner_transition_comes_before_an_outer_one(written: Any, walk: Walk) -> None:
    document = written(
        """
        initial Outer
        state Outer {
          initial A
          state A { on Start -> B }
          state B { on Abort -> End }
          final End
          on Start, Abort -> Stop
          on done         -> Stop
        }
        final Stop
        """
    )

    assert walk(document, ["Start", "Start"]) == [{"Outer", "A"}, {"Outer", "B"}, {"Stop"}]
    assert walk(document, ["Start", "Abort"])[-1] == {"Stop"}


def test_a_transition_across_levels(written: Any, walk: Walk) -> None:
    document = written(
        """
        initial Out
        state Out {
          initial In
          state In { initial A; state A { on Start -> Stop; on Abort -> B } final E }
          state B { on Start -> F }
          final F
          on done -> Stop
        }
        final Stop
        """
    )

    assert walk(document, ["Abort", "Start"]) == [{"Out", "In", "A"}, {"Out", "B"}, {"Stop"}]
    assert walk(document, ["Start"])[-1] == {"Stop"}


FINALS = """
    initial Try
    state Try {
      initial Work
      state Work { do go; on succeeded -> Good; on aborted -> Bad }
      final Good
      final Bad
      on done.Bad -> Try
      on done     -> Stop
    }
    final Stop
"""


def test_which_final_state_was_reached(parsed: Any) -> None:
    tree = parsed(FINALS)

    assert transitions(by_id(tree, "Try")) == [
        ("final.Bad", None, "Try"),
        ("final.Good final.Bad", None, "Stop"),
    ]
    for name in ("Good", "Bad"):
        (raised,) = by_id(tree, name).iterfind(f"{S}onentry/{S}raise")
        assert raised.get("event") == f"final.{name}"
    assert by_id(tree, "Stop").find(f"{S}onentry") is None


def test_a_completion_counts_once(written: Any, walk: Walk) -> None:
    """A `done` that led back in must not trigger again from the queue."""
    document = written(FINALS)

    assert walk(document, ["do.Work.aborted", "do.Work.aborted", "do.Work.succeeded"]) == [
        {"Try", "Work"},
        {"Try", "Work"},
        {"Try", "Work"},
        {"Stop"},
    ]


NESTED = """
    initial Outer
    parallel state Outer {
      region Left {
        initial Inner
        parallel state Inner {
          region A { initial A1; state A1 { do go; on succeeded -> A2; on aborted -> A1 } final A2 }
          region B { initial B1; state B1 { do go; on succeeded -> B2; on aborted -> B1 } final B2 }
          on done -> LeftEnd
        }
        final LeftEnd
      }
      region Right { initial R1; state R1 { do go; on succeeded -> R2; on aborted -> R1 } final R2 }
      on done -> Stop
    }
    final Stop
"""


def test_params_have_the_values_of_the_parts_that_run_the_machine(parsed: Any) -> None:
    tree = parsed(
        "param period : duration; initial On; state On { after period -> On }",
        "virtual Beacon { param period : duration = 250 ms; behavior M }\n"
        "member Tug { beacon : Beacon { period = 2 s } }",
        "endless statemachine",
    )

    assert [data.get("expr") for data in tree.iter(f"{S}data") if data.get("id") == "period"] == [
        "2000"
    ]


@pytest.mark.parametrize("order", [["A1", "B1", "R1"], ["R1", "A1", "B1"], ["B1", "R1", "A1"]])
def test_nested_parallel_states_end_in_any_order(
    written: Any, walk: Walk, order: list[str]
) -> None:
    active = walk(written(NESTED), [f"do.{state}.succeeded" for state in order])

    assert active[-1] == {"Stop"}
    assert all("Outer" in states for states in active[:-1])


def test_one_region_can_end_the_parallel_state(written: Any, walk: Walk) -> None:
    document = written(
        """
        initial P
        parallel state P {
          region Work {
            initial W
            state W { do go; on succeeded -> W; on aborted -> Lost }
            final Lost
          }
          region Watch {
            initial Ok
            state Ok { on Low -> Empty; on Abort -> Told }
            final Empty
            final Told
          }
          on Work.done        -> P
          on Watch.done.Told  -> Stop
          on Watch.done.Empty -> Home
        }
        state Home { do land; on succeeded, aborted -> Stop }
        final Stop
        """
    )

    assert walk(document, ["do.W.succeeded", "Low"])[-1] == {"Home"}
    assert walk(document, ["Abort"])[-1] == {"Stop"}
    assert walk(document, ["do.W.aborted"])[-1] == {"P", "Work", "W", "Watch", "Ok"}


def test_time_is_sent_on_entry_and_cancelled_on_exit(parsed: Any) -> None:
    tree = parsed(
        """
        param pause : duration = 2 s
        var n : int32
        initial A
        state A {
          after 1.5 s [n > 3] -> A
          after 1.5 s         -> B
          after pause         -> B
          after 300 us        -> B
        }
        final B
        """
    )
    state = by_id(tree, "A")
    sent = [dict(send.attrib) for send in state.iterfind(f"{S}onentry/{S}send")]

    assert sent == [
        {"event": "after.A.1", "id": "after.A.1", "delay": "1500ms"},
        {
            "event": "after.A.2",
            "id": "after.A.2",
            "delayexpr": 'Math.max(0, Math.ceil(pause)) + "ms"',
        },
        {"event": "after.A.3", "id": "after.A.3", "delay": "1ms"},
    ]
    cancelled = [cancel.get("sendid") for cancel in state.iterfind(f"{S}onexit/{S}cancel")]
    assert cancelled == ["after.A.1", "after.A.2", "after.A.3"]
    assert [event for event, *_ in transitions(state)] == [
        "after.A.1",
        "after.A.1",
        "after.A.2",
        "after.A.3",
    ]


def test_time_passes(written: Any, walk: Walk) -> None:
    document = written("initial A; state A { after 20 ms -> B } final B")

    # The engine waits in `send` until all that was delayed has come.
    assert walk(document, ["Start"])[-1] == {"B"}


def test_an_event_is_sent_to_the_swarm(parsed: Any) -> None:
    tree = parsed(
        """
        var n : int32
        initial A
        state A { on Start / send Found(id = "a", level = n + 1) -> B }
        final B
        """
    )
    (send,) = tree.iter(f"{S}send")

    assert dict(send.attrib) == {"event": "Found", "type": "urn:swarmdsl:swarm"}
    assert [dict(param.attrib) for param in send] == [
        {"name": "id", "expr": '"a"'},
        {"name": "level", "expr": "n + 1"},
    ]
    assert [event.get("name") for event in tree.findall(f"{SW}event")] == ["Start", "Found"]


def test_a_result_is_stored_before_what_follows(parsed: Any) -> None:
    body = """
        var n : int32; var r : Report
        initial A
        state A {
          do drive(speed = 1.0, name = "x") gives (count => n, name => r.id)
          on succeeded / n = n + 1 -> B
          on aborted               -> A
        }
        state B { on Start [n == 8] -> C }
        final C
    """
    taken = by_id(parsed(body), "A").find(f"{S}transition")

    assert [(a.get("location"), a.get("expr")) for a in taken] == [
        ("n", "_event.data.count"),
        ("r.id", "_event.data.name"),
        ("n", "n + 1"),
    ]


def test_a_guard_sees_the_result(parsed: Any, written: Any, walk: Walk) -> None:
    body = """
        var n : int32 = 0
        initial A
        state A {
          do go gives (count => n)
          on succeeded [n > 3] -> B
          on succeeded, aborted -> C
        }
        final B
        final C
    """

    assert transitions(by_id(parsed(body), "A")) == [
        ("do.A.succeeded", None, None),
        ("gives.A.succeeded", "n > 3", "B"),
        ("gives.A.succeeded do.A.aborted do.A.preempted", None, "C"),
    ]
    document = written(body)
    assert walk(document, [("do.A.succeeded", {"count": 5})])[-1] == {"B"}
    assert walk(document, [("do.A.succeeded", {"count": 2})])[-1] == {"C"}
    assert walk(document, ["do.A.aborted"])[-1] == {"C"}


def test_what_is_of_ros_stands_in_a_namespace_of_its_own(parsed: Any) -> None:
    tree = parsed(
        """
        var n : int32; var s : string
        initial A
        /// Go -- and come back.
        state A { do drive(speed = 1.5, name = s) gives (count => n); on succeeded, aborted -> B }
        state B { do ask(by make_request) gives by on_answer; on succeeded, aborted -> C }
        state C { do land; on succeeded, aborted -> D }
        final D
        """
    )

    (function, *_) = tree.findall(f"{SW}function")
    assert dict(function.attrib) == {
        "name": "drive",
        "category": "abstraction",
        "paradigm": "action",
        "server": "cmd/drive",
        "type": "test/Drive",
    }
    state = by_id(tree, "A")
    assert state.findtext(f"{SW}doc") == "Go -- and come back."
    (activity,) = state.findall(f"{SW}activity")
    assert activity.get("function") == "drive"
    assert [[part.tag.removeprefix(SW), part.get("policy")] for part in activity] == [
        ["goal", "userdata"],
        ["result", "userdata"],
    ]
    assert [dict(item.attrib) for part in activity for item in part] == [
        {"field": "speed", "expr": "1.5"},
        {"field": "name", "expr": "s"},
        {"field": "count", "location": "n"},
    ]
    callbacks = [dict(part.attrib) for part in by_id(tree, "B").find(f"{SW}activity")]
    assert callbacks == [
        {"policy": "callback", "callback": "make_request"},
        {"policy": "callback", "callback": "on_answer"},
    ]
    empty = [dict(part.attrib) for part in by_id(tree, "C").find(f"{SW}activity")]
    assert empty == [{"policy": "empty"}, {"policy": "empty"}]
    assert not list(tree.iter(f"{S}invoke"))


def test_a_machine_that_reuses_another(written: Any, parsed: Any, walk: Walk) -> None:
    others = """
        statemachine Insist {
          param limit : int32 = 2
          var tries : int32 = 0
          initial Try
          state Try {
            do ask(times = 1)
            on succeeded                                   -> Ok
            on aborted [tries < limit] / tries = tries + 1 -> Try
            on aborted                                     -> Failed
          }
          final Ok
          final Failed
        }
    """
    body = """
        initial First
        state First = Insist { on done.Ok -> Second; on done.Failed -> Bad }
        state Second = Insist { on done -> Good }
        final Good
        final Bad
    """
    submachines = [element.get("name") for element in parsed(body, others).iter(f"{SW}submachine")]

    assert submachines == ["Insist", "Insist"]
    document = written(body, others)
    assert walk(document, ["do.First-Try.succeeded"])[-1] == {"Second", "Second-Try"}
    failing = walk(document, ["do.First-Try.aborted"] * 3)
    assert failing == [{"First", "First-Try"}] * 3 + [{"Bad"}]


def test_the_file_is_text_for_people(written: Any) -> None:
    document = written("initial A\n/// Ä > B\nstate A { on Start -> B } final B")

    assert document.startswith('<?xml version="1.0" encoding="UTF-8"?>\n<scxml ')
    assert "\n    <sw:doc>Ä &gt; B</sw:doc>\n" in document
    assert document.endswith("</scxml>\n")


RESUMED = """
    initial Work
    state Work {
      initial First
      state First { on Start -> Second }
      state Second {
        initial Low1
        state Low1 { on Start -> Low2 }
        state Low2 { on Start -> Low1 }
      }
      HISTORY Back -> First
      on Abort -> Pause
      on Found -> Pause
    }
    state Pause { on Start -> Work.Back; on Abort -> Work }
"""


def test_a_history_is_one_with_a_default(parsed: Any, written: Any) -> None:
    for kind, depth in (("history", "shallow"), ("deep history", "deep")):
        tree = parsed(RESUMED.replace("HISTORY", kind), "", "endless statemachine")
        back = by_id(tree, "Back")

        assert back.tag == f"{S}history"
        assert dict(back.attrib) == {"id": "Back", "type": depth}
        assert transitions(back) == [(None, None, "First")]
        assert back.getparent().get("initial") == "First"
        assert transitions(by_id(tree, "Pause")) == [
            ("Start", None, "Back"),
            ("Abort", None, "Work"),
        ]


@pytest.mark.parametrize(
    ("kind", "resumed"),
    [
        ("history", {"Work", "Second", "Low1"}),
        ("deep history", {"Work", "Second", "Low2"}),
    ],
)
def test_a_history_leads_back(written: Any, walk: Walk, kind: str, resumed: set[str]) -> None:
    document = written(RESUMED.replace("HISTORY", kind), "", "endless statemachine")

    active = walk(document, ["Start", "Start", "Abort", "Start"])
    assert active[2:] == [{"Work", "Second", "Low2"}, {"Pause"}, resumed]
    assert walk(document, ["Start", "Abort", "Abort"])[-1] == {"Work", "First"}


def test_a_history_that_remembers_nothing_yet(written: Any, walk: Walk) -> None:
    document = written(
        """
        initial Pause
        state Pause { on Start -> Work.Back }
        state Work {
          initial First
          state First { on Start -> Second }
          state Second { on Start -> End }
          final End
          history Back -> Second
          on done -> Stop
        }
        final Stop
        """
    )

    assert walk(document, ["Start"])[-1] == {"Work", "Second"}


def test_effects_on_entry_and_exit(parsed: Any) -> None:
    tree = parsed(
        """
        var n : int32
        initial A
        state A {
          entry / n = 1, send Start
          exit  / send Found(level = n)
          after n * 1 s -> B
        }
        final B
        """
    )
    state = by_id(tree, "A")

    # What a delay is computed from is stored before it starts.
    entered = [[item.tag[len(S) :] for item in e] for e in state.findall(f"{S}onentry")]
    assert entered == [["assign", "send"], ["send"]]
    left = [[item.tag[len(S) :] for item in e] for e in state.findall(f"{S}onexit")]
    assert left == [["cancel"], ["send"]]
    events = [send.get("event") for send in state.iter(f"{S}send")]
    assert events == ["Start", "after.A.1", "Found"]
    assert [event.get("name") for event in tree.findall(f"{SW}event")] == ["Start", "Found"]


def test_a_machine_with_nothing_but_such_effects_needs_a_data_model(parsed: Any) -> None:
    sent = "initial A; state A { entry / send Found(level = 1); on Start -> B } final B"
    plain = "initial A; state A { exit / send Start; on Start -> B } final B"
    timed = "initial A; state A { after 2 * 500 ms -> B } final B"

    assert parsed(sent).get("datamodel") == "ecmascript"
    assert parsed(timed).get("datamodel") == "ecmascript"
    assert parsed(plain).get("datamodel") == "null"


def test_effects_happen_when_states_are_entered_and_left(written: Any, walk: Walk) -> None:
    document = written(
        """
        var entered : int32 = 0
        var left : int32 = 0
        initial Out
        state Out {
          entry / entered = entered + 1
          exit  / left = left + 1
          initial A
          state A { exit / left = left + 10; on Start -> B }
          state B { on Start -> Out; on Abort -> Which }
        }
        choice Which {
          [entered == 2 and left == 22] -> Right
          else                          -> Wrong
        }
        final Right
        final Wrong
        """
    )

    # In and out of `A` twice; `Out` is left for the first time by the second `Start`.
    steps = walk(document, ["Start", "Start", "Start", "Abort"])
    assert steps[-1] == {"Right"}


def test_transitions_without_target_leave_nothing(written: Any, walk: Walk, parsed: Any) -> None:
    body = """
        var n : int32 = 0
        initial A
        state A {
          exit / n = 0
          on Start / n = n + 1
          [n == 2] -> B
        }
        final B
    """

    assert transitions(by_id(parsed(body), "A")) == [("Start", None, None), (None, "n == 2", "B")]
    assert walk(written(body), ["Start", "Start"]) == [{"A"}, {"A"}, {"B"}]


def test_a_transition_without_trigger_is_taken_when_its_guard_holds(
    written: Any, walk: Walk
) -> None:
    document = written(
        """
        var n : int32 = 0
        initial Out
        state Out {
          initial A
          state A { on Found / n = event.level -> A }
          [n > 3] -> Stop
        }
        final Stop
        """
    )

    assert walk(document, [("Found", {"level": 2}), ("Found", {"level": 4})]) == [
        {"Out", "A"},
        {"Out", "A"},
        {"Stop"},
    ]


INTERNAL = """
    var left : int32 = 0
    initial Out
    state Out {
      exit / left = left + 1
      initial A
      state A { on Start -> B }
      state B { on Start -> A; on Low [left == 0] -> Stop }
      internal on Abort -> B
      on Found -> Out
    }
    final Stop
"""


def test_an_internal_transition_does_not_leave_the_state(
    parsed: Any, written: Any, walk: Walk
) -> None:
    (taken,) = by_id(parsed(INTERNAL), "Out").findall(f"{S}transition[@type]")

    assert dict(taken.attrib) == {"event": "Abort", "type": "internal", "target": "B"}
    document = written(INTERNAL)
    assert walk(document, ["Abort", "Low"])[-1] == {"Stop"}
    assert walk(document, ["Found", "Abort", "Low"])[-1] == {"Out", "B"}


INTO_REGION = """
    var left : int32 = 0
    var n : int32 = 0
    initial P
    parallel state P {
      exit / left = left + 1
      region R {
        initial R1
        state R1 { on Start -> R2 }
        state R2 { on Abort -> R1 }
        state R3 { on Low [left == 0] -> R4 }
        state R4 { on Start -> R1 }
      }
      region Q {
        initial Q1
        state Q1 { on Start -> Q2 }
        state Q2 { on Start -> Q1 }
      }
      on Found [event.level > 5] -> Stop
      internal on Found [event.level > 2] / n = n + 1 -> R3
      on Found -> P
    }
    final Stop
"""


def test_an_internal_transition_into_a_region(parsed: Any, written: Any, walk: Walk) -> None:
    """SCXML lacks it and would leave the parallel state, so the region has it."""
    tree = parsed(INTO_REGION)

    assert transitions(by_id(tree, "R")) == [
        ("Found", "!(_event.data.level > 5) && _event.data.level > 2", "R3")
    ]
    assert transitions(by_id(tree, "P")) == [
        ("Found", "_event.data.level > 5", "Stop"),
        ("Found", "_event.data.level > 2", None),
        ("Found", None, "P"),
    ]
    assert [t.get("type") for t in by_id(tree, "R").findall(f"{S}transition")] == ["internal"]
    assert len(list(by_id(tree, "P").iterfind(f"{S}transition/{S}assign"))) == 0
    # The engine of others evaluates Python.
    document = written(INTO_REGION).replace("!(_", "not (_").replace("&amp;&amp;", "and")

    def after(*levels: int) -> set[str]:
        sent = [("Found", {"level": level}) for level in levels]
        active: set[str] = walk(document, ["Start", *sent, "Low"])[-1]
        return active

    # The other region stays where it was, and `P` is not left.
    assert after(3) == {"P", "R", "R4", "Q", "Q2"}
    assert after(6) == {"Stop"}
    assert after(1) == {"P", "R", "R1", "Q", "Q1"}
    assert after(1, 3) == {"P", "R", "R3", "Q", "Q1"}


def test_an_activity_that_gave_up_has_failed(parsed: Any, written: Any, walk: Walk) -> None:
    body = "initial A; state A { do go; on succeeded -> B; on aborted -> C; ALSO } final B; final C"

    assert transitions(by_id(parsed(body.replace("ALSO", "")), "A")) == [
        ("do.A.succeeded", None, "B"),
        ("do.A.aborted do.A.preempted", None, "C"),
    ]
    assert transitions(by_id(parsed(body.replace("ALSO", "on preempted -> B")), "A")) == [
        ("do.A.succeeded", None, "B"),
        ("do.A.aborted", None, "C"),
        ("do.A.preempted", None, "B"),
    ]
    assert walk(written(body.replace("ALSO", "")), ["do.A.preempted"])[-1] == {"C"}


def test_messages_are_copied(parsed: Any) -> None:
    tree = parsed(
        """
        var a : Report; var b : Report
        initial A
        state A { on Found / a = event, b = a, b.id = a.id -> B }
        state B { on Start / send Found(id = b.id) -> C }
        final C
        """
    )
    assigned = [(e.get("location"), e.get("expr")) for e in by_id(tree, "A").iter(f"{S}assign")]

    assert assigned == [
        ("a", "JSON.parse(JSON.stringify(_event.data))"),
        ("b", "JSON.parse(JSON.stringify(a))"),
        ("b.id", "a.id"),
    ]
    assert [param.get("expr") for param in tree.iter(f"{S}param")] == ["b.id"]


def test_values_of_bounded_types_begin_empty(parsed: Any) -> None:
    tree = parsed(
        """
        var a : int32[<=3]; var b : string<=5
        initial A; state A { on Start -> B } final B
        """
    )

    assert {data.get("id"): data.get("expr") for data in tree.iter(f"{S}data")} == {
        "a": "[]",
        "b": '""',
    }
    assert [v.get("type") for v in tree.findall(f"{SW}variable")] == ["int32[<=3]", "string<=5"]
