"""Several objectives: the front, what noise lets one say of it, and the point that is applied."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.experiments.search.domination import crowding, dominates, fronts
from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation, Objective
from swarmdsl.execution.experiments.search.front import beside, is_certain, undominated
from swarmdsl.execution.experiments.search.front_search import FoundFront, FrontSearch
from swarmdsl.execution.experiments.search.importance import importances
from swarmdsl.execution.experiments.search.methods import Name, method_of
from swarmdsl.execution.experiments.search.optimizing import Plan
from swarmdsl.execution.experiments.search.space import Dimension, SearchSpace
from swarmdsl.execution.experiments.task import Candidate, Row, Task

from .test_optimize import lines, write

AIM = Aim("maximize", measure="gain", others=(Objective("cost", "minimize"),))


def whole(name: str, most: int) -> Dimension:
    return Dimension(name, "whole", Fraction(0), Fraction(most), Fraction(1))


SPACE = SearchSpace((whole("x", 9), whole("waste", 2)))


def test_fronts_are_those_of_the_definition() -> None:
    chance = Random(5)
    losses = [(chance.randrange(6), chance.randrange(6), chance.randrange(3)) for _ in range(60)]
    left = set(range(60))
    for front in fronts(losses):
        assert set(front) == {
            each for each in left if not any(dominates(losses[o], losses[each]) for o in left)
        }
        left -= set(front)
    assert not left
    assert dominates((1, 2), (1, 3))
    assert not dominates((1, 2), (1, 2))
    room = crowding([(0, 4), (1, 3), (3, 1), (4, 0)], range(4))
    assert room == {0: math.inf, 1: 1.5, 2: 1.5, 3: math.inf}


class Chain:
    """Runs with a known front: more gain costs more, and waste is no good."""

    def __init__(self, noise: float) -> None:
        self.noise = noise

    def run(self, tasks: Sequence[Task]) -> list[list[Row]]:
        return [[self.row(task.candidate, seed) for seed in task.seeds] for task in tasks]

    def row(self, candidate: Candidate, seed: int) -> Row:
        x, waste = candidate.values.get("x", 9), candidate.values.get("waste", 2)
        # The same chance for all with the same x, as with one seed in a simulation.
        noise = Random(f"{seed} {x}").gauss(0, self.noise)
        measured = {"gain": x - waste + noise, "cost": float(x + waste)}
        return Row(candidate, "", seed, measured, 0.0)


def searched(noise: float, salt: int = 0, method: Name = "auto", evaluations: int = 30) -> Any:
    runs: Any = Chain(noise)
    plan = Plan(SPACE, AIM, ("",), method, evaluations, 40, 60, salt)
    said: list[dict[str, Any]] = []
    found = FrontSearch(plan, runs, "", said.append).run_front()
    return found, said


def on_front(found: FoundFront) -> list[dict[str, Any]]:
    return [each.evaluation.candidate.values for each in found.points]


def test_the_front_is_found_and_only_what_is_clearly_dominated_leaves() -> None:
    true = [{"x": x, "waste": 0} for x in reversed(range(10))]
    found, said = searched(0.3)
    assert on_front(found) == true
    assert {each.is_certain for each in found.points} == {True}
    # Today, x = 9 and waste = 2, has the gain of x = 7.
    today = [each.dominates_today for each in found.points]
    assert today[:2] + today[3:] == ["yes"] * 2 + ["no"] * 7
    assert set(said[0]["values"]) == {"gain", "cost"}
    left = [each["candidate"] for each in said if each.get("left")]
    assert len(left) == 20
    assert all(each["waste"] > 0 for each in left)

    # With much noise nothing is certain, and 1 search in 20 may lose one of the true front.
    lost = 0
    for salt in range(8):
        found, said = searched(2.0, salt)
        gone = [each["candidate"] for each in said if each.get("left")]
        lost += any(each["waste"] == 0 for each in gone)
    assert lost <= 2
    assert not all(each.is_certain for each in found.points)


def test_candidates_that_are_too_many_for_fresh_seeds_are_counted() -> None:
    aim = Aim("maximize", measure="gain", others=(Objective("cost", "maximize"),))
    runs: Any = Chain(50)
    plan = Plan(SPACE, aim, ("",), "auto", 30, 10, 10)
    found = FrontSearch(plan, runs, "", lambda _line: None).run_front()
    assert (len(found.points) + len(found.near), found.unmeasured) == (20, 10)


def test_certainty_needs_a_clear_advantage_over_each_other_one() -> None:
    def evaluation(name: str, *values: Iterator[tuple[float, float]]) -> Evaluation:
        pairs = dict(enumerate(values[0]))
        return Evaluation(Candidate.of({"x": name}), pairs)  # type: ignore[arg-type]

    def noise(n: int) -> float:
        return 0.1 * math.sin(7.7 * n)

    a = evaluation("a", ((1 + noise(n), 5.0) for n in range(20)))
    b = evaluation("b", ((2 + noise(n + 1), 9.0) for n in range(20)))
    worse = evaluation("c", ((1 - 0.5 + noise(n + 2), 5.0) for n in range(20)))
    same = evaluation("d", ((1 + noise(n + 3), 5.0) for n in range(20)))
    few = evaluation("e", ((1 - 0.5 + noise(n), 5.0) for n in range(6)))
    assert undominated([a, b, worse], AIM, 0.05) == [a, b]
    # In too few runs nothing is settled, and chance may have made things equal.
    assert undominated([a, b, few], AIM, 0.05) == [a, b, few]
    chancy = Aim("maximize", measure="gain", others=(Objective("Safe", "minimize", True),))
    assert undominated([a, b, worse], chancy, 0.05) == [a, b, worse]
    assert is_certain(a, [a, b, worse], AIM, 0.05)
    assert not is_certain(a, [a, b, same], AIM, 0.05)


def test_a_candidate_without_a_difference_is_seldom_called_worse() -> None:
    """To be worse in one of many objectives is enough, so that chance has many occasions."""
    names = "abcd"
    aim = Aim("minimize", measure="a", others=tuple(Objective(n, "minimize") for n in names[1:]))

    def drawn(chance: Random) -> Evaluation:
        values = {seed: tuple(chance.gauss(0, 1) for _ in names) for seed in range(12)}
        return Evaluation(Candidate(), values)

    pairs = [(drawn(chance), drawn(chance)) for chance in map(Random, range(200))]
    answers = [beside(each, today, aim, 0.05) for each, today in pairs]
    assert 1 <= answers.count("no") <= 18
    assert answers.count("yes") <= 1


@pytest.mark.parametrize("method", ["nsga", "tpe"])
def test_methods_reach_the_front_better_than_chance(method: Name) -> None:
    """The problem of C. Fonseca and P. Fleming, 1995, by the area that points dominate."""
    space = SearchSpace(tuple(Dimension(n, "number", Fraction(-4), Fraction(4)) for n in "abc"))

    def losses(point: Sequence[float]) -> tuple[float, float]:
        x = [8 * each - 4 for each in point]
        root = 1 / math.sqrt(3)
        first, second = (
            1 - math.exp(-sum((each - side * root) ** 2 for each in x)) for side in (1, -1)
        )
        return first, second

    def area(name: Name, budget: int) -> float:
        proposing = method_of(name, space, budget, 3, 2)
        found: list[tuple[float, float]] = []
        while len(found) < budget:
            points = proposing.ask(budget - len(found))
            reached = [losses(point) for point in points]
            proposing.tell(points, reached)
            found += reached
        steps = [each / 50 for each in range(50)]
        return (
            sum(any(a <= x and b <= y for a, b in found) for x, y in product(steps, steps))
            / len(steps) ** 2
        )

    budget = 200 if method == "nsga" else 80
    assert area(method, budget) > area("random", budget) + 0.02


def test_importance_is_the_share_of_the_variance() -> None:
    """The values are 3x + y + 0z on a full grid: the variances of x and y are as 9 to 1."""
    space = SearchSpace((whole("x", 4), whole("y", 4), whole("z", 4)))
    observed = [
        (Candidate.of(dict(zip("xyz", point, strict=True))), 3.0 * point[0] + point[1])
        for point in product(range(5), repeat=3)
    ]
    found = importances(observed, space)
    assert [each.setting for each in found] == ["x", "y", "z"]
    assert [each.share for each in found] == pytest.approx([0.9, 0.1, 0.0])
    assert found[0].groups[:2] == (("0", 2.0, 25), ("1", 5.0, 25))
    # A setting that only goes with another one explains nothing by itself; chance explains little.
    chance = Random(1)
    tied = [
        (
            Candidate.of({"x": x, "y": min(max(x + chance.choice((-1, 0, 1)), 0), 4), "z": z}),
            3.0 * x,
        )
        for x, z in product(range(5), repeat=2)
    ]
    shares = {each.setting: each.share for each in importances(tied, space)}
    assert shares["y"] == pytest.approx(0, abs=1e-9)
    # A group for each candidate tells nothing.
    assert [each.share for each in importances(observed[:5], space)] == [None]
    noisy = [(each, chance.random()) for each, _ in observed]
    assert all(each.share is not None and each.share < 0.1 for each in importances(noisy, space))
    assert [each.share for each in importances([(c, 1.0) for c, _ in observed], space)] == [
        None
    ] * 3


OPTIMIZE = "optimize Crew { robot.patience in 1 s .. 3 s step 1 s; count of robot in 1 .. 2 }"
KEPT = ("history.jsonl", "results.json", "front/1.toml", "front/1.json", "parameters.json")


def test_a_front_is_shown_kept_and_applied(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    start = write(tmp_path, OPTIMIZE)
    words = [*start, "--jobs", "1", "--maximize", "good", "--maximize", "Fine"]
    assert run([*words, "-o", "one"]) == 0
    said = capsys.readouterr().out
    assert "maximize good, maximize Fine" in said
    found = data("one")
    front = [each["candidate"] for each in found["front"]]
    # More robots do more, and more of them fail. How long they wait is no matter: of equal
    # candidates, the one that changes less is there.
    assert front == [{"count of robot": 2, "robot.patience": "1s"}, front[1]]
    assert front[1]["count of robot"] == 1
    assert found["importance"]["good"] == pytest.approx({"count of robot": 1, "robot.patience": 0})
    assert set(found["front"][0]["intervals"]) == {"good", "Fine"}
    seeds = {seed for each in found["front"] for seed in each["by_seed"]}
    assert min(map(int, seeds)) == 1_000_000
    page = Path("one/report.html").read_text(encoding="utf-8")
    titles = ["Front", "What matters for good", "What matters for Fine", "Runs worth a look"]
    assert re.findall("<h2>(.*?)</h2>", page) == titles
    assert '<svg xmlns="http://www.w3.org/2000/svg" role="img"' in page
    assert page.count('<circle class="dot"') == len(front) + 3 + 2 + 3 + 2

    # The same bytes again, from what is kept, and with two processes. Points of another front go.
    Path("one/front/9.toml").touch()
    assert run([*words, "-o", "one", "--resume"]) == 0
    two = [*start, "--jobs", "2", "--maximize", "good", "--maximize", "Fine"]
    assert run([*two, "-o", "two"]) == 0
    assert [Path("two", name).read_bytes() for name in KEPT] == [
        Path("one", name).read_bytes() for name in KEPT
    ]
    assert len(list(Path("one/front").iterdir())) == 2 * len(front)
    assert {each["stage"] for each in lines(Path("one/history.jsonl"))} == {
        "race",
        "today",
        "front",
    }
    capsys.readouterr()

    # One point goes into the model.
    before = Path("model.swarm").read_text(encoding="utf-8")
    apply = [*words, "-o", "one", "--resume", "--apply"]
    assert run(apply) == 1
    assert "error[SW1812]: no point is chosen: the front has" in capsys.readouterr().err
    assert run([*apply, "--point", "99"]) == 1
    assert "there is no point 99" in capsys.readouterr().err
    assert Path("model.swarm").read_text(encoding="utf-8") == before
    point = front.index(next(each for each in front if each["count of robot"] == 2)) + 1
    assert run([*apply, "--point", str(point)]) == 0
    assert "robot : Robot[2..6]" in Path("model.swarm").read_text(encoding="utf-8")


def data(folder: str) -> Any:
    return json.loads((Path(folder) / "results.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--maximize", "good", "--minimize", "good"], "an objective is given twice"),
        (["--maximize", "good", "--minimize", "waited", "--method", "cma"], "has one objective"),
        (["--apply", "--point", "1"], "`--point` needs `--apply` and several objectives"),
        (["--maximize", "god", "--minimize", "speed"], "error[SW1824]: `Crew` has no `speed`"),
        (["--maximize", "Worth", "--minimize", "fitness"], "help: it is called `fitness` here"),
    ],
)
def test_objectives_that_make_no_sense_are_reported(
    arguments: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run([*write(tmp_path, OPTIMIZE), "--jobs", "1", *arguments]) in (1, 2)
    assert said in capsys.readouterr().err


def test_one_measure_can_take_the_place_of_the_fitness(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    words = [*write(tmp_path, OPTIMIZE), "--jobs", "1", "--minimize", "waited", "--json"]
    assert run(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["winner"]["candidate"]["robot.patience"] == "1s"
    assert found["fitness"] == {"name": "waited", "goal": "minimize"}
