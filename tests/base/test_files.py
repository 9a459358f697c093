"""Files that the operating system does not let swarmc read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline


@pytest.fixture
def locked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refuse to read `locked.swarm`, also to a user who may read everything."""
    opened = os.open

    def refuse(path: str | Path, flags: int, mode: int = 0o777) -> int:
        if Path(path).name == "locked.swarm":
            raise PermissionError(13, "Permission denied", str(path))
        return opened(path, flags, mode)

    monkeypatch.setattr(os, "open", refuse)


@pytest.mark.usefixtures("locked")
def test_an_unreadable_file(tmp_path: Path) -> None:
    model = tmp_path / "locked.swarm"
    model.write_text("event Start : std_msgs/Empty\n", encoding="utf-8")

    (found,) = pipeline.check([model]).report

    assert found.code == "SW0003"
    assert found.message == f"cannot read `{model}`: permission denied"
    assert found.primary is None


@pytest.mark.usefixtures("locked")
def test_an_unreadable_file_that_is_imported(tmp_path: Path) -> None:
    (tmp_path / "locked.swarm").write_text("event Start : std_msgs/Empty\n", encoding="utf-8")
    model = tmp_path / "model.swarm"
    model.write_text('import "locked.swarm"\n\nevent Stop : std_msgs/Empty\n', encoding="utf-8")

    (found,) = pipeline.check([model]).report

    assert found.code == "SW0003"
    assert found.primary is not None
    assert found.primary.span.text == '"locked.swarm"'
