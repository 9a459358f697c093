"""Every use of a feature is found, with its place."""

import pytest

from swarmdsl.codegen.api import ALL_FEATURES, Feature
from swarmdsl.codegen.features import unsupported, used_features

MODEL = """
action m/Work {
  goal { distance : float64 }
  result { distance : float64 }
}
message m/Level { level : float64 }
function work : abstraction { action "work" : m/Work }
event Low : m/Level
swarm event Told : m/Level
statemachine M {
  param far : float64 = 1.0
  var got : float64
  initial Plain
  state Plain {
    defer Told
    on member_lost
      [present() < 2 and neighbors within 3 m < 2 and in(Plain) and elapsed() > 1 s] -> Work
    on Low / send Low(level = got) after 2 s, cancel Low -> Work
  }
  state Work {
    do work(distance = far + self.index) gives (distance => got)
    on succeeded -> Decide
    on aborted   -> Decide
    on Low [event.level < 2.0] / got = event.level, send Low(level = got) -> Decide
    on Told [event.sender == ""] / send Told to uav[0] -> Decide
    after 3 s -> Decide
  }
  choice Decide {
    [got < 1.0] -> Box
    else -> Both
  }
  state Box {
    initial In
    state In {
      on Low -> End
    }
    history Back -> In
    entry / got = 2.0
    exit / got = 3.0
    internal on Low -> In
    on Low / got = 4.0
    [got > 9.0] -> Both
  }
  parallel state Both {
    region A {
      initial A1
      state A1 {
        do work(by make_goal) gives by take_result
        on succeeded -> A2
        on aborted   -> A2
      }
      final A2
    }
    on A.done -> End
  }
  final End
}
"""


@pytest.fixture
def found(compiled) -> dict[Feature, list[str]]:
    by_feature: dict[Feature, list[str]] = {}
    for feature, place in used_features(compiled(MODEL)):
        assert place is not None
        by_feature.setdefault(feature, []).append(" ".join(place.text.split()))
    return by_feature


@pytest.mark.parametrize(
    ("feature", "starts"),
    [
        (Feature.PARAM, ["far"]),
        (Feature.VARIABLE, ["got"]),
        (Feature.COMPOSITE, ["Box"]),
        (Feature.PARALLEL, ["Both"]),
        (Feature.CHOICE, ["Decide"]),
        (
            Feature.GUARD,
            [
                "present() < 2 and neighbors within 3 m < 2 and in(Plain) and elapsed() > 1 s",
                "event.level < 2.0",
                'event.sender == ""',
                "got < 1.0",
                "got > 9.0",
            ],
        ),
        (
            Feature.ASSIGNMENT,
            ["got = event.level", "got = 2.0", "got = 3.0", "got = 4.0"],
        ),
        (Feature.SEND, ["send Low(level = got) after 2 s", "send Low", "send Told"]),
        (Feature.DELAYED_SEND, ["2 s", "cancel Low"]),
        (Feature.DEFER, ["Told"]),
        (Feature.TIMEOUT, ["after 3 s"]),
        (Feature.RESULT, ["distance => got"]),
        (Feature.CALLBACK, ["do work(by make_goal) gives by take_result"]),
        (Feature.EVENT_DATA, ["event", "event"]),
        (Feature.SENDER, ["event.sender"]),
        (Feature.ADDRESS, ["uav[0]"]),
        (Feature.SELF, ["self.index"]),
        (Feature.MEMBER_EVENT, ["member_lost"]),
        (Feature.PRESENT, ["present()"]),
        (Feature.NEIGHBORS, ["neighbors within 3 m"]),
        (Feature.IN_STATE, ["in(Plain)"]),
        (Feature.ELAPSED, ["elapsed()"]),
        (Feature.CROSS_LEVEL, ["on Low -> End"]),
        (Feature.INTO_STATE, ["internal on Low -> In"]),
        (Feature.HISTORY, ["Back"]),
        (Feature.ENTRY, ["got = 2.0"]),
        (Feature.EXIT, ["got = 3.0"]),
        (Feature.INTERNAL, ["internal on Low -> In"]),
        (Feature.TARGETLESS, ["on Low / got = 4.0"]),
        (Feature.EVENTLESS, ["[got > 9.0] -> Both"]),
    ],
)
def test_every_use_is_found(found, feature, starts):
    places = found[feature]
    assert len(places) == len(starts)
    for place, start in zip(places, starts, strict=True):
        assert place.startswith(start)


def test_there_is_a_case_for_every_feature(found):
    assert set(found) == set(Feature)


HISTORY = """
event Low  : m/Level
event High : m/Level
endless statemachine M {
  initial Out
  state Out { on High -> Box.Back; on Low -> Box.In }
  state Box {
    initial In
    history Back -> In
    state In { on High -> Out }
    internal on Low -> In
  }
}
"""


@pytest.mark.parametrize(
    ("missing", "places"),
    [
        (
            {Feature.INTO_STATE},
            ["on High -> Box.Back", "on Low -> Box.In", "internal on Low -> In"],
        ),
        (
            {Feature.INTO_STATE, Feature.HISTORY},
            ["on Low -> Box.In", "internal on Low -> In", "Back"],
        ),
        (
            {Feature.INTO_STATE, Feature.INTERNAL},
            ["on High -> Box.Back", "on Low -> Box.In", "internal on Low -> In"],
        ),
        (
            {Feature.INTO_STATE, Feature.INTERNAL, Feature.HISTORY},
            ["on Low -> Box.In", "internal on Low -> In", "Back"],
        ),
    ],
)
def test_one_cause_is_reported_once(compiled, missing, places):
    found = unsupported(compiled(HISTORY).machines, ALL_FEATURES - missing)
    assert [place.text for _, place in found] == places


def test_a_plain_machine_uses_nothing(compiled, examples):
    text = (examples / "minimal" / "blinker.swarm").read_text(encoding="utf-8")
    assert list(used_features(compiled(text))) == []
