"""The CPSwarm profile: rules of its code generator, and unsupported constructs."""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.codegen.exchange import adf
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

Compile = Callable[[str], System]
Emit = Callable[..., dict[str, str]]
Findings = Callable[[System, str], list[Diagnostic]]
Walk = Callable[..., list[set[str]]]

ROOT = Path(__file__).resolve().parents[2]
S = "{http://www.w3.org/2005/07/scxml}"

# One machine with all that the dialect can say.
EVERYTHING = """
statemachine Insist {
  initial Try
  state Try { do land; on succeeded -> Ok; on aborted -> Try }
  final Ok
}
statemachine M {
  param speed : float64 = 1.5
  var who : string; var count : int32
  initial Ready

  final Stop
  state Ready {
    on Start -> Work
    on Abort -> Stop
  }
  state Work {
    initial Go
    state Fetch {
      do drive(speed = 0.0, name = who) gives (count => count)
      on succeeded -> Go
      on aborted   -> Broken
      on Low       -> Wait
    }
    state Go {
      do drive(speed = speed / 2, name = "it's") gives (name => who)
      on succeeded -> Fetch
      on aborted   -> Home
    }
    /// Wait -- for a while.
    state Wait { on Start -> Go; on Abort -> Nested }
    state Nested = Insist { on done -> Good }
    final Good
    final Broken
    on done.Good   -> Both
    on done.Broken -> Home
    on Found       -> Work
  }
  parallel state Both {
    region Left {
      initial Go
      state Go { do ask(by make) gives by answer; on succeeded -> Go; on aborted -> Lost }
      final Lost
    }
    region Right {
      initial Quiet
      state Quiet { on Found -> Heard }
      final Heard
    }
    on Left.done  -> Home
    on Right.done -> Work
    on Low        -> Home
  }
  state Home = Insist { on done -> Stop }
}
"""

TAGS = {"scxml", "state", "parallel", "transition", "datamodel", "data", "invoke", "name"}
TAGS |= {"rosaction", "rosservice", "rosmonitor", "action", "srv", "topic", "msg"}
TAGS |= {"goal", "request", "result", "response", "param", "var", "mappings", "map", "x", "y"}
BODIES = {
    "ROS_ACTION": ("rosaction", ["name", "action", "goal", "result"]),
    "ROS_SERVICE": ("rosservice", ["name", "srv", "request", "response"]),
    "ROS_MONITOR": ("rosmonitor", ["topic", "msg"]),
}


def faults(document: str) -> list[str]:
    """Return what the CPSwarm code generator rejects or turns into broken code."""
    root = etree.fromstring(document.encode())
    found = [f"unknown element {e.tag}" for e in root.iter("*") if e.tag[len(S) :] not in TAGS]
    vertices = list(root.iter(f"{S}state", f"{S}parallel"))
    ids = [vertex.get("id") for vertex in vertices]
    found += [f"not a Python name: {name}" for name in ids if not name.isidentifier()]
    if len({name.lower() for name in [*ids, "top"]}) <= len(ids):
        found.append("ids that are one Python variable")
    if root.get("version") != "1.0" or not root.get("name") or root.get("initial") != ids[0]:
        found.append("the initial state is not the first")
    for vertex in vertices:
        found += [f"{vertex.get('id')}: {fault}" for fault in vertex_faults(vertex)]
    for text in root.xpath("//*[not(*)]/text()"):
        if "'" in text and text.getparent().tag != f"{S}param":
            found.append(f"a quote in {text}")
    return found


