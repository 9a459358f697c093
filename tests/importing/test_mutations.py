"""Import of any document yields a valid model or a diagnostic."""

from __future__ import annotations

import random
from copy import deepcopy
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange import scxml
from swarmdsl.driver import pipeline
from swarmdsl.importing.command import run

from .test_w3c import SAME, document

ROOT = Path(__file__).resolve().parents[2]
MODELS = [
    ROOT / "examples" / "search_and_rescue",
    ROOT / "tests" / "agreement" / "machines.swarm",
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
]


def originals() -> list[etree._Element]:
    found = [document(body).encode() for body in SAME.values()]
    for model in MODELS:
        system = pipeline.check([model]).system
        assert system is not None
        made = scxml.emit(system, scxml.Options(), Diagnostics())
        found += [file.text.encode() for file in made]
    return [etree.fromstring(text) for text in found]


def mutated(original: etree._Element, dice: random.Random) -> str:
    """The document with some things taken out, put twice, exchanged or called otherwise."""
    root = deepcopy(original)
    for _ in range(dice.randrange(1, 6)):
        elements = [each for each in root.iter() if isinstance(each.tag, str)]
        one, other = dice.choice(elements), dice.choice(elements)
        parent = one.getparent()
        match dice.randrange(6):
            case 0 if parent is not None:
                parent.remove(one)
            case 1 if parent is not None:
                parent.append(deepcopy(one))
            case 2 if one.attrib:
                del one.attrib[dice.choice(list(one.attrib))]
            case 3 if one.attrib and other.attrib:
                value = other.get(dice.choice(list(other.attrib)))
                one.set(dice.choice(list(one.attrib)), value or "")
            case 4 if parent is not None:
                one.tag = other.tag
            case 5 if one not in other.iterancestors() and one is not other and parent is not None:
                other.append(one)
    return etree.tostring(root, encoding="unicode")


def test_mutants(tmp_path: Path, pytestconfig: pytest.Config) -> None:
    documents = originals()
    path, out = tmp_path / "m.xml", tmp_path / "m.swarm"
    imported = 0
    for seed in range(pytestconfig.getoption("--mutants") // 2):
        dice = random.Random(seed)
        path.write_text(mutated(dice.choice(documents), dice), encoding="utf-8")
        out.unlink(missing_ok=True)
        try:
            done = run("scxml", [path], [], out, force=False)
        except Exception as error:
            raise AssertionError(f"{seed}: {path.read_text(encoding='utf-8')}") from error
        assert out.exists() != done.report.has_errors
        imported += out.exists()
    assert imported
