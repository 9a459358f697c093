"""Output of a run beside its trace: summary, timeline, board."""

from __future__ import annotations

import itertools
import math
import re
from io import StringIO
from pathlib import Path
from xml.etree import ElementTree

import pytest
from rich.console import Console

from swarmdsl.execution.engine import Activity, Kind, Machine, State, Transition
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.packets import Transmission
from swarmdsl.execution.simulate.pictures.state_colours import Meaning, nth_colour, state_colours
from swarmdsl.execution.simulate.pictures.timeline import Timeline
from swarmdsl.execution.simulate.run.live_table import Board
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration, format_duration
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.line import Line

from .conftest import Simulate

SVG = "{http://www.w3.org/2000/svg}"
SWARM = """
statemachine Work {
  initial Wait
  state Wait { on Start -> Busy; on Stop -> End }
  parallel state Busy {
    region Do {
      initial Go
      state Go { do go(speed = 1.0); on succeeded -> Tell; on aborted -> Rest }
      state Rest { after 2 s -> Go }
      state Tell { entry / send Found }
    }
    region Hear {
      initial Quiet
      state Quiet { on Found -> Loud }
      state Loud  { on Stop -> Quiet }
    }
  }
  final End
}
member Uav { behavior Work }
swarm S { uav : Uav[2] }
"""
SCENARIO = """
until = "10 s"
[functions.go]
of."uav[0]".duration = "4 s"
of."uav[1]".duration = "8 s"
[[messages]]
event = "Start"
at    = "2 s"
[[messages]]
event = "Stop"
at    = "30 s"
[[faults]]
at   = "9 s"
lost = "uav[1]"
"""


def test_what_all_wait_for(simulate: Simulate) -> None:
    alone = simulate(SWARM, "--trace", "none")
    Path("swarm.toml").write_text('[project]\nname = "s"\n', encoding="utf-8")
    Path("other.toml").write_text("[tool]\n", encoding="utf-8")
    Path("plays").mkdir()
    Path("plays/mission.toml").write_text(SCENARIO, encoding="utf-8")

    in_project = simulate(SWARM, "--trace", "none")
    played = simulate(SWARM, "--trace", "none", "--scenario", "plays/mission.toml")

    assert alone.err.splitlines()[-1] == (
        "all wait for `Start` or `Stop`: --events FILE or --scenario FILE"
    )
    assert in_project.err.endswith(": --events FILE or --scenario plays/mission.toml\n")
    assert "all wait" not in played.err


def test_the_summary(simulate: Simulate) -> None:
    ran = simulate(SWARM, "--trace", "none", scenario=SCENARIO)

    assert (ran.code, ran.out) == (0, "")
    lines = [line.rstrip() for line in ran.err.splitlines()]
    assert lines[0] == "S, 2 members: 10 s of virtual time, until the time was over"
    assert lines[2:5] == [
        "member  in the end                     since",
        "uav[0]  Busy.Do.Tell, Busy.Hear.Quiet    6 s",
        "uav[1]  lost                             9 s",
    ]
    rows = {line.split("  ")[0]: line.split()[-1] for line in lines if line}
    shares = dict(re.findall(r"Work: (\S+) +([\d.]+) %", ran.err))
    # Of 10 s and 9 s: both wait for 2 s, go for 4 s and 7 s, and hear after 6 s.
    seconds = {
        "Wait": 2 + 2,
        "Busy.Do.Go": 4 + 7,
        "Busy.Do.Tell": 4,
        "Busy.Hear.Quiet": 8 + 4,
        "Busy.Hear.Loud": 3,
    }
    assert shares == {state: f"{100 * time / 19:.1f}" for state, time in seconds.items()}
    assert rows["Work: Wait"] == "2"
    assert "go             2          1        -          -          -           1" in lines
    assert "Found     1      1     -" in lines


def test_events_of_a_robot_itself_are_not_counted_as_unheard(simulate: Simulate) -> None:
    local = "event Late : std_msgs/Empty\n" + SWARM.replace(
        "entry / send Found", "entry / send Found, send Late\n on Late -> Rest"
    )
    ran = simulate(local, "--trace", "none", scenario=SCENARIO)

    lines = [line.rstrip() for line in ran.err.splitlines()]
    assert "Found     1      1     -" in lines
    assert not [line for line in lines if line.startswith("Late")]


