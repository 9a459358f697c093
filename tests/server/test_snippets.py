"""Whole statements that are offered, as text that can be filled in and is right then."""

import re

import pytest

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.parse import parse
from swarmdsl.server.models import Models
from swarmdsl.server.snippets import snippets
from swarmdsl.source import Source

from .test_completion import HEAD, state, work

KEYWORDS = {"statemachine", "member", "swarm", "event", "function"}
INSIDE = {"state", "parallel", "choice", "final", "on", "after", "do"}


def filled(text):
    """A snippet as it is where somebody takes all that it suggests."""
    text = re.sub(r"\$\{\d+\|(\w+)[^}]*\}", r"\1", text)
    return re.sub(r"\$\{\d+:([^}]*)\}", r"\1", text).replace("$0", "")


def offered(tmp_path, text, keywords):
    offset = text.index("|")
    models = Models([tmp_path])
    models.edit(tmp_path / "a.swarm", text.replace("|", "", 1))
    return {
        each.label: each.text
        for each in snippets(keywords, *models.file(tmp_path / "a.swarm"), offset)
    }


@pytest.mark.parametrize(
    ("text", "keywords"), [(HEAD + "|", KEYWORDS), (state("|"), INSIDE), (work("|"), INSIDE)]
)
def test_snippets_follow_the_grammar(text, keywords, tmp_path):
    found = offered(tmp_path, text, keywords)
    assert found
    for snippet in found.values():
        report = Diagnostics()
        parse(Source("a.swarm", text.replace("|", filled(snippet))), report)
        assert not report.has_errors, snippet


def test_outcomes_that_are_left(tmp_path):
    found = offered(tmp_path, work("|"), INSIDE)
    assert filled(found["on the outcomes"]) == "on succeeded -> Target"
    assert "on the outcomes" not in offered(tmp_path, state("|"), INSIDE)
