"""Keys of the project file."""

from __future__ import annotations

import re
from collections.abc import Mapping

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.driver.config.keys import TEXT, Key, list_of, table, table_of

PACKAGE = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)*")

PROJECT: Mapping[str, Key] = {
    "name": Key(
        {"type": "string", "pattern": f"^{PACKAGE.pattern}$"},
        "Name of the system, like `rescue` or `rescue.sea`; by default the package of the first "
        "file.",
    ),
    "sources": Key(
        list_of(TEXT),
        "Files and folders to compile when none is named; by default the folder of this file.",
    ),
    "libraries": Key(list_of(TEXT), "Folders with packages to import."),
}
_LEVELS = {
    Level.ALLOW: "Warnings that are not reported, by name or code.",
    Level.WARN: "Warnings to report as such, by name or code.",
    Level.DENY: "Warnings that count as errors, by name or code; `warnings` are all.",
}
LINT: Mapping[str, Key] = {level.value: Key(list_of(TEXT), _LEVELS[level]) for level in Level}
BUILD: Mapping[str, Key] = {"out": Key(TEXT, "Folder of what is built; by default `out`.")}

OPTIONS = table_of({"type": ["string", "integer", "boolean"]})
"""Shape of the options of a target."""
TABLES: Mapping[str, Key] = {
    "project": Key(table(PROJECT), "The system and its files."),
    "targets": Key(table_of(OPTIONS), "Targets to build, each with its options."),
    "models": Key(
        table_of(TEXT),
        "Models of functions in space: a class in a file, like `models/auction.py:Auction`, or "
        "an entry point.",
    ),
    "lint": Key(table(LINT), "Levels of diagnostics."),
    "build": Key(table(BUILD), "Settings of all targets."),
}
