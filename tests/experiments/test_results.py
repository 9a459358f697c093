"""Kept runs: listed, filtered, compared and exported."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run as run_command
from swarmdsl.execution.experiments.results.conditions import read_condition
from swarmdsl.execution.experiments.results.export import _different, _kind
from swarmdsl.execution.experiments.results.records import Record
from swarmdsl.execution.experiments.store import FILE, Key, Store
from swarmdsl.execution.experiments.task import Candidate, Row

Run = Callable[..., tuple[int, str]]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Two groups of runs: with 4 robots they are better by about 1, and one run has failed."""
    monkeypatch.chdir(tmp_path)
    with Store(Path("out", FILE)) as store:
        for count in (2, 4):
            candidate = Candidate.of({"count of robot": count, "robot.patience": "30s"})
            rows = [
                Row(
                    candidate,
                    "=calm.toml",
                    seed,
                    {"waited": count * 1.5},
                    count / 2 + seed % 3 / 10 + (count == 4 and seed % 2) / 10,
                    {"Fine": "false" if seed == 1 else "true"},
                    failure="it does not end" if (count, seed) == (4, 7) else None,
                )
                for seed in range(8)
            ]
            store.add(Key("0123456789abcdef", "=calm.toml", "t", candidate), rows, "1")

    def run(*words: str) -> tuple[int, str]:
        code = run_command(["results", "out", *words])
        captured = capsys.readouterr()
        return code, captured.out + captured.err

    return run


def test_groups_are_listed_with_their_means(run: Run) -> None:
    code, text = run("--json")
    assert code == 0
    first, second = json.loads(text)
    assert (first["count of robot"], first["runs"], first["failed"]) == (2, 8, 0)
    assert first["fitness"] == pytest.approx(1 + 0.7 / 8)
    assert (second["failed"], second["model"]) == (1, "0123456789ab")
    code, text = run()
    assert "16 runs in 2 groups" in text
    code, text = run("--measure", "Fine", "--json")
    assert [each["Fine"] for each in json.loads(text)] == [7 / 8, 7 / 8]
    # The interval of a probability is inside of 0 and 1.
    assert [each["interval"] for each in json.loads(text)] == ["0.47349 .. 0.99684"] * 2


def test_a_scenario_that_has_changed_makes_other_groups(run: Run) -> None:
    candidate = Candidate.of({"count of robot": 2, "robot.patience": "30s"})
    with Store(Path("out", FILE), is_new=False) as store:
        key = Key("0123456789abcdef", "=calm.toml", "u", candidate)
        store.add(key, [Row(candidate, "=calm.toml", 0, {"waited": 1.0}, 9.0)], "1")
    groups = json.loads(run("--json")[1])
    assert [each["runs"] for each in groups] == [8, 8, 1]
    assert groups[2]["fitness"] == 9


def test_runs_are_filtered(run: Run) -> None:
    code, text = run("--runs", "--where", "count of robot > 3", "--where", "seed<=2", "--json")
    assert code == 0
    assert [(each["group"], each["seed"]) for each in json.loads(text)] == [(2, 0), (2, 1), (2, 2)]
    code, text = run("--where", "count of robots > 3")
    assert code == 1
    assert "did you mean `count of robot`?" in text


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("robot.patience >= 30 s", True),
        ("robot.patience < 0.4 min", False),
        ("Fine = false", True),
        ("kind = old", True),
        ("kind != old", False),
        ("waited > 2", True),
        ("missing = 3", False),
        ("missing != 3", True),
        ("seed == 5", True),
        ("failure = ", False),
        ("kind < 3", False),
        ("wide = true", True),
    ],
)
def test_conditions(text: str, holds: bool) -> None:
    settings = {"robot.patience": "30s", "kind": "old", "wide": True}
    record = Record(1, "m", "s", settings, 5, 1.0, {"waited": 2.5}, {"Fine": "false"}, None, 0.1)
    condition = read_condition(text)
    assert condition is not None
    assert condition.holds(record) is holds


def test_a_condition_without_a_sign_is_refused(run: Run) -> None:
    code, text = run("--where", "seed")
    assert code == 2
    assert "`seed` is no condition like" in text


def test_groups_are_compared_by_pairs_of_seeds(run: Run) -> None:
    code, text = run("--compare", "2", "1", "--json")
    found = json.loads(text)
    assert (code, found["better"], found["paired"], found["runs"]) == (0, "yes", True, 8)
    assert found["difference"] == pytest.approx(1.05)
    code, text = run("--compare", "2", "1", "--goal", "minimize")
    assert text.startswith("fitness, to minimize: 2 is better than 1: no (difference 1.05")
    code, text = run("--compare", "2", "7")
    assert code == 1
    assert "groups have the numbers 1 to 2" in text


def test_csv_has_all_runs_and_no_formula(run: Run) -> None:
    code, text = run("--export", "runs.csv")
    assert (code, text) == (0, "16 runs written: runs.csv\n")
    with Path("runs.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 16
    assert rows[0]["scenario"] == "'=calm.toml"
    assert float(rows[1]["fitness"]) == 1.1
    assert (rows[1]["Fine"], rows[1]["count of robot"], rows[1]["seed"]) == ("false", "2", "1")
    assert [row["seed"] for row in rows if row["failure"]] == ["7"]
    code, text = run("--export", "runs.xlsx")
    assert code == 2
    assert "does not end with `.csv`" in text


def test_parquet_has_columns_with_types(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    arro3 = pytest.importorskip("arro3.io", reason="no arro3-io: pip install -e '.[dev]'")
    code, text = run("--export", "runs.parquet")
    assert (code, text) == (0, "16 runs written: runs.parquet\n")
    table = arro3.read_parquet("runs.parquet").read_all()
    types = {field.name: str(field.type).split(".")[-1] for field in table.schema}
    rows = [
        {name: table[name][at].as_py() for name in table.column_names}
        for at in range(table.num_rows)
    ]

    assert len(rows) == 16
    assert rows[1]["scenario"] == "=calm.toml"
    assert (rows[1]["fitness"], rows[1]["seed"], rows[1]["count of robot"]) == (1.1, 1, 2)
    assert {row["seed"] for row in rows if row["failure"] is not None} == {7}
    assert {name for name in types if "Int64" in types[name]} == {"seed", "count of robot"}
    assert {name for name in types if "Float64" in types[name]} == {"fitness", "waited", "seconds"}
    run("--export", "none.parquet", "--where", "seed > 99")
    assert arro3.read_parquet("none.parquet").read_all().num_rows == 0

    monkeypatch.setitem(sys.modules, "arro3.io", None)
    code, text = run("--export", "other.parquet")
    assert code == 1
    assert "error[SW1810]: `--export other.parquet` needs package `arro3-io`" in text
    assert not Path("other.parquet").exists()


def test_columns_of_parquet_have_one_type_and_different_names() -> None:
    assert [_kind(each) for each in ([1, None], [1, 2.5], [True], [True, 1], [2**63], [])] == [
        *(int, float, bool, str, float, str)
    ]
    assert _different(["seed", "a", "seed", "seed 2"]) == ["seed", "a", "seed 2", "seed 2 2"]


def test_a_folder_without_runs_is_told(run: Run) -> None:
    assert run_command(["results", "nowhere"]) == 1


def test_a_folder_that_others_wrote_is_told(run: Run) -> None:
    with Store(Path("out", FILE), is_new=False) as store:
        store._database.execute("update runs set row = '[]' where seed = 3")
        store._database.commit()
    code, text = run()
    assert code == 1
    assert "error[SW1802]: cannot read runs in `out/runs.sqlite`" in text