def vertex_faults(vertex: Any) -> list[str]:
    found = []
    children = [child for child in vertex if child.tag in (f"{S}state", f"{S}parallel")]
    transitions = vertex.findall(f"{S}transition")
    siblings = [other.get("id") for other in vertex.getparent() if other.get("id")]
    events = [transition.get("event") for transition in transitions]
    if len(set(events)) < len(events) or not all(event.isidentifier() for event in events):
        found.append(f"events {events}")
    for transition in transitions:
        if sorted(transition.attrib) != ["event", "target"]:
            found.append(f"attributes {transition.attrib}")
        if transition.get("target") not in siblings:
            found.append(f"leads to {transition.get('target')}, in another container")
    in_parallel = vertex.getparent().tag == f"{S}parallel"
    if in_parallel and transitions:
        found.append("transitions that a concurrence does not look at")
    if children:
        if vertex.tag == f"{S}state" and transitions:
            found.append("children with outcomes that the container does not have")
        if vertex.findall(f"{S}invoke") or vertex.findall(f"{S}datamodel"):
            found.append("calls and has children")
        return found
    (invoke,) = vertex.findall(f"{S}invoke") or [None]
    if invoke is None:
        return [*found, "calls nothing"]
    tag, parts = BODIES[invoke.get("type")]
    if tag == "rosmonitor" and not in_parallel:
        found.append("a monitor outside a parallel")
    (data,) = vertex.findall(f"{S}datamodel/{S}data[@id='invoke']")
    body, *mappings = data
    if [body.tag, *(e.tag for e in body)] != [S + tag, *(S + part for part in parts)]:
        found.append(f"content of {body.tag}")
    if len(mappings) > 1 or any(m.tag != f"{S}mappings" for m in mappings):
        found.append("more than mappings")
    for pair in (pair for m in mappings for pair in m):
        if [pair.tag, *(e.tag for e in pair)] != [f"{S}map", f"{S}x", f"{S}y"]:
            found.append("a mapping that is not a map")
    type_name = body[1].text
    if type_name.count("/") != 1:
        found.append(f"type {type_name}")
    if tag != "rosmonitor":
        found += call_faults(body[2], body[3])
    return found


def call_faults(goal: Any, result: Any) -> list[str]:
    items = {"empty": 0, "callback": 0, "fixed": "param", "userdata": "var"}
    found = []
    for part in (goal, result):
        policy = part.get("type")
        tags = {item.tag for item in part}
        if list(part.attrib) != ["type"] or policy not in items:
            found.append(f"policy {part.attrib}")
        elif tags != ({S + str(items[policy])} if items[policy] else set()):
            found.append(f"{policy} with {tags}")
    if goal.tag == f"{S}request" and goal.get("type") == "fixed":
        found.append("a fixed request")
    if result.tag == f"{S}result" and result.get("type") == "callback":
        found.append("a callback for a result")
    return found


@pytest.fixture
def dialect(compiled: Compile, emit: Emit) -> Callable[..., Any]:
    """Return the document of a machine `M` in the dialect, as a tree."""

    def dialect(body: str, *expected: str) -> Any:
        files = emit(compiled(f"statemachine M {{\n{body}\n}}"), "cpswarm", expected)
        assert faults(files["M.cpswarm.xml"]) == []
        return etree.fromstring(files["M.cpswarm.xml"].encode())

    return dialect


def by_id(tree: Any, name: str) -> Any:
    return tree.xpath(f"//*[@id='{name}']")[0]


def transitions(element: Any) -> dict[str, str]:
    return {t.get("event"): t.get("target") for t in element.findall(f"{S}transition")}


def inside(element: Any) -> list[str]:
    return [child.get("id") for child in element if child.get("id")]


def policy(tree: Any, name: str) -> list[list[str]]:
    (body,) = by_id(tree, name).iterfind(f"{S}datamodel/{S}data[@id='invoke']/*[{S}name]")
    return [[part.get("type"), *(item.text for item in part)] for part in body[2:]]


def test_the_rules_see_what_they_are_for(corpus: Path) -> None:
    """Real files break some rules: their output was completed by hand."""
    text = (corpus / "scxml" / "head_UAV_sar_FSM2.xml").read_text(encoding="utf-8")

    assert faults(text) == [
        "Idle: calls nothing",
        "MissionAbort: children with outcomes that the container does not have",
    ]
    text = (corpus / "scxml" / "head_action_cb_cb.xml").read_text(encoding="utf-8")
    assert faults(text) == ["Idle: calls nothing", "TakeOff: a callback for a result"]


