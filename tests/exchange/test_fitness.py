"""Fitness scripts compute the model's value from a bag and print it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import NoOptions
from swarmdsl.codegen.exchange import fitness
from swarmdsl.ir import System

Compile = Callable[[str], System]
Run = Callable[..., "subprocess.CompletedProcess[str]"]

# What the module of ROS 1 does with a bag that is a list of messages as Python text.
ROSBAG = """
from pathlib import Path


class Time(float):
    def to_sec(self):
        return float(self)


class Message:
    def __init__(self, data):
        self.data = data


class Bag:
    def __init__(self, path):
        self._messages = eval(Path(path).read_text())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def read_messages(self, topics):
        for topic, data in self._messages:
            if topic in topics:
                yield topic, Message(data), None
"""


@pytest.fixture
def run(compiled: Compile, tmp_path: Path) -> Run:
    """Compile a fitness and compute it from messages, pairs of topic and data."""

    def run(model: str, *messages: str) -> subprocess.CompletedProcess[str]:
        report = Diagnostics()
        (file,) = fitness.emit(compiled(model), NoOptions(), report)
        assert not len(report)
        assert (file.path, file.executable) == ("good_run/fitness.py", True)
        (tmp_path / file.path).parent.mkdir()
        (tmp_path / file.path).write_text(file.text, encoding="utf-8")
        (tmp_path / "rosbag.py").write_text(ROSBAG, encoding="utf-8")
        (tmp_path / "run.bag").write_text(f"[{', '.join(messages)}]", encoding="utf-8")
        return subprocess.run(
            [sys.executable, "-W", "error", file.path, "run.bag", "120", "4"],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
            capture_output=True,
            text=True,
            timeout=60,
        )

    return run


RESCUE = """
/// People "found" in time.
fitness GoodRun {
  in found   : int32
  in elapsed : duration
  param limit : duration = 5 min
  param price : float64 = 0.5 * 2
  maximize found * price * (limit - elapsed) / limit
}
"""


def test_the_last_message_counts(run: Run) -> None:
    ran = run(RESCUE, "('/found', 1)", "('/other', 7)", "('elapsed', Time(75))", "('/found', 8)")

    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "fitness=6.0\n", "")


def test_what_is_to_be_small_has_its_sign_changed(run: Run) -> None:
    model = """
    fitness GoodRun { in max : float64; in hops : int32[]; minimize min(max, 2) - len(hops) }
    """
    ran = run(model, "('/max', 4.5)", "('/hops', [1, 2, 3])")

    assert ran.stdout == "fitness=1.0\n"


def test_operators_mean_what_they_do_in_the_language(run: Run) -> None:
    model = """
    fitness GoodRun {
      in a : int32
      in b : int32
      maximize (a - b) - (a - b) % 4 * 10 + a / b + sqrt(abs(-b)) - -2
    }
    """
    ran = run(model, "('/a', 1)", "('/b', 4)")

    assert ran.stdout == "fitness=-8.75\n"


@pytest.mark.parametrize(
    ("messages", "says"),
    [
        (["('/found', 1)"], "no value in run.bag of: elapsed"),
        (["('/found', 10 ** 400)", "('/elapsed', Time(1))"], "the fitness has no value: "),
        (["('/found', float('nan'))", "('/elapsed', Time(1))"], "no value: it is not finite"),
    ],
)
def test_without_a_value_nothing_is_printed(run: Run, messages: list[str], says: str) -> None:
    ran = run(RESCUE, *messages)

    assert (ran.returncode, ran.stdout) == (1, "")
    assert says in ran.stderr
    assert "Traceback" not in ran.stderr


def test_what_cannot_be_measured(compiled: Compile) -> None:
    system = compiled(
        """
        fitness GoodRun {
          in where : geometry_msgs/Pose
          in names : string[]
          in found : int32
          param weight : float64
          maximize found * weight
        }
        """
    )
    report = Diagnostics()

    assert list(fitness.emit(system, NoOptions(), report)) == []
    assert [found.name for found in report] == ["no-place"] * 3
    assert [found.primary.span.text for found in report if found.primary] == [
        "where",
        "names",
        "weight",
    ]
