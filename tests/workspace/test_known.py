"""Cached facts of a declaration stay valid after edits to others."""

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.workspace import Workspace
from swarmdsl.lowering import lower

Say = Callable[[str], list[str]]
SETTINGS = Settings(levels={"unused-declaration": Level.WARN})

EXCHANGE = """\
swarm event Start : std_msgs/Empty
statemachine Tell { initial A; state A { after 1 s / send Start -> B } final B }
statemachine Hear { initial A; state A { on Start -> B } final B }
member Teller { behavior Tell }
member Hearer { behavior Hear }
swarm Site { teller : Teller[1]; hearer : Hearer[1] }
"""


@pytest.fixture
def say(tmp_path: Path) -> Say:
    """Edits a file; returns the names of what is said of it, which a first run says too."""
    file = tmp_path / "model.swarm"
    file.write_text("", encoding="utf-8")
    workspace = Workspace([file], SETTINGS)

    def edit(text: str) -> list[str]:
        file.write_text(text, encoding="utf-8")
        workspace.update({file: text})
        found = [(each.name, each.message) for each in workspace.report]
        anew = pipeline.check([file], SETTINGS).report
        assert found == [(each.name, each.message) for each in anew]
        return [name for name, _ in found]

    return edit


def nested(name: str, levels: int, inmost: str) -> str:
    """A machine with a chain of states in each other."""
    start = "".join(f"initial S{at}; state S{at} {{ " for at in range(levels))
    return f"endless statemachine {name} {{ {start}initial End; {inmost} {'} ' * levels}}}\n"


def test_machine_is_reused_for_the_first_time(say: Say) -> None:
    inner = nested("Inner", 40, "state End { }")
    assert "nested-too-deeply" not in say(inner + nested("Outer", 40, "state End { }"))
    assert "nested-too-deeply" in say(inner + nested("Outer", 40, "state End = Inner"))
    assert "nested-too-deeply" not in say(inner + nested("Outer", 10, "state End = Inner"))


def test_machine_that_is_reused_grows(say: Say) -> None:
    outer = nested("Outer", 40, "state End = Inner")
    assert "nested-too-deeply" not in say(nested("Inner", 10, "state End { }") + outer)
    assert "nested-too-deeply" in say(nested("Inner", 40, "state End { }") + outer)


def test_machine_contains_itself(say: Say) -> None:
    inner = nested("Inner", 2, "state End { }")
    outer = nested("Outer", 2, "state End = Inner")
    assert "submachine-cycle" not in say(inner + outer)
    assert "submachine-cycle" in say(nested("Inner", 2, "state End = Outer") + outer)


def test_machine_no_longer_waits(say: Say) -> None:
    assert "unhandled-event" not in say(EXCHANGE)
    assert "unhandled-event" in say(EXCHANGE.replace("on Start", "after 2 s"))
    assert "unhandled-event" not in say(EXCHANGE)


def test_event_has_another_topic(say: Say) -> None:
    text = EXCHANGE + "swarm event Begin : std_msgs/Empty\n"
    text = text.replace("on Start", "on Begin")
    assert "unhandled-event" in say(text)
    same = text.replace("Begin : std_msgs/Empty", 'Begin : std_msgs/Empty on "start"')
    assert "unhandled-event" not in say(same)


def test_member_runs_another_machine(say: Say) -> None:
    assert "unhandled-event" not in say(EXCHANGE)
    found = say(EXCHANGE.replace("Hearer { behavior Hear }", "Hearer { behavior Tell }"))
    assert "unhandled-event" in found


def test_member_leaves_the_swarm(say: Say) -> None:
    assert "unhandled-event" not in say(EXCHANGE)
    assert "unhandled-event" in say(EXCHANGE.replace("hearer : Hearer[1]", ""))


USER = """\
struct Place { x : float64 }
const LEAST : int32 = 3
event Go : Place
statemachine M {
  var n : int32 = 0
  initial A
  state A { on Go [n < LEAST] / n = n + 1 -> A; on Go -> B }
  final B
}
"""


@pytest.mark.parametrize(("word", "instead"), [("LEAST]", "4]"), (": Place", ": std_msgs/Empty")])
def test_declaration_is_used_no_more(say: Say, word: str, instead: str) -> None:
    assert "unused-declaration" not in say(USER)
    assert "unused-declaration" in say(USER.replace(word, instead))
    assert "unused-declaration" not in say(USER)


def test_declaration_of_a_library_is_used_no_more(say: Say) -> None:
    """Only events of a library that are used share their topics with others."""
    text = """\
import cpswarm.events.*
swarm event Begin : std_msgs/Int32 on "mission_start"
statemachine M { initial A; state A { on MissionStart -> B; on Begin -> B } final B }
"""
    other = text.replace("on MissionStart", "on MissionAbort")
    assert "topic-types" in say(text)
    assert "topic-types" not in say(other)
    assert "topic-types" in say(text)