def test_examples_keep_the_rules(search_and_rescue: System, emit: Emit) -> None:
    files = emit(search_and_rescue, "both", ["complete-by-hand", "profile-left-out"])

    assert sorted(files) == ["RoverRescue.scxml", "UavSearch.cpswarm.xml", "UavSearch.scxml"]
    assert faults(files["UavSearch.cpswarm.xml"]) == []
    blinker = pipeline.check([ROOT / "examples" / "minimal" / "blinker.swarm"]).system
    assert blinker is not None
    assert faults(emit(blinker, "cpswarm")["Blinking.cpswarm.xml"]) == []


def test_all_that_the_dialect_can_say(compiled: Compile, emit: Emit) -> None:
    # `who` leaves the container of `Fetch`, whose keys a person has to name.
    files = emit(compiled(EVERYTHING), "cpswarm", ["complete-by-hand"])

    assert faults(files["M.cpswarm.xml"]) == []
    assert faults(files["Insist.cpswarm.xml"]) == []
    tree = etree.fromstring(files["M.cpswarm.xml"].encode())
    assert inside(tree) == ["ReadyThreads", "WorkThreads", "Both", "Home"]
    # Whatever leads out of a container is the container's outcome, and what follows that.
    assert transitions(by_id(tree, "ReadyThreads")) == {"start": "WorkThreads"}
    assert transitions(by_id(tree, "WorkThreads")) == {
        "aborted": "Home",
        "succeeded": "Both",
        "found": "WorkThreads",
    }
    assert inside(by_id(tree, "WorkThreads")) == ["WorkBehavior", "FoundMonitoring"]
    assert inside(by_id(tree, "WorkBehavior")) == [
        "Go",
        "FetchThreads",
        "WaitThreads",
        "Nested",
    ]
    assert transitions(by_id(tree, "Go")) == {"succeeded": "FetchThreads"}
    assert inside(by_id(tree, "FetchThreads")) == ["Fetch", "LowMonitoring"]
    assert transitions(by_id(tree, "FetchThreads")) == {
        "succeeded": "Go",
        "low": "WaitThreads",
    }
    assert inside(by_id(tree, "WaitThreads")) == ["WaitStartMonitoring", "WaitAbortMonitoring"]
    assert inside(by_id(tree, "Both")) == ["Left", "QuietFoundMonitoring", "BothLowMonitoring"]
    assert transitions(by_id(tree, "Both")) == {
        "aborted": "Home",
        "found": "WorkThreads",
        "low": "Home",
    }
    assert transitions(by_id(tree, "Home")) == {}
    assert policy(tree, "Fetch") == [["userdata", "name"], ["userdata", "count"]]
    assert policy(tree, "Go") == [["fixed", "0.75", '"it\'s"'], ["userdata", "name"]]
    assert policy(tree, "Both_Left_Go") == [["callback"], ["callback"]]


def test_a_way_out_to_a_final_state_further_out(dialect: Any) -> None:
    """It ends each container on the way; only its own final state continues."""
    tree = dialect(
        """
        initial Out
        state Out { initial In
          state In { initial Go
            state Go { do land; on succeeded -> There; on aborted -> Stop }
            final There
            on done -> Next }
          state Next { do land; on succeeded -> Next; on aborted -> Stop } }
        final Stop
        """
    )

    assert transitions(by_id(tree, "InThreads")) == {"succeeded": "Next"}
    assert transitions(by_id(tree, "Next")) == {"succeeded": "Next"}
    assert [transitions(by_id(tree, name)) for name in ("Out", "Go")] == [{}, {}]


