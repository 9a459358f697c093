"""Properties in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.analysis.property_words import in_words
from swarmdsl.driver import pipeline
from swarmdsl.syntax.ast import Property

MODEL = """package crew
swarm event Start : std_msgs/Empty
swarm event Found : std_msgs/Int32
function carry : abstraction { service "carry" : std_srvs/Trigger }
statemachine Carrying {
  var box : uint8 = 0
  initial Waiting
  state Waiting { on Start -> Work }
  state Work {
    do carry
    on aborted -> Over
    on succeeded / box = box + 1, send Start, send Found(data = box) -> Over
    on Found -> Over
  }
  final Over
}
member Carrier { behavior Carrying }
swarm Crew { robot : Carrier[4] }
"""

SENTENCES = {
    "of Crew : never count(robot in Work) > 1": (
        "In each run of swarm `Crew`: it never happens that more than 1 `robot` are in `Work`."
    ),
    "of Crew : each robot : after Start, in Over within 30 s at least 0.95": (
        "In at least 95 % of all runs of swarm `Crew`, for each `robot` by itself: from the first "
        "time that `Start` arrives from outside, within `30 s` it is in `Over`."
    ),
    "of Crew : each robot : in Work leads to some other robot sends Start": (
        "In each run of swarm `Crew`, for each `robot` by itself: whenever it is in `Work`, then "
        "or later some other `robot` sends `Start`."
    ),
    "of Crew : all robot in Work leads to 2..* robot in Over within 5 s": (
        "In each run of swarm `Crew`: whenever all `robot` are in `Work`, then or within `5 s` "
        "at least 2 `robot` are in `Over`."
    ),
    "of Crew : robot[1] in Work only after 1..3 robot hears Start": (
        "In each run of swarm `Crew`: `robot[1]` is in `Work` only if before, or at the same "
        "moment, 1 to 3 `robot` hear `Start`."
    ),
    "of Crew : before (Start or 2 robot in Over), no robot in Work at all times at most 0.005": (
        "In at most 0.5 % of all runs of swarm `Crew`: before the first time that (`Start` "
        "arrives from outside or exactly 2 `robot` are in `Over`), if that comes, it is true at "
        "all times that no `robot` is in `Work`."
    ),
    "of Crew : all robot hears Found [event.data > 3] leads to Found [event.data == 0]": (
        "In each run of swarm `Crew`: whenever all `robot` hear `Found` with `event.data > 3`, "
        "then or later `Found` with `event.data == 0` arrives from outside."
    ),
    "of Crew : each robot : never sends Found [event.data > box]": (
        "In each run of swarm `Crew`, for each `robot` by itself: it never happens that it sends "
        "`Found` with `event.data > box`."
    ),
    "of Carrying : between hears Start and in Over, starts carry at most 1 times": (
        "In each run of state machine `Carrying`: between each time that it hears `Start` and the "
        "next time that it is in `Over`, if that comes, it happens at most once that it calls "
        "`carry`."
    ),
    "of Carrying : after in Work until in Over, starts carry at most 3 times": (
        "In each run of state machine `Carrying`: from each time that it is in `Work` up to the "
        "next time that it is in `Over`, or to the end, it happens at most 3 times that it calls "
        "`carry`."
    ),
    "of Carrying : in Work then not (in Work or in Waiting) then has [box > 0]": (
        "In each run of state machine `Carrying`: at some time it is in `Work`, and then or later "
        "it is not so that (it is in `Work` or it is in `Waiting`), and then or later it has "
        "`box > 0`."
    ),
    "of Carrying : again and again in Work": (
        "In each run of state machine `Carrying`: again and again it is in `Work`, and so at the "
        "end of a run that ends."
    ),
    "of Crew : always possible all robot cancels carry": (
        "In each run of swarm `Crew`: it stays possible that all `robot` cancel their call of "
        "`carry`, and is so at the end of a run that ends."
    ),
    "of Crew : never all robot ends carry as aborted": (
        "In each run of swarm `Crew`: it never happens that all `robot` complete their call of "
        "`carry` as `aborted`."
    ),
    "of Crew : each robot : starts carry leads to ends carry": (
        "In each run of swarm `Crew`, for each `robot` by itself: whenever it calls `carry`, then "
        "or later it completes its call of `carry`."
    ),
    "of Crew : eventually count(robot in Over) == 4": (
        "In each run of swarm `Crew`: at some time exactly 4 `robot` are in `Over`."
    ),
}


@pytest.mark.parametrize("sentence", SENTENCES)
def test_in_words(sentence: str, tmp_path: Path) -> None:
    file = tmp_path / "crew.swarm"
    file.write_text(f"{MODEL}property One {sentence}\n", encoding="utf-8")
    checked = pipeline.check([file])
    assert checked.valid is not None, [each.message for each in checked.report]
    (owner,) = (node for _, node in checked.valid.declarations() if isinstance(node, Property))
    assert in_words(owner) == SENTENCES[sentence]
