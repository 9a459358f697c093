"""Expected data of claims, from TOML to values of model types."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.inputs.values import Way, fitted
from swarmdsl.execution.testing.data import given_part
from swarmdsl.execution.testing.names import Names
from swarmdsl.ir import System, Type


def event_data(table: Table, names: Names, event: str) -> Mapping[str, Any] | None:
    """Read the expected fields of a sent event, as far as given."""
    given, system = table.values["data"], names.subject.system
    if not isinstance(given, dict) or not given:
        table.wrong(("data",), "a table of fields", given)
        return None
    if system is None:
        return given
    type_ = system.event(event).type
    found = table.fitted(lambda value, way: fitted(type_, value, system, way), "data")
    return given_part(found, given) if found is not None else None


def variables(
    table: Table, names: Names, who: list[int], word: str
) -> tuple[dict[int, Mapping[str, Any]], dict[str, str]]:
    """Read the expected variables of each selected machine, and their names in the test."""
    given, system = table.values["has"], names.subject.system
    if not isinstance(given, dict) or not given:
        table.wrong(("has",), "a table of variables", given)
        return {}, {}
    places = table.document.places
    named = [(name, places[(*table.keys, "has", name)].key) for name in given]
    found: dict[int, Mapping[str, Any]] = {}
    read: dict[str, Mapping[str, Any]] = {}
    written: dict[str, str] = {}
    for number in names.machines_with(who, word, named):
        machine = names.cast[number].machine
        if machine.name not in read:
            values: dict[str, Any] = {}
            for name, value in given.items():
                meant = names.variables(machine, name)
                if system is None or meant is None:
                    values[name] = value
                    continue
                held = table.fitted(partial(_fit, meant[0].type, system), "has", name)
                if held is None:
                    return {}, {}
                written[meant[0].name] = name
                values[meant[0].name] = given_part(held, value)
            read[machine.name] = values
        found[number] = read[machine.name]
    return found, written


def _fit(type_: Type, system: System, value: Any, way: Way) -> Any:
    return fitted(type_, value, system, way)