def test_a_state_of_a_real_file(dialect: Any) -> None:
    """A state of `head_action_mapping1.xml` that runs while an event is awaited."""
    tree = dialect(
        """
        var what : string; var how_many : int32
        initial Coverage
        state Coverage {
          do drive(speed = 0.0, name = what) gives (name => what, count => how_many)
          on succeeded -> Coverage
          on aborted   -> Coverage
          on Abort     -> Stop2
        }
        state Stop2 { do land; on succeeded, aborted -> Stop }
        final Stop
        """
    )

    expected = """<parallel xmlns="http://www.w3.org/2005/07/scxml" id="CoverageThreads">
      <state id="Coverage">
        <datamodel>
          <data id="adf"><name>drive</name></data>
          <data id="invoke">
            <rosaction>
              <name>cmd/drive</name>
              <action>test/Drive</action>
              <goal type="userdata"><var>name</var></goal>
              <result type="userdata"><var>name</var><var>count</var></result>
            </rosaction>
            <mappings>
              <map><x>name</x><y>what</y></map>
              <map><x>count</x><y>how_many</y></map>
            </mappings>
          </data>
        </datamodel>
        <invoke type="ROS_ACTION"/>
      </state>
      <state id="AbortMonitoring">
        <datamodel>
          <data id="invoke">
            <rosmonitor>
              <topic>bridge/events/abort</topic>
              <msg>swarmros/SimpleEvent</msg>
            </rosmonitor>
          </data>
        </datamodel>
        <invoke type="ROS_MONITOR"/>
      </state>
      <transition event="succeeded" target="CoverageThreads"/>
      <transition event="aborted" target="CoverageThreads"/>
      <transition event="abort" target="Stop2"/>
    </parallel>"""
    assert canonical(etree.tostring(by_id(tree, "CoverageThreads"))) == canonical(expected)


def canonical(text: str | bytes) -> str:
    stripped = etree.fromstring(text, etree.XMLParser(remove_blank_text=True))
    stripped.tail = None
    etree.cleanup_namespaces(stripped)
    return str(etree.canonicalize(stripped, strip_text=True))


WAY_OUT = "`--option scxml.profile=portable` builds SCXML without it"

UNSUPPORTED = {
    "a guard": "state A { on Found [event.level > 3] -> B }",
    "a choice": "state A { on Start -> C } choice C { else -> B }",
    "an assignment": "state A { on Found / n = event.level -> B }",
    "the sending of an event": 'state A { on Start / send Found(id = "", level = 1) -> B }',
    "a transition after a time": "state A { on Start -> B; after 2 s -> B }",
    "a history": """
        state A { initial I; state I { on Start -> J } state J { on Start -> I }
                  history H -> I; on Abort -> B; on Low -> Away }
        state Away { on Start -> A.H }
    """,
    "an effect on entry": "state A { entry / n = 1; on Start -> B }",
    "an effect on exit": "state A { exit / n = 1; on Start -> B }",
    "an internal transition": """
        state A { initial I; state I { on Start -> E } final E; internal on Low -> I; on done -> B }
    """,
    "a transition without a target": "state A { on Low / n = 1; on Start -> B }",
    "a transition without a trigger": "state A { [n > 3] -> B; on Start -> B }",
    "a transition into a nested state": """
        state A { on Start -> W.I }
        state W { initial I; state I { on Abort -> E } final E; on done -> B }
    """,
    "a result stored in a field of a variable": """
        state A { do go gives (count => r.level); on succeeded, aborted -> B }
    """,
    "a callback for the result of an action": """
        state A { do go gives by answer; on succeeded, aborted -> B }
    """,
    "the end of all regions": """
        parallel state A { region X { initial I; state I { on Start -> E } final E } on done -> B }
    """,
    "a final state that nothing follows": """
        parallel state A {
          region X { initial I; state I { on Start -> E } final E }
          region Y { initial J; state J { on Abort -> F } final F }
          on X.done -> B
        }
    """,
    "`aborted` leading to two places": """
        state A {
          initial I
          state I { do land; on succeeded -> J; on aborted -> E }
          state J { do land; on succeeded -> I; on aborted -> F }
          final E
          final F
          on done.E -> B
          on done.F -> A
        }
    """,
    "a second exit from a state that waits for an event": """
        state A {
          initial I
          state I { do land; on succeeded -> E; on aborted -> I; on Start -> I }
          final E
          on done -> B
        }
    """,
    "an event awaited on two levels": """
        state A {
          initial I
          state I { do land; on succeeded -> E; on aborted -> I; on Start -> I }
          final E
          on done, Start -> B
        }
    """,
}


