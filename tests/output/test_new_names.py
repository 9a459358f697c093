"""Elements of the model that get another name: the files of the user move with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import fits

from .builds import build, names, skeleton, tree


def test_a_new_name_is_recognized(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise", "input pose: Pose"))
    file = tmp_path / "t/rise/rise.py"
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    climb = skeleton("climb", "input pose: Pose")
    land = skeleton("land", "input state: State")
    found = build(tmp_path, *climb, *land, command=("swarmc", "build", "m.swarm"))

    assert names(found) == ["parked-code", "renamed-element"]
    assert found[1][1].message == "`rise` seems to have been renamed to `climb`"
    assert "`swarmc build m.swarm --rename rise=climb`" in str(found[1][1].help)
    assert names(build(tmp_path, *climb, *land)) == []


def test_what_may_be_two_is_not_guessed(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    file = tmp_path / "t/rise/rise.py"
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")

    assert names(build(tmp_path, *skeleton("climb"), *skeleton("land"))) == ["parked-code"]


@pytest.mark.parametrize("before", [False, True], ids=["at once", "after a build"])
def test_files_move_to_the_new_name(tmp_path: Path, before: bool) -> None:
    build(tmp_path, *skeleton("rise"))
    folder = tmp_path / "t/rise"
    mine = (folder / "rise.py").read_text().replace(" pass", " def rise(self): pass  # Rise")
    (folder / "rise.py").write_text(f"import math\n{mine}", encoding="utf-8")
    (folder / "base.py").write_text("class RiseBase:\n  1\n\n\n# mine\n", encoding="utf-8")
    (folder / "more_rise.txt").write_text("all mine\n", encoding="utf-8")
    (folder / "more_climb.txt").write_text("mine too\n", encoding="utf-8")
    if before:
        build(tmp_path, *skeleton("climb"))
    written, found = build(tmp_path, *skeleton("climb"), renames=(("rise", "climb"),))

    assert written is not None
    assert tree(tmp_path) == {
        "t/climb/climb.py": (
            f"import math\n# {fits(['class Climb'])}\nfrom climb.base import ClimbBase\n"
            "class Climb(ClimbBase):\n def rise(self): pass  # Climb\n"
        ),
        "t/climb/base.py": "class ClimbBase:\n  1\n\n\n# mine\n",
        "t/climb/more_climb.txt": "mine too\n",
        "t/rise/more_rise.txt": "all mine\n",
    }
    told = {each.name: each for each in found}
    assert set(told) == {"edited-output", "old-name"}
    place = told["old-name"].primary
    assert place is not None
    assert (place.span.line, place.span.text) == (5, "rise")
    assert (
        told["old-name"].help == "write `climb` where the element is meant; this is reported once"
    )
    # Of the next build nothing of this is left.
    again, found = build(tmp_path, *skeleton("climb"))
    assert again is not None
    assert again.changes == ()
    assert [each.name for each in found] == ["edited-output"]


def test_regions_move_to_the_new_name(tmp_path: Path) -> None:
    def file(name: str) -> OutputFile:
        marks = f"# swarmc:begin {name}.more\n# swarmc:end {name}.more\n"
        return OutputFile(f"{name}/CMakeLists.txt", f"project({name})\n{marks}", owner=name)

    build(tmp_path, file("rise"))
    place = tmp_path / "t/rise/CMakeLists.txt"
    place.write_text(place.read_text().replace("# swarmc:end", "mine\n# swarmc:end"), "utf-8")
    _, found = build(tmp_path, file("climb"), renames=(("rise", "climb"),))

    assert found == []
    assert tree(tmp_path) == {
        "t/climb/CMakeLists.txt": (
            "project(climb)\n# swarmc:begin climb.more\nmine\n# swarmc:end climb.more\n"
        )
    }


@pytest.mark.parametrize(
    ("rename", "fault"),
    [
        (("rise", "clim"), "nothing is generated for `clim`"),
        (("ris", "climb"), "nothing was generated for `ris`"),
        (("land", "climb"), "the model still has `land`"),
    ],
)
def test_a_rename_that_cannot_be_meant(tmp_path: Path, rename: tuple[str, str], fault: str) -> None:
    build(tmp_path, *skeleton("rise"), *skeleton("land"))
    before = tree(tmp_path)
    written, (found,) = build(tmp_path, *skeleton("climb"), *skeleton("land"), renames=(rename,))

    assert written is None
    assert found.name == "bad-rename"
    assert fault in found.message
    assert tree(tmp_path) == before


def test_a_rename_does_not_overwrite_what_was_filled_in(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    (tmp_path / "t/rise/rise.py").write_text("mine\n", encoding="utf-8")
    build(tmp_path, *skeleton("climb"))
    (tmp_path / "t/climb/climb.py").write_text("mine too\n", encoding="utf-8")
    before = tree(tmp_path)
    written, (found,) = build(tmp_path, *skeleton("climb"), renames=(("rise", "climb"),))

    assert written is None
    assert found.name == "bad-rename"
    assert tree(tmp_path) == before
