"""Find the scenarios among the TOML files of a folder."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import tomli

from swarmdsl.base.read_files import MOST_DATA, read_file
from swarmdsl.driver.config import FILE_NAME
from swarmdsl.execution.simulate.inputs.scenario_keys import TABLES

_OTHERS = (FILE_NAME, ".swarmtest.toml")


def is_scenario(values: Mapping[str, Any]) -> bool:
    """Return True for the values of a scenario: it has one of its keys, and is no experiment."""
    return bool(TABLES.keys() & values.keys()) and "scenario" not in values


def scenarios_in(folders: Iterable[Path]) -> list[Path]:
    """Return the scenarios directly in folders; also a file that is no TOML, which may be one."""
    found = (path for folder in folders for path in sorted(folder.glob("*.toml")))
    return [path for path in dict.fromkeys(found) if _may_be_one(path)]


def _may_be_one(path: Path) -> bool:
    if path.name.endswith(_OTHERS):
        return False
    try:
        return is_scenario(tomli.loads(read_file(path, MOST_DATA).decode()))
    except OSError:
        return False
    except (ValueError, RecursionError):
        return True