@pytest.mark.parametrize("construct", UNSUPPORTED)
def test_what_the_dialect_cannot_say(
    compiled: Compile, findings: Findings, emit: Emit, construct: str
) -> None:
    system = compiled(
        "statemachine M { var n : int32; var r : Report; initial A;"
        f" {UNSUPPORTED[construct]} final B }}"
    )
    found = findings(system, "cpswarm")

    message = f"the CPSwarm profile of target `scxml` cannot express {construct}"
    assert message in [each.message for each in found]
    assert {each.help for each in found} == {WAY_OUT}
    assert all(each.primary is not None for each in found)
    assert list(emit(system, "both", ["profile-left-out"])) == ["M.scxml"]


def test_by_way_of_which_state_a_construct_comes_in(compiled: Compile, findings: Findings) -> None:
    system = compiled(
        """
        statemachine Inner { initial A; state A { after 1 s -> B } final B }
        statemachine M {
          initial First
          state First { on Start -> Second }
          state Second = Inner { on done -> Stop }
          final Stop
        }
        """
    )
    of_inner, of_m = findings(system, "cpswarm")

    assert of_inner.message == of_m.message
    assert of_inner.related == ()
    ((place, message),) = [(label.span.text, label.message) for label in of_m.related]
    assert (place, message) == ("Second", "included in `M` by this state")
    left_out = [each for each in findings(system, "both") if "`M.c" in each.message]
    assert [each.related for each in left_out] == [of_m.related]


def test_variables_of_a_reused_machine(compiled: Compile, findings: Findings) -> None:
    """Each entry initializes them, which is no effect of the model."""
    system = compiled(
        """
        statemachine Inner {
          var name : string = "x"
          initial A
          state A { do drive(speed = 0.0, name = name); on succeeded, aborted -> B }
          final B
        }
        statemachine M {
          initial First
          state First { on Start -> Second }
          state Second = Inner { on done -> Stop }
          final Stop
        }
        """
    )
    found = [each for each in findings(system, "cpswarm") if "`M.c" in each.message]

    assert [each.name for each in found] == ["complete-by-hand"]
    assert found[0].message.endswith("`userdata.second_name` has no initial value")
    assert [label.span.text for label in found[0].related] == ["Second"]


def test_a_machine_that_waits_for_nothing(compiled: Compile, findings: Findings) -> None:
    system = compiled("endless statemachine M { initial A; state A { on Start -> B } state B { } }")
    (found,) = findings(system, "cpswarm")

    assert found.name == "unsupported-construct"
    assert found.message.endswith("a state that waits for nothing")
    assert found.primary is not None
    assert found.primary.span.text == "B"


def test_one_warning_for_a_file_that_is_left_out(compiled: Compile, findings: Findings) -> None:
    system = compiled(
        "statemachine M { initial A; state A { after 1 s -> B; after 2 s -> B } final B }"
    )
    (found,) = findings(system, "both")

    assert found.name == "profile-left-out"
    assert found.notes == (
        "the CPSwarm profile of target `scxml` cannot express a transition after a time",
        "this is the first of 2 such places",
    )
    assert found.help == WAY_OUT
    assert findings(system, "portable") == []


def test_a_constant_beside_a_variable_is_work_for_a_person(
    compiled: Compile, findings: Findings
) -> None:
    system = compiled(
        """
        statemachine M {
          param speed : float64 = 1.5; param given : float64
          var who : string
          initial A
          state A { do drive(speed = speed, name = who) gives (name => who)
                    on succeeded -> A; on aborted -> B }
          state B { do drive(speed = given, name = "x"); on succeeded -> C; on aborted -> B }
          final C
        }
        """
    )
    first, second = findings(system, "cpswarm")

    assert first.name == second.name == "complete-by-hand"
    assert first.notes == ("its code is `goal.speed = 1.5`, `goal.name = userdata.who`",)
    assert second.notes == (
        "its code is `goal.speed = rospy.get_param('~given')`, `goal.name = 'x'`",
    )