CLIMB = """\
action uav_msgs/Climb { goal { altitude : float64 } feedback { altitude : float64 } }
"""
ASCENT = """\
function climb : abstraction { action "climb" : uav_msgs/Climb }
statemachine Ascent {
  var last : uav_msgs/ClimbFeedback
  initial Climbing
  state Climbing {
    do climb(altitude = 40.0)
    monitor "climb/feedback" : uav_msgs/ClimbActionFeedback
      [event.feedback.altitude > last.altitude] / last = event.feedback
    on succeeded, aborted -> High
  }
  final High
}
member Uav { behavior Ascent }
"""


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        (CLIMB.replace("feedback { altitude", "feedback { height"), "unknown-field"),
        (CLIMB.replace("feedback { altitude : float64", "feedback { altitude : bool"), "operand"),
        (CLIMB.replace("feedback { altitude : float64 }", ""), "unknown-field"),
    ],
)
def test_feedback_of_an_action_has_other_fields(say: Say, changed: str, said: str) -> None:
    before = say(CLIMB + ASCENT)
    assert any(said in name for name in say(changed + ASCENT))
    # As long as nothing is known of the action, nothing is known of its feedback.
    assert say(ASCENT) == before
    assert any(said in name for name in say(changed + ASCENT))
    assert say(CLIMB + ASCENT) == before


def test_fields_around_the_feedback_of_an_action(say: Say) -> None:
    of_ros1 = ASCENT.replace("[event.feedback", "[event.status.status == 1 and event.feedback")
    assert say(CLIMB + of_ros1) == say(CLIMB + ASCENT)
    assert "unknown-field" in say(CLIMB + ASCENT.replace("[event.feedback", "[event.feedbak"))


HEARS = "property Hears : each hearer : in A leads to in B within 1 min\n"


def test_property_without_a_subject_gets_another_swarm(say: Say) -> None:
    assert say(EXCHANGE + HEARS) == []
    other = "swarm Other { teller : Teller[1]; hearer : Hearer[1] }\n"
    assert say(EXCHANGE + HEARS + other) == ["unclear-property"]
    assert say(EXCHANGE + HEARS) == []


def test_property_without_a_subject_loses_its_swarm(say: Say) -> None:
    assert say(EXCHANGE + HEARS) == []
    found = say(
        EXCHANGE.replace("swarm Site { teller : Teller[1]; hearer : Hearer[1] }", "") + HEARS
    )
    assert "unclear-property" in found
    assert say(EXCHANGE + HEARS) == []


def test_states_of_a_property_follow_the_member(say: Say) -> None:
    other = "statemachine Deaf { initial A; state A { after 1 s -> C } final C }\n"
    assert "unresolved-name" not in say(EXCHANGE + other + HEARS)
    deaf = EXCHANGE.replace("Hearer { behavior Hear }", "Hearer { behavior Deaf }")
    assert "unresolved-name" in say(deaf + other + HEARS)
    assert "unresolved-name" in say(
        EXCHANGE.replace("final B }\nmember", "final C }\nmember") + HEARS
    )


def test_a_role_of_a_property_is_renamed(say: Say) -> None:
    assert say(EXCHANGE + HEARS) == []
    assert "unresolved-name" in say(EXCHANGE.replace("hearer :", "ear :") + HEARS)
    assert say(EXCHANGE.replace("hearer :", "ear :") + HEARS.replace("hearer", "ear")) == []


def test_a_fact_of_a_property_becomes_impossible(say: Say) -> None:
    told = "property Told : never count(teller in A) > 1\n"
    assert say(EXCHANGE + told) == ["impossible-fact"]
    assert say(EXCHANGE.replace("Teller[1]", "Teller[2]") + told) == []
    sends = "property Sends : each hearer : never sends Start\n"
    assert say(EXCHANGE + sends) == ["impossible-fact"]
    more = EXCHANGE.replace("on Start -> B", "on Start / send Start -> B")
    assert say(more + sends) == []


def test_another_swarm_has_the_fitness(tmp_path: Path) -> None:
    """The swarms are in one file, the fitness that their bodies name is in another one."""
    model, goal = tmp_path / "model.swarm", tmp_path / "goal.swarm"
    swarms = f'import "goal.swarm"\n{EXCHANGE}swarm Other {{ hearer : Hearer[1] }}\n'
    model.write_text(swarms, encoding="utf-8")
    fitness = "fitness Ends { in ends : uint32 = count(teller in B); maximize ends }\n"
    goal.write_text(fitness, encoding="utf-8")
    workspace = Workspace([tmp_path], SETTINGS)

    def said(text: str) -> list[str]:
        workspace.update({model: text})
        model.write_text(text, encoding="utf-8")
        anew = pipeline.check([tmp_path], SETTINGS)
        found = [(each.name, each.message) for each in workspace.report]
        assert found == [(each.name, each.message) for each in anew.report]
        if anew.valid is not None:
            assert lower(workspace.project) == anew.system
        return [name for name, _ in found]

    assert "unclear-property" in said(swarms)
    had = swarms.replace("hearer : Hearer[1] }\nswarm", "hearer : Hearer[1]; fitness Ends }\nswarm")
    assert had != swarms
    assert "unclear-property" not in said(had)
    assert "unclear-property" in said(swarms)
