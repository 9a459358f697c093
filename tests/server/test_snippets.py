"""Tests of snippets: they are offered where they fit and expand to valid models."""

import json
import re
from functools import cache
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.completion import completions
from swarmdsl.ide.server.models import Models
from swarmdsl.ide.server.snippets import snippets, table
from swarmdsl.syntax.parse import parse

from .test_completion import state, work

SERVER = Path(snippets.__code__.co_filename).parent

TABLE = json.loads((SERVER / "snippets.json").read_text(encoding="utf-8"))
FILE = "package a\n"
MACHINE = FILE + "statemachine M {\n  initial A\n"
STATE = MACHINE + "  state S {\n"
# Text before the cursor, by kind of block.
PLACES = {
    "file": "",
    "declaration": FILE,
    "function": FILE + "function f : swarm {\n",
    "component": FILE + "sensor S {\n",
    "member": FILE + "member R {\n",
    "machine": MACHINE,
    "state": STATE,
    "parallel state": MACHINE + "  parallel state S {\n",
    "region": MACHINE + "  parallel state S {\n    region R {\n",
    "optimization": FILE + "optimize W {\n",
    "swarm": FILE + "swarm W {\n",
    "fitness": FILE + "fitness F {\n",
    "environment": FILE + "environment E {\n",
}
STOP = re.compile(r"\$(?:(\d+)|\{(\d+)(?::([^}]*)|\|([^}]*)\|)\})")


@cache
def keywords_at(text):
    """Return the keywords that completion offers after a text."""
    with TemporaryDirectory() as folder:
        models = Models([Path(folder)])
        models.edit(Path(folder) / "a.swarm", text)
        found = completions(*models.file(Path(folder) / "a.swarm"), len(text))
    return {each.word for each in found if each.detail == "keyword"}


def insertions(text):
    """Return the expansions of a snippet, one for each of its choices."""
    choices = {n: options.split(",") for _, n, _, options in STOP.findall(text) if options}
    return [
        STOP.sub(lambda stop, taken=taken: taken.get(stop[2]) or stop[3] or "", text)
        for taken in (
            dict(zip(choices, options, strict=True)) for options in product(*choices.values())
        )
    ]


def offered_at(place):
    return [
        snippet
        for words, several in table().items()
        if set(words) <= keywords_at(PLACES[place])
        for snippet in several
    ]


@pytest.mark.parametrize("place", PLACES)
def test_offered_snippets_fit(place):
    before = PLACES[place]
    after = "\n}" * before.count("{") + "\n"
    for snippet in offered_at(place):
        for text in insertions(snippet.text):
            assert "$" not in text
            report = Diagnostics()
            parse(Source("a.swarm", before + text + after), report)
            assert not report.has_errors, (text, [each.message for each in report])


@pytest.mark.parametrize("place", ["declaration", "function", "component", "member"])
def test_snippets_name_interfaces_of_the_right_kind(place, tmp_path):
    before = PLACES[place]
    for number, snippet in enumerate(offered_at(place)):
        text = before + insertions(snippet.text)[0] + "\n}" * before.count("{") + "\n"
        path = tmp_path / f"{number}.swarm"
        path.write_text(text, encoding="utf-8")
        wrong = [each for each in Workspace([path]).report if each.code == "SW0604"]
        assert not wrong, (text, [each.message for each in wrong])


def test_every_snippet_is_offered():
    offered = {each.label for place in PLACES for each in offered_at(place)}
    assert offered == {f"{name} ..." for name in TABLE}


def test_every_construct_has_a_snippet():
    known = {word for place in PLACES for word in keywords_at(PLACES[place])}
    inserted = {
        word
        for each in TABLE.values()
        for text in insertions("\n".join(each["text"]))
        for word in re.findall("[a-z]+", text)
    }
    assert known - inserted == set()


@pytest.mark.parametrize("name", TABLE)
def test_fields_are_numbered_from_one(name):
    stops = {
        int(plain or braced) for plain, braced, _, _ in STOP.findall("".join(TABLE[name]["text"]))
    }
    assert stops - {0} == set(range(1, max(stops, default=0) + 1))


def test_choices_are_all_inserted():
    assert insertions("\n".join(TABLE["after"]["text"])) == [
        f"after 30 {unit} -> Target" for unit in ("s", "ms", "us", "min", "h")
    ]


def filled(text):
    """Return the expansion of a snippet with all defaults."""
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


def test_unhandled_outcomes(tmp_path):
    found = offered(tmp_path, work("|"), {"on"})
    assert filled(found["on the outcomes"]) == "on succeeded -> Target"
    assert "on the outcomes" not in offered(tmp_path, state("|"), {"on"})


def test_snippet_below_documentation_has_none_of_its_own(tmp_path):
    models = Models([tmp_path])
    path = tmp_path / "a.swarm"
    begun = {}
    for before in ("", "/// Go.\n", "/// Go.\n\n", "// Go.\n"):
        text = f"{FILE}{before}func"
        models.edit(path, text)
        [found] = [
            each
            for each in snippets({"statemachine", "function"}, *models.file(path), len(text))
            if each.label == "function ..."
        ]
        begun[before] = found.text.startswith("///")
    assert begun == {"": True, "/// Go.\n": False, "/// Go.\n\n": True, "// Go.\n": True}
