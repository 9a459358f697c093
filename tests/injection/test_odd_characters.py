"""Byte order marks and characters that are none, in documentation: no internal error."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from ..conftest import Ran

ODD = (
    "\ufeff",
    "\ufffe",
    "\uffff",
    "\ufdd0",
    "\U0001ffff",
    "\u2028",
    "\x85",
    "\u200b",
    "\x1c",
    "\r",
)
MODEL = """{0}
package a
{0}
event Go : std_msgs/Empty
{0}
statemachine M {{
  {0}
  initial A
  {0}
  state A {{ on Go -> End }}
  final End
}}
{0}
member B {{ behavior M }}
"""


@pytest.mark.parametrize("form", ["/// {}", "///{}{}", "/// a\n/// {}b", "/// a {}", "{}/// a"])
@pytest.mark.parametrize("odd", ODD, ids=ascii)
def test_documentation_that_is_compiled_again(
    odd: str, form: str, folder: Path, swarmc: Callable[..., Ran]
) -> None:
    model = MODEL.format(form.format(odd, odd))
    (folder / "model.swarm").write_text(model, encoding="utf-8", newline="")
    checked = swarmc("check", "model.swarm").code
    assert checked in (0, 1)
    for _ in range(2):  # the second build merges with the first one
        assert swarmc("build", "model.swarm", "-o", "out").code == checked
    for made in (folder / "out").rglob("*.scxml"):
        assert swarmc("import", "scxml", made, "-o", "again.swarm").code == 0
        assert swarmc("check", "again.swarm").code == 0
    assert swarmc("fmt", "model.swarm").code in (0, checked)
    # It removes blanks at the ends of lines, which some of these characters are.
    assert swarmc("check", "model.swarm").code in (0, checked)
