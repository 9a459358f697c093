"""The examples have tests, which pass and reach nine tenths of them."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.execution.testing.command import Request, run

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize(
    "folder", sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())
)
def test_an_example(folder: str) -> None:
    out = StringIO()
    passed = run(Request((EXAMPLES / folder,), fail_under=90), out, StringIO())

    assert passed, out.getvalue()
