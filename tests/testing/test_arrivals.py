"""Events on their way that a test lets arrive, or loses."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import Ran

DARK = (
    '{ send = "Start", to = "lamp" }, '
    '{ end = "blink", of = "lamp[0]", result = { count = 3 } }, '
    '{ who = "lamp[0]", sends = "Ping" }'
)


def it(steps: str, more: str = "") -> str:
    return f'[[test]]\nname = "it"\n{more}steps = [{steps}]\n'


def test_an_event_waits_until_it_is_heard(ran: Callable[..., Ran]) -> None:
    found = ran(
        it(
            f"{DARK}, "
            '{ who = "lamp[1].eye", in = "Off", for = "5 s" }, '
            '{ who = "lamp[2].eye", in = "Awake" }, '
            '{ hear = "Ping", by = "lamp[1]", from = "lamp[0]" }, '
            '{ who = "lamp[1].eye", in = "Awake" }'
        )
    )
    assert found.code == 0, found.out


def test_an_event_is_lost_for_one_robot(ran: Callable[..., Ran]) -> None:
    found = ran(
        it(
            f"{DARK}, "
            '{ drop = "Ping", by = "lamp[1]" }, '
            '{ who = "lamp[1].eye", in = "Off", for = "20 s" }, '
            '{ who = "lamp[2].eye", in = "Awake" }'
        )
    )
    assert found.code == 0, found.out


def test_the_rest_arrives_after_the_last_step(ran: Callable[..., Ran]) -> None:
    both = DARK + ', { end = "blink", of = "lamp[1]", result = { count = 3 } }'
    found = ran(
        it(
            f"{both}, "
            '{ drop = "Ping", by = "lamp[2]", from = "lamp[1]" }, '
            '{ who = "lamp[2].eye", in = "Awake" }'
        )
    )
    assert found.code == 0, found.out
    found = ran(
        it(
            f"{both}, "
            '{ drop = "Ping", by = "lamp[2]", from = "lamp[1]" }, '
            '{ drop = "Ping", by = "lamp[2]", from = "lamp[0]" }, '
            '{ who = "lamp[2].eye", in = "Off" }'
        )
    )
    assert found.code == 0, found.out


@pytest.mark.parametrize("verb", ["hear", "drop"])
def test_an_event_that_is_not_on_its_way(ran: Callable[..., Ran], verb: str) -> None:
    step = f'{{ {verb} = "Ping", by = "lamp[1]", from = "lamp[0]" }}'
    failed = ran(it(step))
    skipped = ran(it(step, 'impossible = "skip"\n'))

    assert failed.code == 1
    assert "expected `Ping` of `lamp[0]` to be on its way to `lamp[1]`" in failed.out
    assert "it is not on its way" in failed.out
    assert skipped.code == 0
    assert "ok      it (1 impossible action skipped)" in skipped.out


def test_an_end_that_is_impossible_is_skipped(ran: Callable[..., Ran]) -> None:
    step = '{ end = "blink", of = "lamp[0]" }, { all = "lamp", in = "Off" }'

    assert ran(it(step)).code == 1
    assert "1 impossible action skipped" in ran(it(step, 'impossible = "skip"\n')).out


def test_a_lost_robot_hears_nothing(ran: Callable[..., Ran]) -> None:
    found = ran(it(f'{DARK}, {{ lose = "lamp[1]" }}, {{ hear = "Ping", by = "lamp[1]" }}'))
    assert "`Ping` to be on its way to `lamp[1]`" in found.out


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ('{ hear = "Ping" }', "missing key `by`"),
        ('{ hear = "Ping", by = "lamb[1]" }', "did you mean `lamp[1]`?"),
        ('{ hear = "Pong", by = "lamp[1]" }', "did you mean `Ping`?"),
        ('{ hear = "Ping", by = "lamp[1]", from = "spare" }', "no robot called `spare`"),
        ('{ hear = "Button", by = "lamp[1]" }', "let it arrive from outside with `send`"),
        ('{ drop = "Start", by = "lamp[1]" }', "`Lamps` never sends `Start`"),
        ('{ hear = "Ping", by = "lamp[1]", of = "lamp" }', "a step with `hear` has no key `of`"),
        ('{ hear = 3, by = "lamp[1]" }', "the name of an event"),
    ],
)
def test_wrong_steps_are_told(ran: Callable[..., Ran], step: str, told: str) -> None:
    found = ran(it(step))

    assert found.code == 1
    assert told in found.out


def test_a_reliable_event_is_heard_but_not_dropped(ran: Callable[..., Ran], folder: Path) -> None:
    model = folder / "lamps.swarm"
    declared = "swarm event Ping  : std_msgs/Empty"
    text = model.read_text(encoding="utf-8").replace(declared, f"{declared} {{ reliable }}")
    model.write_text(text, encoding="utf-8")

    dropped = ran(it(f'{DARK}, {{ drop = "Ping", by = "lamp[1]" }}'))
    assert "`Ping` is reliable: it is not lost" in dropped.out
    awake = '{ who = "lamp[1].eye", in = "Awake" }'
    assert ran(it(f'{DARK}, {{ hear = "Ping", by = "lamp[1]" }}, {awake}')).code == 0


def test_no_event_overtakes_another_one_of_its_topic(ran: Callable[..., Ran], folder: Path) -> None:
    text = """package lamps
swarm event Go   : std_msgs/Empty on "lights"
swarm event Stop : std_msgs/Empty on "lights"
endless statemachine Leading {
  initial Ready
  state Ready {
    entry / send Go, send Stop
    on Go -> Ready
    on Stop -> Done
  }
  state Done {}
}
member Lamp { behavior Leading }
swarm Lamps { lamp : Lamp[2] }
"""
    (folder / "lamps.swarm").write_text(text, encoding="utf-8")
    go = '{ hear = "Go", by = "lamp[1]" }'
    stop = '{ hear = "Stop", by = "lamp[1]" }'

    assert "`Go` of the same sender arrives before it" in ran(it(f"{stop}, {go}")).out
    assert ran(it(f"{go}, {stop}")).code == 0


def test_impossible_is_fail_or_skip(ran: Callable[..., Ran]) -> None:
    assert "did you mean `skip`?" in ran(it('{ pass = "1 s" }', 'impossible = "skips"\n')).out
