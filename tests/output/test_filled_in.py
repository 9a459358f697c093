"""Files to fill in: they follow the model until somebody has written in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.codegen.user_code_marks import fits
from swarmdsl.output import Action, texts

from .builds import build, names, plain, skeleton, tree


def test_a_file_to_fill_in_follows_the_model_until_it_is_edited(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float64"))) == []
    file = tmp_path / "t/rise/rise.py"
    assert file.read_text().startswith(f"# {fits(['class Rise', 'goal.height : float64'])}\n")
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    _, (found,) = build(tmp_path, *skeleton("rise", "goal.height : float32", body="return 1"))

    assert found.name == "outdated-code"
    assert found.notes[:2] == ("- goal.height : float64", "+ goal.height : float32")
    assert file.read_text().endswith("mine\n")
    note = tree(tmp_path)["t/rise/rise.py.swarmc-changes"]
    assert "\n    - goal.height : float64\n    + goal.height : float32\n" in note
    assert "\n- pass\n+ return 1\n" in note.replace("-  pass", "- pass").replace(
        "+  return", "+ return"
    )
    # With the new mark the note goes.
    new = fits(["class Rise", "goal.height : float32"])
    old = fits(["class Rise", "goal.height : float64"])
    file.write_text(file.read_text().replace(old, new), encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float32", body="return 1"))) == []
    assert set(tree(tmp_path)) == {"t/rise/rise.py", "t/rise/base.py"}


@pytest.mark.parametrize("texts_there", [True, False], ids=["texts", "no texts"])
def test_a_file_without_its_mark_is_still_known_to_be_outdated(
    tmp_path: Path, texts_there: bool
) -> None:
    build(tmp_path, *skeleton("rise", "goal.height : float64"))
    file = tmp_path / "t/rise/rise.py"
    old = file.read_text()
    mine = old[old.index("\n") + 1 :] + "mine\n"
    file.write_text(mine, encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float64"))) == []
    if not texts_there:
        (tmp_path / texts.NAME).unlink()
    for _ in range(2):
        _, (found,) = build(tmp_path, *skeleton("rise", "goal.height : float32"))
        assert found.name == "outdated-code"
        assert "- goal.height : float64" in found.notes or not texts_there
    mark = fits(["class Rise", "goal.height : float32"])
    assert f"a comment with `{mark}`" in str(found.help)
    file.write_text(f"{mine}# {mark}\n", encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float32"))) == []


def test_what_was_filled_in_is_put_aside_and_comes_back(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"), *skeleton("land"))
    file = tmp_path / "t/rise/rise.py"
    file.chmod(0o640)
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    mine = file.read_text()
    assert names(build(tmp_path, *skeleton("land"))) == ["parked-code"]
    assert set(tree(tmp_path)) == {".parked/t/rise/rise.py", "t/land/land.py", "t/land/base.py"}
    for _ in range(2):
        assert names(build(tmp_path, *skeleton("land"))) == []
    written, found = build(tmp_path, *skeleton("rise"), *skeleton("land"))

    assert written is not None
    assert (found, written.paths(Action.RESTORE)) == ([], ("t/rise/rise.py",))
    assert file.read_text() == mine
    assert file.stat().st_mode & 0o777 == 0o640
    assert not (tmp_path / ".parked").exists()


def test_two_that_are_put_aside_under_one_name(tmp_path: Path) -> None:
    for mine in ("one", "two"):
        build(tmp_path, plain("1"))
        (tmp_path / "t/f").write_text(mine, encoding="utf-8")
        aside = tmp_path / ".parked/t/f"
        if mine == "two":
            aside.parent.mkdir(parents=True, exist_ok=True)
            aside.write_text("one", encoding="utf-8")
        build(tmp_path)
        if mine == "one":
            aside.unlink()
    assert tree(tmp_path) == {".parked/t/f": "one", ".parked/t/f.1": "two"}