@pytest.mark.parametrize(
    ("variables", "state", "what"),
    [
        ("var s : string", "do drive(speed = 0.0, name = s)", "no initial value"),
        (
            'var s : string = "x"',
            "do drive(speed = 0.0, name = s) gives (name => s)",
            "no initial value",
        ),
        ("var n : int32 = 3", "do go gives (count => n)", None),
        ("", "do ask(times = 3)", "the callback for the request of `A` is empty"),
    ],
)
def test_what_a_person_has_to_add(
    compiled: Compile, findings: Findings, variables: str, state: str, what: str | None
) -> None:
    system = compiled(
        f"statemachine M {{ {variables}\n initial A\n"
        f"state A {{ {state}; on succeeded, aborted -> B }}"
        " final B }"
    )
    found = findings(system, "cpswarm")

    assert [each.name for each in found] == (["complete-by-hand"] if what else [])
    assert all(each.message.endswith(str(what)) for each in found)


@pytest.mark.parametrize(
    ("declaration", "event"),
    [
        ("event Aborted : swarmros/SimpleEvent", "Aborted"),
        ("event start : swarmros/SimpleEvent", "start, Start"),
    ],
)
def test_names_that_the_dialect_cannot_take(
    compiled: Compile, findings: Findings, declaration: str, event: str
) -> None:
    system = compiled(
        f"{declaration}; statemachine M {{ initial A; state A {{ on {event} -> B }} final B }}"
    )

    assert [found.name for found in findings(system, "cpswarm")] == ["bad-identifier"]


def test_ids_differ_in_more_than_case(dialect: Any) -> None:
    tree = dialect(
        """
        initial top
        state top { initial Go; state Go { do land; on succeeded -> GO; on aborted -> Go }
                    state GO { do land; on succeeded -> E; on aborted -> GO } final E
                    on done -> Top }
        state Top { do land; on succeeded -> GoThreads; on aborted -> Top }
        state GoThreads { do land; on succeeded -> Z; on aborted -> Top }
        final Z
        """
    )

    assert transitions(by_id(tree, "topThreads")) == {"succeeded": "Top2"}
    assert inside(by_id(tree, "topBehavior")) == ["Go", "top_GO"]


def test_the_original_generator_takes_it(
    compiled: Compile,
    search_and_rescue: System,
    emit: Emit,
    findings: Findings,
    tmp_path: Path,
) -> None:
    command = os.environ.get("SWARMDSL_CPSWARM_GENERATOR")
    if command is None:
        pytest.skip("no CPSwarm code generator (set SWARMDSL_CPSWARM_GENERATOR to its command)")
    for system, name in ((search_and_rescue, "UavSearch"), (compiled(EVERYTHING), "M")):
        report = Diagnostics()
        files = {file.path: file.text for file in adf.emit(system, adf.Options(), report)}
        files |= emit(system, "both", [found.name for found in findings(system, "both")])
        for path, text in files.items():
            (tmp_path / path).write_text(text, encoding="utf-8")
        out = tmp_path / name
        out.mkdir()
        scxml = tmp_path / f"{name}.cpswarm.xml"
        functions = tmp_path / f"{system.name}.adf.json"
        given = ["--scxml", str(scxml), "--adf", str(functions), "--output", str(out)]
        run = subprocess.run([*shlex.split(command), *given], capture_output=True, text=True)

        assert "SUCCESS" in run.stdout + run.stderr
        made = (out / "fsm_behaviour" / "scripts" / "behaviour.py").read_text(encoding="utf-8")
        assert "NOT_SUPPORTED" not in made
        assert "$" not in made
        compile(made, "behaviour.py", "exec")
