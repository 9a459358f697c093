"""Files of a project and their order."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.find_files import files_below
from swarmdsl.project.loader import Project, load


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    files = {
        "main.swarm": ("common/events.swarm", "robots.swarm"),
        "robots.swarm": ("common/events.swarm", "common/types.swarm"),
        "common/events.swarm": ("types.swarm",),
        "common/types.swarm": (),
        "other.swarm": (),
    }
    for name, imports in files.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        head = "".join(f'import "{other}"\n' for other in imports)
        path.write_text(f"{head}event Of{path.stem.title()} : std_msgs/Empty\n")
    return tmp_path


def loaded(paths: Sequence[Path]) -> Project:
    report = Diagnostics()
    project = load(paths, report)
    assert [found.message for found in report] == []
    return project


def names(project: Project, folder: Path) -> list[str]:
    return [Path(file.source.name).relative_to(folder).as_posix() for file in project.files]


def test_a_file_and_what_it_imports_once_each(folder: Path) -> None:
    assert names(loaded([folder / "main.swarm"]), folder) == [
        "main.swarm",
        "common/events.swarm",
        "robots.swarm",
        "common/types.swarm",
    ]


def test_a_folder_is_all_its_files(folder: Path) -> None:
    assert names(loaded([folder]), folder) == [
        "main.swarm",
        "other.swarm",
        "common/events.swarm",
        "robots.swarm",
        "common/types.swarm",
    ]


def test_hidden_folders_are_passed_over(folder: Path) -> None:
    (folder / ".venv/lib").mkdir(parents=True)
    (folder / ".venv/lib/double.swarm").write_text("event OfMain : std_msgs/Empty\n")

    assert len(names(loaded([folder]), folder)) == 5


def test_folders_may_vanish_while_they_are_looked_through(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("build", "common/tmp"):
        (folder / name).mkdir()
    scandir = os.scandir

    def scan(place: str) -> Iterator[os.DirEntry[str]]:
        """Remove a folder of a build after it was listed and before it is searched."""
        if Path(place).name in ("build", "tmp"):
            Path(place).rmdir()
        return scandir(place)

    monkeypatch.setattr(os, "scandir", scan)

    found = files_below(folder, ".swarm")

    assert not (folder / "build").exists()
    assert not (folder / "common/tmp").exists()
    assert len(found) == 5


def test_the_order_does_not_depend_on_how_a_file_is_named(folder: Path) -> None:
    project = loaded([folder / "common" / ".." / "main.swarm", folder / "main.swarm"])

    assert len(project.files) == 4


def test_imports_lead_to_files(folder: Path) -> None:
    main = loaded([folder / "main.swarm"]).files[0]

    assert [(str(way.path), file.package) for way, file in main.imports] == [
        ("common/events.swarm", "events"),
        ("robots.swarm", "robots"),
    ]


def test_names_are_shown_as_the_path_was_given(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder / "common")

    assert [file.source.name for file in loaded([Path("../robots.swarm")]).files] == [
        "../robots.swarm",
        "../common/events.swarm",
        "../common/types.swarm",
    ]


def test_a_package_is_called_like_its_file_or_as_declared(tmp_path: Path) -> None:
    (tmp_path / "model.swarm").write_text("package a.b\nevent A : std_msgs/Empty\n")
    (tmp_path / "plain.swarm").write_text("event A : std_msgs/Empty\n")
    project = loaded([tmp_path])

    assert sorted(file.package for file in project.files) == ["a.b", "plain"]


def test_a_wrong_import_does_not_hide_the_others(folder: Path) -> None:
    path = folder / "wrong.swarm"
    path.write_text('import "no.swarm"\nimport "other.swarm"\nimport "nor.swarm"\n')
    report = Diagnostics()
    project = load([path], report)

    assert names(project, folder) == ["wrong.swarm", "other.swarm"]
    assert [found.name for found in report] == ["file-not-found", "file-not-found"]


def test_names_of_an_unreadable_file_are_not_reported(folder: Path) -> None:
    from swarmdsl.driver import pipeline

    path = folder / "wrong.swarm"
    path.write_text('import "no.swarm"\nmember M { b : Camera }\n')

    assert [found.name for found in pipeline.check([path]).report] == ["file-not-found"]
