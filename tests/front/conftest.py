"""What the tests of the front end share: models from texts, up to any phase."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.analysis.resolve.linker import link
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.project.loader import Project, load


@pytest.fixture
def linked(tmp_path: Path) -> Callable[..., Project]:
    """Link files that are given as texts: the first one, and what it imports by name."""

    def link_texts(main: str, **others: str) -> Project:
        for name, text in {"main": main, **others}.items():
            (tmp_path / f"{name}.swarm").write_text(text, encoding="utf-8")
        report = Diagnostics()
        project = load([tmp_path / "main.swarm"], report)
        link(project, report)
        assert [found.message for found in report] == []
        return project

    return link_texts
