"""Mistakes in properties: what is said of them, and facts that can never hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MODEL = """package crew
swarm event Start : std_msgs/Empty
swarm event Home : std_msgs/Empty
enum Sort { PERSON, CAR }
message Spot { x : float64, sort : Sort }
swarm event Seen : Spot
event Low : std_msgs/Bool on "low"
event Other : std_msgs/Bool
function carry : abstraction { service "carry" : std_srvs/Trigger }
function other : abstraction { service "other" : std_srvs/Trigger }
endless statemachine Carrying {
  var box : uint8 = 0
  initial Waiting
  state Waiting {
    on Start -> Fetch
    monitor "low" : std_msgs/Bool -> Waiting
  }
  state Fetch {
    do carry
    on succeeded / box = box + 1, send Home, send Seen(x = box) -> Waiting
    on Seen -> Fetch
    on aborted -> Waiting
  }
}
endless statemachine Watching {
  initial Look
  state Look { on Home -> Look }
}
member Carrier { behavior Carrying }
member Scout { behavior Watching }
swarm Crew {
  robot : Carrier[2..4]
  scout : Scout
}
"""


def found(sentence: str, tmp_path: Path) -> list[tuple[str, str, str]]:
    """Return code, message and help of each diagnostic."""
    file = tmp_path / "crew.swarm"
    file.write_text(f"{MODEL}property One of {sentence}\n", encoding="utf-8")
    return [
        (each.code, each.message, each.help or "")
        for each in pipeline.check([file]).report
        if "never called" not in each.message and "`Other`" not in each.message[:20]
    ]


HELPS = {
    "Crew : always all robot in Fetch": "write `at all times` after the fact",
    "Crew : never some robot succeeds carry": "write `ends carry as succeeded`",
    "Crew : each robot : never aborts carry": "write `ends carry as aborted`",
    "Crew : never some robot ends carry aborted": "write `as aborted`",
    "Crew : never some robot finishes carry": "write `ends`",
    "Crew : never some robot ends carry as succeded": "did you mean `succeeded`?",
    "Crew : G(all robot in Fetch)": "write `at all times` after the fact",
    "Crew : F(all robot in Fetch)": "write `eventually` before the fact",
    "Crew : infinitely often some robot in Fetch": "write `again and again` before the fact",
    "Crew : some robot in Fetch implies scout in Look": (
        "write `P leads to Q`, or `not P or Q at all times` for one moment"
    ),
    "Crew : some robot in Fetch -> scout in Look": (
        "write `P leads to Q`, or `not P or Q at all times` for one moment"
    ),
    "Crew : until Home, never some robot in Fetch": "write `before P,`, or `after P until Q,`",
    "Crew : eventually all robot in Fetch within 10": "give it a unit: `10 s`",
    "Crew : eventually all robot in Fetch within 10 sec": "write `10 s`",
    "Crew : eventually all robot in Fetch within 10 m": "`m` is metres: write `10 min`",
    "Crew : eventually all robot in Fetch in 10 s": "write `within 10 s`",
    "Crew : forall robot : never in Fetch": "write `each robot :`",
    "Crew : for all robot : never in Fetch": "write `each robot :`",
    "Crew : every robot : never in Fetch": "write `each robot :`",
    "Crew : some robot sends Home exactly 3 times": "write `at most N times`",
    "Crew : some robot sends Home at least 3 times": (
        "write each time, as in `P then not P then P`"
    ),
    "Crew : all robot in Fetch within 5 s at least 95 %": "write `0.95`",
    "Crew : all robot in Fetch within 5 s with probability 0.9": "write `at least 0.9`",
    "Crew : never all robot in Fetch at all times": (
        "the sentence is about all times without it: leave `at all times` out"
    ),
    "Crew : never count(robot) > 2": "write `count(robot in State)`",
    "Crew : robot[0].box > 3 within 5 s": (
        "write `robot[0] in State`, or `robot[0] has [x > 3]` for its variables"
    ),
    "Crew : never some robot not in Fetch": (
        "write `not` before the whole fact, as in `not all robot in State`"
    ),
    "Crew : between Home or Start and Home, never scout in Look": (
        "put what is joined in parentheses"
    ),
    "Crew { never some robot in Fetch }": "write `:` and one sentence",
    "Crew : never some robot sends Seen (x > 3)": "write `sends Seen [event.x > 3]`",
    "Crew : never some robot sends Seen with x = 3": "write `sends Seen [event.x == 3]`",
    "Crew : never some robot hears Seen where event.x < 3": "write `hears Seen [event.x < 3]`",
    "Crew : never some robot hears Seen has [event.x < 3]": "write `hears Seen [event.x < 3]`",
    "Crew : never some robot hears Seen.x > 3": "write `hears Seen [event.x > 3]`",
    "Crew : never some robot hears Seen [x > 3]": "write `event.x`",
    "Crew : never some robot hears Seen [y > 3]": "",
    "Crew : never some robot hears Seen [event.sort == Sort.DOG]": "it has `PERSON` and `CAR`",
    "Crew : never some robot hears Seen [event.sort == Sort.CARS]": "did you mean `CAR`?",
    'Crew : never some robot hears Seen [event.sort == "CAR"]': "write `Sort.CAR`",
    "Crew : never some robot hears Seen [event.sort == 1]": (
        "compare it with a value of the enum, such as `Sort.PERSON`"
    ),
    "Crew : never Seen [event.x > box]": (
        "an event from outside is about no robot: write `hears Seen [...]`"
    ),
    "Carrying : never Seen [event.x > box]": (
        "an event from outside is about no robot: write `hears Seen [...]`"
    ),
    'Crew : never some robot hears Seen [sender == "scout"]': "write `event.sender`",
    "Crew : never some robot sends Seen [event.y > 3]": "it has `x` and `sort`",
    'Crew : never some robot sends Seen [event.sender == "scout"]': (
        "leave it out: the fact names the robot that sends the event"
    ),
    'Crew : never Seen [event.sender == "scout"]': (
        "write `hears`: an event from outside comes from no robot"
    ),
    'Crew : never some robot hears Seen [event.sender == "scout"]': (
        "this is a role; its robots are `scout[0]` and so on"
    ),
    "Crew : never some robot has [event.x > 3]": (
        "write it after an event: `hears Found [event.x > 3]`"
    ),
    "Crew : never some robot in Fetch [box > 3]": (
        "only an event has a condition: write `and`, and a fact with `has [x > 3]`"
    ),
    "Crew : each robot in Fetch leads to in Waiting": "write `:` before `in`",
    "Crew : each robot, in Fetch leads to in Waiting": "write `each robot :`",
    "Crew : never count(robot in Fetch)": "compare it, as in `count(robot in Fetch) > 1`",
    "Crew : never count(robot in Fetch) > 2.5": "write a whole number",
    "Crew : each robot : in Fetch at most 2.5 times": "write a whole number",
    "Crew : never some robot sends Seen [event.x > 3, event.x < 5]": (
        "join conditions with `and`, in one pair of brackets"
    ),
    "Crew : never some robot sends Seen [event.x > 3] [event.x < 5]": (
        "join conditions with `and`, in one pair of brackets"
    ),
    "Crew : each robot : in Fetsh leads to in Waiting": "did you mean `Fetch`?",
    "Crew : never in Fetch": (
        "begin the property with `each ROLE :`, or write `all ROLE`, `some ROLE` or `no ROLE` here"
    ),
    "Carrying : never some robot in Fetch": (
        "leave it out, or write `of` with the name of a swarm"
    ),
}


@pytest.mark.parametrize("sentence", HELPS)
def test_a_mistake_has_a_way_out(sentence: str, tmp_path: Path) -> None:
    ((_, _, help_),) = found(sentence, tmp_path)
    assert help_ == HELPS[sentence]


def test_a_word_too_many_is_one_mistake(tmp_path: Path) -> None:
    ((code, message, _),) = found("Crew : some robot in Fetch only after Start soon", tmp_path)
    assert code == "SW0101"
    assert message.endswith("found `soon`")


def test_a_state_of_others_is_unknown(tmp_path: Path) -> None:
    ((_, message, _),) = found("Crew : each robot : never in Look", tmp_path)
    assert message == "no state of `Carrying` called `Look`"


IMPOSSIBLE = {
    "count(robot in Fetch) > 4": "role `robot` has at most 4 robots",
    "count(robot in Fetch) == 5": "role `robot` has at most 4 robots",
    "count(robot in Fetch) < 0": "a number is never below 0",
    "5..* robot in Fetch": "role `robot` has at most 4 robots",
    "3..2 robot in Fetch": "no number is in `3..2`",
    "scout sends Home": "role `scout` never sends `Home`",
    "scout hears Start": "role `scout` never waits for `Start`",
    "scout starts carry": "role `scout` never calls `carry`",
    "some robot cancels other": "role `robot` never calls `other`",
    "scout ends carry as aborted": "role `scout` never calls `carry`",
    "some robot ends carry as preempted": "a service ends as `succeeded` or `aborted`",
    "Other": "`Crew` never waits for `Other`",
    "some robot sends Seen [event.x > 3 and event.x < 2]": "its condition is always false",
    "some robot has [box > 255]": "its condition is always false",
    "some robot has [box > 3 and box < 2]": "its condition is always false",
    "some robot has [false]": "its condition is always false",
}


@pytest.mark.parametrize("fact", IMPOSSIBLE)
def test_a_fact_that_never_holds(fact: str, tmp_path: Path) -> None:
    ((code, message, _),) = found(f"Crew : never {fact}", tmp_path)
    assert (code, message) == ("SW1603", f"this can never hold: {IMPOSSIBLE[fact]}")


@pytest.mark.parametrize(
    "fact",
    [
        "count(robot in Fetch) > 3",
        "count(robot in Fetch) <= 0",
        "2..* robot in Fetch",
        "some robot hears Low",  # by its topic
        "some robot has [box > 254]",
        "some robot cancels carry",
        "some robot ends carry as aborted",
        "some robot sends Seen [event.x > box and event.x < 300]",
        "some robot hears Seen [event.sent > 3 s]",
        "Seen [event.x != 3]",
    ],
)
def test_a_fact_that_can_hold(fact: str, tmp_path: Path) -> None:
    assert not found(f"Crew : never {fact}", tmp_path)