def test_coverage_names_what_was_never_seen(simulate: Simulate) -> None:
    ran = simulate(SWARM, scenario=SCENARIO)

    never = re.findall(r"model\.swarm:(\d+): never (entered|taken): (.*)", ran.err)
    text = Path("model.swarm").read_text(encoding="utf-8").splitlines()
    assert [words for _, how, words in never if how == "entered"] == ["Busy.Do.Rest", "End"]
    assert ("taken", "Wait: on Stop -> End") in [(how, words) for _, how, words in never]
    assert ["final End" in text[int(n) - 1] for n, _, words in never if words == "End"] == [True]
    # Of 10 states 8 were entered, and of 7 transitions those on Start, succeeded and Found taken.
    assert f"coverage: {100 * 11 // 17} % of 10 states and 7 transitions\n" in ran.err


def test_nothing_is_missing_when_all_was_seen(simulate: Simulate) -> None:
    text = "statemachine M { initial A; state A { after 1 s -> B } final B }"

    ran = simulate(text, "--trace", "none")
    assert ran.err.splitlines()[-1] == "coverage: 100 % of 2 states and 1 transition"
    assert ran.err.startswith("M, one machine: 1 s of virtual time, until all machines had ended\n")


def bars(svg: str) -> list[tuple[str, float, float]]:
    """Return the title, start and width of each bar."""
    root = ElementTree.fromstring(svg)
    return [
        (bar.findtext(f"{SVG}title") or "", float(bar.attrib["x"]), float(bar.attrib["width"]))
        for bar in root.iter(f"{SVG}rect")
        if bar.get("class") == "bar"
    ]


def test_the_timeline(simulate: Simulate) -> None:
    ran = simulate(SWARM, "--timeline", "a.svg", "--trace-file", "run.jsonl", scenario=SCENARIO)
    assert ran.err.endswith("\n\nwritten: run.jsonl, a.svg\n")
    simulate(SWARM, "--timeline", "b.svg", scenario=SCENARIO)
    svg = Path("a.svg").read_text(encoding="utf-8")

    assert svg == Path("b.svg").read_text(encoding="utf-8")
    assert "hsl" not in svg  # which not all that shows SVG knows
    of_first = [bar for bar in bars(svg) if bar[0].startswith("uav[0]: ")]
    assert [title.split("\n") for title, _, _ in of_first] == [
        ["uav[0]: Wait", "0 ms to 2 s: 2 s"],
        ["uav[0]: Busy.Do.Go", "2 s to 6 s: 4 s"],
        ["uav[0]: Busy.Do.Tell", "6 s to 10 s: 4 s"],
        ["uav[0]: Busy.Hear.Quiet", "2 s to 10 s: 8 s"],
    ]
    assert [round(width) for _, _, width in of_first] == [240, 480, 480, 960]
    assert [t for t, _, _ in bars(svg) if t.startswith("uav[1]: lost")] == [
        "uav[1]: lost\n9 s to 10 s: 1 s"
    ]
    root = ElementTree.fromstring(svg)
    titles = [line.findtext(f"{SVG}title") or "" for line in root.iter(f"{SVG}line")]
    assert [title for title in titles if "uav" in title] == ["Found: uav[0] -> uav[1], 6 s"]
    assert root.findtext(f"{SVG}desc") == "scenario scenario.toml, seed 0"
    words = [text.text for text in root.iter(f"{SVG}text")]
    assert "scenario scenario.toml, seed 0, 10 s, 2 members" in words
    legend = words[words.index("works") :]
    assert legend[:3] == ["works", "waits", "lost member"]
    assert legend[legend.index("Work") + 1] == "Wait"


def test_many_arrows_are_bundled() -> None:
    """One line with a mark for each receiver and fate, and the numbers in its tooltip."""
    robots = [Robot(f"r[{number}]") for number in range(3)]
    cast = [Actor(each.name, each, Machine("M", [State("a")])) for each in robots]
    timeline = Timeline("M", cast)
    for actor in cast:
        timeline.note(Line(0, actor, None, ["a"]))
    first, second, third = robots
    for number in range(276):
        sent = 50 * SECOND + number * SECOND // 1000
        for target in (second, third):
            arrives = number % 3 > 0 or target is second
            timeline.transmitted(Transmission("Offer", first, target, sent, sent + 1, arrives))
        timeline.note(Line(sent + 1, cast[1], "Offer", ["a"], ignored=True))
    timeline.transmitted(Transmission("Far", third, first, 0, 40 * SECOND, arrives=False))
    root = ElementTree.fromstring(timeline.svg(100 * SECOND))

    (comb,) = (g for g in root.iter(f"{SVG}g") if g.get("class") == "comb" and len(g) > 3)
    assert (comb[0].text or "").split("\n") == [
        "552 swarm events of r[0], 50 s to 50.27 s",
        "Offer -> r[1] \N{MULTIPLICATION SIGN}276, ignored",
        "Offer -> r[2] \N{MULTIPLICATION SIGN}92, lost",
        "Offer -> r[2] \N{MULTIPLICATION SIGN}184",
    ]
    marks = [path.get("class") for path in comb.iter(f"{SVG}path")]
    assert marks == ["spine", "ring", "head", "cross"]
    titles = [line.findtext(f"{SVG}title") for line in root.iter(f"{SVG}line")]
    assert "Far: r[2] -> r[0], 0 ms, lost" in titles


