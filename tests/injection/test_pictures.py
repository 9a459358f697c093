"""Strings and documentation in diagrams and pages: shown as they are, and not obeyed."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from lxml import etree, html

from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.tools.diagram.formats import FORMATS
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.document import document

from ..diagram.test_texts import ESCAPES, told
from .model import DOCS, ENDS, HOSTILE, model, placeholders

Checked = Callable[[str], System]


@pytest.mark.parametrize("format_", sorted(FORMATS))
def test_diagrams_show_strings_and_do_not_obey_them(checked: Checked, format_: str) -> None:
    write = FORMATS[format_]
    plain = list(diagrams(checked(model(placeholders(HOSTILE), "x", worlds=True))))
    hostile = list(diagrams(checked(model(HOSTILE, "\n".join([*DOCS, *ENDS]), worlds=True))))
    for one, other in zip(hostile, plain, strict=True):
        text = write(one)
        bare = "".join(ESCAPES[format_](text).split())
        assert [what for what in told(one) if "".join(what.split()) not in bare] == []
        if format_ == "svg":
            # As a file, and in the page of the preview.
            for parse in (etree.fromstring, html.fragment_fromstring):
                mine, others = ({each.tag for each in parse(write(x)).iter()} for x in (one, other))
                assert mine == others
        else:
            assert text.count("\n") == write(other).count("\n")


def test_plantuml_calls_no_function_of_the_preprocessor(checked: Checked) -> None:
    for diagram in diagrams(checked(model(HOSTILE, "x", worlds=True))):
        assert not re.search("[%$&']|^ *!", FORMATS["plantuml"](diagram), re.MULTILINE)


def test_a_page_has_no_elements_of_the_model(tmp_path: Path) -> None:
    def page(strings: Sequence[str], doc: str) -> html.HtmlElement:
        path = tmp_path / "model.swarm"
        path.write_text(model(strings, doc, worlds=True), encoding="utf-8")
        project = pipeline.check([path]).valid
        assert project is not None
        _, text = document(project)
        return html.document_fromstring(text)

    plain, hostile = page(placeholders(HOSTILE), "x"), page(HOSTILE, "x")
    tags = [[each.tag for each in tree.iter() if each.tag != "wbr"] for tree in (plain, hostile)]
    assert set(tags[0]) == set(tags[1])
    documented = page(["x"], "\n\n".join([*DOCS, *ENDS]))
    for tree in (hostile, documented):
        assert len(tree.findall(".//script")) == 1
        for each in tree.iter():
            assert not [name for name in each.attrib if name.startswith("on")]
            assert each.tag != "a" or re.match("#|https?:", each.get("href", ""))
