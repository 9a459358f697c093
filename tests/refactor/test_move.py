"""Declarations that are moved into files of their own."""

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.ir.dump import dump
from swarmdsl.tools.refactor.move_declaration import movable, move_declaration

FIRST = """\
/// The package.
package a

import cpswarm.interfaces.*
import "modes.swarm"

swarm event Go : std_msgs/Empty

// about M
/// Documentation of M.
statemachine M {
  var mode : Mode = Mode.IDLE
  initial A
  state A { on Go [mode == Mode.IDLE] -> B }
  final B
}  // end of M

member R { behavior M }
"""
MODES = "package a\n\nenum Mode { IDLE, BUSY }\n"
OTHER = """\
package b

import "../first.swarm"

member Q { behavior a.M }
swarm S { q : Q[2]; r : a.R[1] }
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "first.swarm").write_text(FIRST, encoding="utf-8")
    (tmp_path / "modes.swarm").write_text(MODES, encoding="utf-8")
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "other.swarm").write_text(OTHER, encoding="utf-8")
    return tmp_path


def moved(folder: Path, word: str) -> dict[str, str]:
    """Move the declaration that begins with a word; return the changed texts by name of file."""
    workspace = Workspace([folder])
    file = workspace.file(folder / "first.swarm")
    assert file is not None
    declaration = movable(file, file.source.text.index(word))
    assert declaration is not None
    before = pipeline.check([folder]).system
    texts = move_declaration(workspace, file, declaration)
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    after = pipeline.check([folder])
    assert after.system is not None, [each.message for each in after.report]
    assert before is not None
    # The order of the files is that of the declarations; all else is the same to the byte.
    assert sorted(blocks(dump(after.system))) == sorted(blocks(dump(before)))
    return {path.name: text for path, text in texts.items()}


def blocks(text: str) -> list[str]:
    """Return the elements of a dump, each with all that is in it."""
    found: list[str] = []
    for line in text.splitlines():
        if found and line.startswith("    "):
            found[-1] += f"\n{line}"
        else:
            found.append(line)
    return found


def test_used_by_others(folder: Path) -> None:
    texts = moved(folder, "swarm event Go")
    assert texts["go.swarm"] == "package a\n\nswarm event Go : std_msgs/Empty\n"
    assert 'import "go.swarm"\n' in texts["first.swarm"]
    assert set(texts) == {"go.swarm", "first.swarm"}


def test_uses_the_rest(folder: Path) -> None:
    texts = moved(folder, "member R")
    assert texts["r.swarm"] == 'package a\n\nimport "first.swarm"\n\nmember R { behavior M }\n'
    assert "member R" not in texts["first.swarm"]
    assert "r.swarm" not in texts["first.swarm"]
    assert 'import "../r.swarm"\n' in texts["other.swarm"]


def test_uses_and_is_used(folder: Path) -> None:
    with pytest.raises(RefusedError, match="it and the rest of the file use each other"):
        moved(folder, "statemachine M")


def test_comments_and_imports_go_along(folder: Path) -> None:
    moved(folder, "swarm event Go")
    path = folder / "first.swarm"
    path.write_text(path.read_text(encoding="utf-8").replace("/// The", "/// A"), encoding="utf-8")
    texts = moved(folder, "statemachine M")
    new = texts["m.swarm"]
    assert "// about M\n/// Documentation of M.\nstatemachine M {" in new
    assert new.endswith("}  // end of M\n")
    assert new.startswith('package a\n\nimport "modes.swarm"\nimport "go.swarm"\n\n')
    assert 'import "m.swarm"\n' in texts["first.swarm"]
    assert 'import "../m.swarm"\n' in texts["other.swarm"]


def test_file_exists(folder: Path) -> None:
    (folder / "go.swarm").write_text("package c\nenum E { A }\n", encoding="utf-8")
    with pytest.raises(RefusedError, match=r"there is a file `go\.swarm`"):
        moved(folder, "swarm event Go")


def test_only_declaration_of_a_file(folder: Path) -> None:
    workspace = Workspace([folder])
    file = workspace.file(folder / "modes.swarm")
    assert file is not None
    assert movable(file, MODES.index("Mode")) is None
