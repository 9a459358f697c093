"""Twice the document is twice the work: executed instructions are counted, not seconds."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.importing.command import run

from ..instructions import executed, is_proportional

FEW = 50
HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="a">'


def many(pattern: str, count: int) -> str:
    return "".join(pattern.replace("<i>", str(number)) for number in range(count))


DOCUMENTS: dict[str, Callable[[int], str]] = {
    "transitions without effect": lambda count: many('<transition event="e<i>"/>', count),
    "beginnings of events": lambda count: many('<transition event="e<i>.*" target="b"/>', count),
    "events of one transition": lambda count: (
        '<transition event="' + many("e<i> ", count) + '" target="b"/>'
    ),
    "timers": lambda count: (
        "<onentry>"
        + many('<send event="t<i>" delay="<i>s"/>', count)
        + "</onentry>"
        + many('<transition event="t<i>" target="b"/>', count)
    ),
}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_twice_the_document_is_twice_the_work(name: str, tmp_path: Path) -> None:
    path = tmp_path / "machine.scxml"
    works = []
    for count in (2, FEW, 2 * FEW, 4 * FEW):  # the first time, modules are imported
        inside = DOCUMENTS[name](count)
        path.write_text(
            f'{HEAD}<state id="a">{inside}<transition event="z" target="b"/></state>'
            '<final id="b"/></scxml>',
            encoding="utf-8",
        )
        works.append(executed(lambda: run("scxml", [path], (), None, force=False)))
    assert is_proportional(works[1:]), works
