"""`swarmc optimize`: the winner, the same history however it came about, and the applied edit."""

from __future__ import annotations

import html
import json
import os
import re
import shlex
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

from .conftest import MODEL, SCENARIO

OPTIMIZE = """
optimize Crew {
  robot.patience in 1 s .. 9 s step 1 s
  count of robot in 1 .. 3
  seed 3
}
"""
FAST = ("--seeds", "20", "--fresh", "20")
KEPT = ("history.jsonl", "results.json", "best.toml", "candidate.json", "parameters.json")


def write(folder: Path, optimize: str = OPTIMIZE, model: str = MODEL) -> list[str]:
    """Write a model with its scenario; return the first words of the command."""
    (folder / "model.swarm").write_text(model + optimize, encoding="utf-8")
    (folder / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
    return ["optimize", str(folder / "model.swarm"), "--scenario", "scenario.toml", *FAST]


@pytest.fixture(scope="module")
def searched(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A search in this process: the folder with the model, and with what was kept in `one`."""
    folder = tmp_path_factory.mktemp("searched")
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert run([*write(folder), "--jobs", "1", "-o", "one"]) == 0
        yield folder
    finally:
        os.chdir(before)


def lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def kept(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in KEPT}


def test_the_best_candidate_wins_and_is_measured_with_fresh_seeds(searched: Path) -> None:
    found = json.loads((searched / "one" / "results.json").read_text(encoding="utf-8"))

    assert found["winner"]["candidate"] == {"count of robot": 3, "robot.patience": "5s"}
    assert found["method"] == "all"
    assert found["tried"] == 27
    low, high = found["winner"]["interval"]
    assert low <= 3 * 0.8 <= high
    assert found["difference"]["better"] == "yes"
    raced = [each for each in lines(searched / "one" / "history.jsonl") if each["stage"] == "race"]
    assert len([each for each in raced if each["round"] == 0]) == 27
    # Those that are worse leave, when there are enough seeds to know.
    assert {"count of robot": 1, "robot.patience": "9s"} in [
        each["candidate"] for each in raced if each.get("left")
    ]
    fresh = {int(seed) for seed in found["winner"]["by_seed"]}
    assert min(fresh) == 1_000_003
    assert fresh == {int(seed) for seed in found["today"]["by_seed"]}
    assert (searched / "one" / "best.toml").read_text(encoding="utf-8") == (
        '[count]\nrobot = 3\n\n[params.robot]\npatience = "5s"\n'
    )
    assert json.loads((searched / "one" / "candidate.json").read_text(encoding="utf-8")) == [
        {"name": "robot", "meta": "command_line", "value": 3},
        {"name": "patience", "meta": "file:test_behavior", "value": 5.0},
    ]
    # What the orchestrator of CPSwarm writes at the end, and reads before a search.
    package = (searched / "one" / "test_behavior.yaml").read_text(encoding="utf-8")
    assert package == "patience: 5.0\n"
    frevo = json.loads((searched / "one" / "frevoConfiguration.json").read_text(encoding="utf-8"))
    varied = {each["name"]: each for each in frevo["representationBuilder"]["parameters"]}
    assert (varied["robot"]["minimum"], varied["robot"]["maximum"]) == (1, 3)
    assert (varied["patience"]["maximum"], frevo["evolutionSeed"]) == (9, 3)


def test_kept_runs_are_about_the_goal_of_the_search(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    model = MODEL.replace("maximize good - ", "minimize ")
    optimize = "optimize Crew { robot.patience in 5 s .. 9 s step 4 s }"
    words = [*write(tmp_path, optimize, model), "--jobs", "1", "-o", "out"]
    assert run(words) == 0
    assert "winner: robot.patience = 5s" in capsys.readouterr().out

    assert run(["results", "out"]) == 0
    groups = capsys.readouterr().out.splitlines()
    (best,) = (line.split()[0] for line in groups if "5s" in line)
    (worst,) = (line.split()[0] for line in groups if "9s" in line)
    assert run(["results", "out", "--compare", best, worst]) == 0
    said = capsys.readouterr().out
    assert f"fitness, to minimize: {best} is better than {worst}: yes" in said


def test_a_search_that_is_killed_goes_on_to_the_same_bytes(
    searched: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two processes, a `kill -9` of the main one, and the rest in this one."""
    code = "import sys; from swarmdsl.cli import run; sys.exit(run(sys.argv[1:]))"
    words = [sys.executable, "-c", code, *write(searched), "--jobs", "2", "-o", "killed"]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, cwd=searched)
    store = searched / "killed" / "runs.sqlite"
    try:
        while _runs(store) < 20:
            assert process.poll() is None, "it ended before it was killed"
            time.sleep(0.02)
    finally:
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
    before = _runs(store)
    whole = len((searched / "one" / "history.jsonl").read_text().splitlines())
    assert before < 27 * 5 + whole

    assert run([*write(searched), "--jobs", "1", "-o", "killed"]) == 1
    assert "error[SW1801]" in capsys.readouterr().err
    assert run([*write(searched), "--jobs", "1", "-o", "killed", "--resume"]) == 0

    assert kept(searched / "killed") == kept(searched / "one")
    assert _runs(store) == _runs(searched / "one" / "runs.sqlite")


def _runs(path: Path) -> int:
    """Read a store while another process writes it."""
    if not path.exists():
        return 0
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    try:
        (count,) = database.execute("select count(*) from runs").fetchone()
    except sqlite3.OperationalError:
        return 0
    finally:
        database.close()
    return int(count)


def test_a_method_finds_what_all_candidates_find(
    searched: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*write(searched), "--jobs", "1", "--method", "cma", "--evaluations", "60"]
    assert run([*words, "--json", "--feed", "feed.jsonl"]) == 0

    found = json.loads(capsys.readouterr().out)
    assert found["winner"]["candidate"] == {"count of robot": 3, "robot.patience": "5s"}
    assert found["tried"] == 60
    fed = lines(searched / "feed.jsonl")
    assert [fed[0]["event"], fed[-1]["event"]] == ["begin", "end"]
    assert {line["event"] for line in fed} == {"begin", "evaluation", "runs", "end"}
    done = [line["done"] for line in fed if line["event"] == "runs"]
    assert done == sorted(done)


def test_properties_are_kept_or_there_is_no_winner(
    searched: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fine = OPTIMIZE.replace("seed 3", "subject to Fine; seed 3")
    assert run([*write(searched, fine), "--jobs", "1"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1807]: no candidate is possible: `Fine` is violated in" in said

    early = "property Early of Crew : all robot in Good within 9 s at least 0.1\n"
    late = "property Late of Crew : some robot in Wait at most 1 times\n"
    words = write(searched, early + late + OPTIMIZE)
    assert run([*words, "--jobs", "1", "--subject-to", "Early"]) == 1
    assert "`Early` has a chance" in capsys.readouterr().err
    assert run([*words, "--jobs", "1", "--subject-to", "Lat"]) == 1
    assert "did you mean `Late`?" in capsys.readouterr().err
    assert run([*words, "--jobs", "1", "--subject-to", "Late"]) == 0
    assert "winner: count of robot = 3, robot.patience = 5s" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--resume"], "`--resume` needs `-o`"),
        (["--jobs", "2", "--cluster", "tcp://a:1"], "`--jobs` and `--cluster` conflict"),
        (["--scenario", "a.toml", "--scenario", "a.toml"], "is given twice"),
        (["--format", "sarif", "--json"], "both print"),
        (["--cluster", "moon"], "error[SW1803]"),
        (["--scenario", "none.toml"], "error[SW0001]"),
        (["--scenario", "odd.toml"], "--> odd.toml:1:9"),
        (["--scenario", "bad.toml"], "--> bad.toml:2:1"),
    ],
)
def test_what_makes_no_sense_is_reported(
    arguments: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path)
    Path("odd.toml").write_text("until = = 3", encoding="utf-8")
    Path("bad.toml").write_text("[network]\nlos = 3", encoding="utf-8")

    assert run(["optimize", "model.swarm", *arguments]) in (1, 2)
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("model", "reason"),
    [
        (MODEL, "no `optimize`"),
        (
            MODEL.replace("= total", "")
            .replace("= count(robot in Good)", "")
            .replace("= max each robot : time(in Wait)", "")
            + OPTIMIZE,
            "no fitness",
        ),
        (MODEL + "optimize Crew { seed 1 }", "no range"),
    ],
)
def test_a_swarm_that_has_nothing_to_optimize_is_reported(
    model: str,
    reason: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)

    assert run([*write(tmp_path, "", model), "--jobs", "1"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1806]" in said
    assert reason in said


def test_a_missing_package_is_named(
    searched: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from swarmdsl.execution.experiments.search import methods

    monkeypatch.setattr(methods, "find_spec", lambda _name: None)
    assert run([*write(searched), "--jobs", "1", "--method", "tpe"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1810]: `--method tpe` needs package `optuna`" in said
    assert "swarmdsl[tpe]" in said


def test_ctrl_c_ends_with_what_there_is(
    searched: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from swarmdsl.execution.experiments.search.optimizing import Search

    def interrupted(self: Search, _finals: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Search, "_measure", interrupted)
    assert run([*write(searched), "--jobs", "1", "-o", "cut"]) == 130
    said = capsys.readouterr().err
    assert "interrupted, after 27 candidates; the best so far: 2.75 with count of robot = 3" in said
    monkeypatch.undo()
    os.chdir(searched)
    assert run([*write(searched), "--jobs", "1", "-o", "cut", "--resume"]) == 0
    assert kept(searched / "cut") == kept(searched / "one")


def test_the_page_shows_the_search_and_plays_its_worst_runs(
    searched: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = (searched / "one" / "report.html").read_text(encoding="utf-8")
    titles = re.findall("<h2>(.*?)</h2>", page)
    fresh = "The winner on fresh seeds"
    assert titles == [
        "Convergence",
        "Candidates",
        "What matters for Worth",
        fresh,
        "Runs worth a look",
    ]
    importance = data(searched / "one")["importance"]
    assert importance["count of robot"] > importance["robot.patience"] > 0.1
    # All candidates are there, the winner and the model as it is among them.
    assert page.count('<polyline class="path') == 9 * 3
    assert page.count('class="path best"') == page.count('class="path today"') == 1
    command = html.unescape(re.findall(r"<code>(swarmc simulate.*?)</code>", page)[0])
    *words, seed = shlex.split(command)[1:]
    worst = min(data(searched / "one")["winner"]["by_seed"].items(), key=lambda each: each[1])
    assert worst[0] == seed
    # A property of the model may be violated in this run.
    assert run([*words, seed, "--trace", "none", "--results", "played.json"]) in (0, 1)
    assert 'id="recording"' in Path(words[words.index("--play") + 1]).read_text(encoding="utf-8")
    capsys.readouterr()
    played = json.loads(Path("played.json").read_text(encoding="utf-8"))
    assert played["fitness"]["value"] == worst[1]


def data(folder: Path) -> Any:
    return json.loads((folder / "results.json").read_text(encoding="utf-8"))
