"""Hover of keywords shows what the language reference says."""

import json
import re
from pathlib import Path

import pytest

from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.hover import hover
from swarmdsl.ide.server.keyword_hover import SECTIONS, TABLE
from swarmdsl.syntax.parser.keywords import RESERVED

REFERENCE = Path(__file__).parents[2] / "docs" / "language.md"
SYNTAX = re.compile(r"```text\n.*?^```$", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\[([^\]]+)\]\([^)]*\)")


def sections() -> dict[str, str]:
    """First paragraph and syntax of the sections, without links."""
    _, *parts = re.split(r"^#{2,4} (.*)$", REFERENCE.read_text(encoding="utf-8"), flags=re.M)
    found = {}
    for heading, body in zip(parts[::2], parts[1::2], strict=True):
        if heading in SECTIONS.values():
            first, _, rest = body.strip().partition("\n\n")
            begins = first.startswith("```")
            syntax = SYNTAX.match(body.strip() if begins else rest)
            prose = "" if begins else LINK.sub(r"\1", " ".join(first.split()))
            where = f"*{heading}* in the language reference"
            found[heading] = "\n\n".join(filter(None, (syntax and syntax[0], prose, where)))
    return found


def test_the_table_is_that_of_the_reference(bless: bool) -> None:
    assert RESERVED - SECTIONS.keys() == {"in"}
    assert set(SECTIONS.values()) == sections().keys()
    if bless:
        TABLE.write_text(json.dumps(sections(), indent=2) + "\n", encoding="utf-8")
    assert all(each.count("```") in (0, 2) for each in sections().values())
    assert json.loads(TABLE.read_text(encoding="utf-8")) == sections()


@pytest.mark.parametrize(
    ("at", "shown"),
    [
        ("event G", "Something that state machines react to"),
        ("initial A", "initial <state>"),
        ("final B", "The end of the enclosing machine"),
        ("state in", None),
        ('state"', None),
        ("Go ->", "event Go"),
    ],
)
def test_hover(tmp_path: Path, at: str, shown: str | None) -> None:
    path = tmp_path / "m.swarm"
    text = (
        '/* A state in a comment. */\nevent Go : std_msgs/Empty on "state"\n'
        "statemachine M {\n  initial A\n  state A {\n    on Go -> B\n  }\n  final B\n}\n"
    )
    path.write_text(text, encoding="utf-8")
    workspace = Workspace([path])
    found = hover(workspace, workspace.project.files[0], text.index(at) + 1)
    assert (found is None) == (shown is None)
    if found is not None and shown is not None:
        assert shown in found[1]
