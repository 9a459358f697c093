"""JSON Schemas of TOML files: `python -m swarmdsl.tools.toml_schemas FOLDER` writes them there.

Editors complete and check `swarm.toml`, scenarios and tests by them. They have the keys that the
readers of these files know, the options of the targets, and the arguments of models of functions.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import ALL_WARNINGS, Level
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.options import Option, options_of
from swarmdsl.driver.config.keys import Key, Shape, list_of, one_of, table
from swarmdsl.driver.config.lint import may_have
from swarmdsl.driver.config.project_keys import LINT, OPTIONS, TABLES
from swarmdsl.execution.simulate.inputs.scenario_keys import TABLES as SCENARIO
from swarmdsl.execution.testing.keys import FILE

_DRAFT = "http://json-schema.org/draft-07/schema#"
_TYPES = {str: "string", int: "integer", bool: "boolean"}


def schemas() -> Mapping[str, Shape]:
    """Return the schemas by the names of their files."""
    project = {
        **TABLES,
        "targets": TABLES["targets"]._replace(shape=_targets()),
        "lint": TABLES["lint"]._replace(shape=_lint()),
    }
    found = {
        "project": ("Project file of swarmdsl: swarm.toml", table(project)),
        "scenario": ("Scenario of swarmdsl", table(SCENARIO)),
        "tests": ("Behaviour tests of swarmdsl", table(FILE, required=("test",))),
    }
    return {
        f"{name}.schema.json": {"$schema": _DRAFT, "title": title, **shape}
        for name, (title, shape) in found.items()
    }


def write(folder: Path) -> None:
    """Write the schemas to a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, schema in schemas().items():
        (folder / name).write_text(json.dumps(schema, indent=1) + "\n", encoding="utf-8")


def _targets() -> Shape:
    """Shape of the table of targets; those of other packages have options of any name."""
    known = {}
    for name in registry.BUILT_IN:
        generator = registry.load(name)
        assert isinstance(generator, Generator), name
        options = options_of(generator).values()
        shape = table({each.name: Key(_option(each), each.help) for each in options})
        known[name] = Key(shape, f"Options of target `{name}`.")
    return {**table(known), "additionalProperties": OPTIONS}


def _option(option: Option) -> Shape:
    if option.choices:
        return {"enum": [option.type(each) for each in option.choices]}
    return {"type": _TYPES[option.type]}


def _lint() -> Shape:
    """Shape of the table of levels, with the names and codes of diagnostics that can have each."""
    words = [(word, name) for name, code in CODES.items() for word in (name, code.code)]
    words.insert(0, (ALL_WARNINGS, ALL_WARNINGS))
    return table(
        {
            level.value: LINT[level.value]._replace(
                shape=list_of(one_of(word for word, name in words if may_have(name, level)))
            )
            for level in Level
        }
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write JSON Schemas of TOML files.")
    parser.add_argument("folder", type=Path, help="folder to write them to")
    write(parser.parse_args().folder)
