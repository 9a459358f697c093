"""Schemas of TOML files: they accept what the readers accept, and have no key of their own."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import jsonschema
import pytest
import tomli

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver.config import read_project
from swarmdsl.tools.scaffold.plan import TARGETS, Plan
from swarmdsl.tools.scaffold.project import project_files
from swarmdsl.tools.toml_schemas import schemas, write

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "editors" / "vscode"
VALIDATORS = {
    name.partition(".")[0]: jsonschema.Draft7Validator(schema) for name, schema in schemas().items()
}
_BLOCK = re.compile(r"^```toml.*\n((?:.*\n)*?)```", re.MULTILINE)


def kind_of(name: str) -> str:
    if name.endswith("swarm.toml"):
        return "project"
    return "tests" if name.endswith(".swarmtest.toml") else "scenario"


def right() -> Iterator[tuple[str, str, str]]:
    """Yield valid files: the kind, the name and the text."""
    for path in (ROOT / "examples").rglob("*.toml"):
        text = path.read_text(encoding="utf-8")
        if "[factors" not in text:  # a campaign of experiments
            yield kind_of(path.name), path.relative_to(ROOT).as_posix(), text
    for target in TARGETS:
        for name, text in project_files(Plan("rescue", target=target)):
            if name.endswith(".toml"):
                yield kind_of(name), f"{target}/{name}", text
    for page, kind, sign in (
        ("project", "project", "[project]"),
        ("simulate", "scenario", "[[faults]]"),
        ("testing", "tests", "[[test]]"),
    ):
        text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
        blocks = [block for block in _BLOCK.findall(text) if sign in block]
        assert blocks, page
        yield from ((kind, f"docs/{page}.md", block) for block in blocks)


def mistakes(kind: str, text: str) -> list[str]:
    return [each.message for each in VALIDATORS[kind].iter_errors(tomli.loads(text))]


def test_valid_files_are_accepted() -> None:
    found = list(right())
    assert {kind for kind, _, _ in found} == VALIDATORS.keys()
    assert {name: wrong for kind, name, text in found if (wrong := mistakes(kind, text))} == {}


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        ("project", "[projet]", "'projet' was unexpected"),
        ("project", '[project]\nsource = ["models"]', "'source' was unexpected"),
        ("project", '[project]\nname = "a b"', "does not match"),
        ("project", '[project]\nsources = "models"', "is not of type 'array'"),
        ("project", '[lint]\nallow = ["SW0202"]', "is not one of"),
        ("project", '[lint]\ndeny = ["no-such-warning"]', "is not one of"),
        ("project", '[targets.ros2]\ninterfaced = "x"', "'interfaced' was unexpected"),
        ("project", "[targets.skeleton]\ninterfaces = 1", "is not of type 'boolean'"),
        ("project", "[build]\nout = 1", "is not of type 'string'"),
        ("scenario", "sed = 1", "'sed' was unexpected"),
        ("scenario", "[network]\nlag = 1", "'lag' was unexpected"),
        ("scenario", 'until = "5"', "does not match"),
        ("scenario", 'until = "5 days"', "does not match"),
        ("scenario", '[functions.a]\nduration = { normal = ["1 s"] }', "is not valid under any"),
        ("scenario", "[functions.a]\naborted = 2", "greater than the maximum"),
        ("scenario", '[functions.a.of.b.of.c]\nduration = "1 s"', "'of' was unexpected"),
        (
            "scenario",
            '[functions.a]\nmodel = "go_to"\narguments = { speedy = 1.0 }',
            "'speedy' was unexpected",
        ),
        ("scenario", '[world]\nkind = "round"', "is not one of"),
        ("scenario", '[[messages]]\nevent = "A"', "'at' is a required property"),
        ("scenario", '[[faults]]\nat = "1 s"', "is not valid under any"),
        ("tests", '[[test]]\nname = "a"', "'steps' is a required property"),
        ("tests", '[[test]]\nname = "a"\nsteps = []', "should be non-empty"),
        ("tests", '[[test]]\nname = "a"\nsteps = [{ wait = "1 s" }]', "'wait' was unexpected"),
        ("tests", '[[test]]\nname = "a"\nsteps = [{ pass = "1 s", to = "b" }]', "is not one of"),
        ("tests", '[[test]]\nname = "a"\nsteps = [{ who = "b" }]', "is not valid under any"),
        (
            "tests",
            '[[test]]\nname = "a"\nsteps = [{ in = "A", sends = "B" }]',
            "is valid under each of",
        ),
        ("tests", '[[test]]\nname = "a"\nsteps = [{ satisfies = 3 }]', "is not of type 'string'"),
        (
            "tests",
            '[[test]]\nname = "a"\nsteps = [{ in = "A", meanwhile = [{ pass = "1 s" }] }]',
            "'within' is a required property",
        ),
        (
            "tests",
            '[[test]]\nname = "a"\nsteps = [{ in = "A", within = "1 s", meanwhile = [{}] }]',
            "is not valid under any",
        ),
        (
            "tests",
            'seeds = 0\n[[test]]\nname = "a"\nsteps = [{ pass = "1 s" }]',
            "less than the minimum",
        ),
        (
            "tests",
            '[[test]]\nname = "a"\nsteps = [{ pass = "1 s" }]\n[test.scenario]\nsed = 1',
            "is not valid under any",
        ),
    ],
)
def test_wrong_files_are_refused(kind: str, text: str, message: str) -> None:
    found = mistakes(kind, text)
    assert any(message in each for each in found), found
    if kind == "project":
        report = Diagnostics()
        read_project(Path("swarm.toml"), report, Source("swarm.toml", text))
        assert report.has_errors


def test_schemas_are_written_and_used_by_the_extension(tmp_path: Path) -> None:
    write(tmp_path / "schemas")
    made = {path.name: path for path in (tmp_path / "schemas").iterdir()}
    for path in made.values():
        jsonschema.Draft7Validator.check_schema(json.loads(path.read_text(encoding="utf-8")))
    source = (EXTENSION / "src" / "schemas.ts").read_text(encoding="utf-8")
    patterns = {
        name: json.loads(f'"{pattern}"')
        for name, pattern in re.findall(r'^  "(\S+)": "(\S+)",$', source, re.MULTILINE)
    }
    assert patterns.keys() == made.keys()
    for kind, name, _ in right():
        matching = [each for each, pattern in patterns.items() if re.search(pattern, f"/{name}")]
        if name.endswith(".toml") and (kind != "scenario" or "/scenarios/" in name):
            assert matching == [f"{kind}.schema.json"]