# What people see of red, green and blue who lack the receptors for red, or for green: Machado,
# Oliveira and Fernandes, A Physiologically-based Model for Simulation of Color Vision Deficiency,
# 2009.
SIGHTS = {
    "all colours": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "no red": (
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ),
    "no green": (
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.01182, 0.04294, 0.968881),
    ),
}


def light(colour: str) -> list[float]:
    """Red, green and blue of a colour as amounts of light, by sRGB."""
    parts = (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    return [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]


def seen(colour: str, sight: str) -> tuple[float, float, float]:
    """A colour as CIELAB, in which distances are those that a person sees."""
    red, green, blue = (
        max(0.0, sum(a * b for a, b in zip(row, light(colour), strict=True)))
        for row in SIGHTS[sight]
    )
    x = (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505
    y = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    z = (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.089
    a, b, c = (v ** (1 / 3) if v > 0.008856 else 7.787 * v + 16 / 116 for v in (x, y, z))
    return 116 * b - 16, 500 * (a - b), 200 * (b - c)


@pytest.mark.parametrize("meaning", [Meaning.WORKS, Meaning.WAITS])
@pytest.mark.parametrize("sight", SIGHTS)
def test_states_are_told_apart_by_their_colours(sight: str, meaning: Meaning) -> None:
    first = [seen(nth_colour(number, meaning), sight) for number in range(8)]
    least = 10 if meaning is Meaning.WORKS else 6  # pale colours are nearer to each other

    assert min(math.dist(a, b) for a, b in itertools.combinations(first, 2)) > least


def test_letters_can_be_read_on_all_colours() -> None:
    colours = [nth_colour(number, meaning) for meaning in Meaning for number in range(24)]
    weights = (0.2126, 0.7152, 0.0722)

    def brightness(colour: str) -> float:
        return sum(a * b for a, b in zip(weights, light(colour), strict=True)) + 0.05

    assert len(set(colours)) == 24 + 24 + 3
    # Of WCAG 2.2, level AA.
    assert min(map(brightness, colours)) / brightness("#1f2430") > 4.5


def test_the_colour_of_a_state_has_a_meaning() -> None:
    """A strong colour for one with an activity, a pale one without, and grey for a final one."""
    go = Activity("go", "go", {})
    recall = Transition((), ("m.w",))
    inside = (
        State("m.w"),
        State("m.h", Kind.HISTORY, transitions=(recall,)),
        State("m.e", Kind.FINAL),
    )
    states = [State("a"), State("b", activity=go), State("m", states=inside), State("c")]
    colours = state_colours(Machine("M", states))

    assert list(colours) == ["a", "b", "m.w", "m.e", "c"]
    assert colours["a"] == nth_colour(0, Meaning.WAITS)
    assert colours["b"] == nth_colour(1, Meaning.WORKS) == "#ee8866"
    assert colours["c"] == nth_colour(3, Meaning.WAITS)
    assert colours["m.e"] == nth_colour(0, Meaning.ENDED)


def test_names_in_a_timeline_are_text_and_nothing_else() -> None:
    name = "<script>&\"'\x00\ufffe</script>"
    actor = Actor(name, Robot(name), Machine("M<", [State("a>b")]))
    timeline = Timeline(name, [actor])
    timeline.note(Line(0, actor, None, ["a>b"]))
    root = ElementTree.fromstring(timeline.svg(SECOND))

    assert not [element for element in root.iter() if "script" in str(element.tag)]
    assert "<script>&\"'\N{REPLACEMENT CHARACTER}" in (root.findtext(f"{SVG}text") or "")


def test_stays_too_short_to_be_seen_are_drawn_together() -> None:
    actor = Actor(None, Robot(), Machine("M", [State("a"), State("b")]))
    timeline = Timeline("M", [actor])
    for number in range(50_000):
        timeline.note(Line(number * SECOND // 100, actor, "x", ["ab"[number % 2]]))
    svg = timeline.svg(1000 * SECOND)

    assert len(svg) < 200_000
    found = bars(svg)
    assert sum("short stays" in title for title, _, _ in found) > 400
    stays = [title for title, _, _ in found if title.startswith("M: ")]
    assert stays[-1] == "M: b\n8 min 20 s to 16 min 40 s: 8 min 20 s"


def test_a_timeline_that_cannot_be_written(simulate: Simulate) -> None:
    for option in ("--timeline", "--trace-file"):
        ran = simulate(SWARM, option, "none/a.svg", scenario=SCENARIO)
        assert (ran.code, ran.out) == (1, "")
        assert "error[SW0909]: cannot write `none/a.svg`: no such file or directory" in ran.err


def test_a_trace_in_a_file(simulate: Simulate) -> None:
    to_stdout = simulate(SWARM, scenario=SCENARIO)
    to_file = simulate(SWARM, "--trace-file", "trace", scenario=SCENARIO)

    assert (to_file.out, Path("trace").read_text(encoding="utf-8")) == ("", to_stdout.out)


def test_the_board() -> None:
    stream = StringIO()
    console = Console(file=stream, force_terminal=True, width=80, height=12, color_system=None)
    actors = [
        Actor(f"uav[{n}]", Robot(f"uav[{n}]", "uav", "Uav"), Machine("M", [State("a")]))
        for n in range(20)
    ]
    clock = Clock()
    board = Board(actors, clock, 60 * SECOND, console)
    board.note(Line(SECOND, actors[1], "x", ["a", "[red]b"]))
    clock.advance(30 * SECOND)
    console.print(board.drawn())
    lines = [line.rstrip() for line in stream.getvalue().splitlines()]

    assert lines[0].split() == ["member", "is", "in", "since"]
    assert lines[2].split() == ["uav[1]", "a,", "[red]b", "1", "s"]
    assert "and 13 more" in lines[8]
    assert lines[-1].endswith(" 30 s of 1 min 0 s")


@pytest.mark.parametrize(
    ("written", "length", "again"),
    [
        ("850ms", 850_000_000, "850 ms"),
        ("12.5 s", 12_500_000_000, "12.5 s"),
        ("4 min", 240 * SECOND, "4 min 0 s"),
        ("1.5h", 5400 * SECOND, "1 h 30 min"),
        ("59.9999 s", 59_999_900_000, "60 s"),
        ("3", None, ""),
        ("-3 s", None, ""),
        ("1e9 s", None, ""),
        (f"{10**30} s", None, ""),
        ("99999999999 h", None, ""),
    ],
)
def test_durations(written: str, length: int | None, again: str) -> None:
    assert duration(written) == length
    if length is not None:
        assert format_duration(length) == again


def test_no_trace_and_a_file_for_it(simulate: Simulate) -> None:
    ran = simulate(SWARM, "--trace", "none", "--trace-file", "run.jsonl", scenario=SCENARIO)

    assert ran.code == 2
    assert "`--trace none` and `--trace-file` conflict: omit one of them" in ran.err


def test_ignored_events_are_told_and_counted(simulate: Simulate) -> None:
    text = """
    statemachine M {
      var n : int32 = 0
      initial A
      state A { on Start [n > 0] -> B; on Stop / n = n + 1 }
      state B { after 1 s -> End }
      final End
    }
    """
    events = [{"event": name} for name in ("Start", "Start", "Stop", "Start", "Start")]

    ran = simulate(text, events=events)
    told = simulate(text, "--trace", "text", events=events)

    assert [(line["event"], line.get("ignored")) for line in ran.trace] == [
        (None, None),
        ("Start", True),
        ("Start", True),
        ("Stop", None),
        ("Start", None),
        ("Start", True),
        ("after.B.1", None),
    ]
    assert told.out.splitlines()[1:4] == [
        "     0.000  Start (ignored)",
        "     0.000  Start (ignored)",
        "     0.000  Stop",
    ]
    lines = ran.err.splitlines()
    head = lines.index("ignored event  in state  times")
    assert lines[head + 1 : head + 3] == [
        "Start          M: A          2",
        "Start          M: B          1",
    ]
