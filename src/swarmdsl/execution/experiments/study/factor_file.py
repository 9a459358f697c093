"""Read the factors of a study from their table in TOML."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.driver.config.toml import Document, Keys
from swarmdsl.execution.experiments.designs.factors import Factor, Value
from swarmdsl.execution.experiments.study.plan import Kind, Varied
from swarmdsl.execution.experiments.task import COUNT, SCENARIO
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.inputs.values import kind
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration

MOST_LEVELS = 1000
_RANGE = ("from", "to", "step")
_LEVELS = "a list of values, or `{ from = ..., to = ... }`"


def read_factors(document: Document, report: Diagnostics) -> tuple[Varied, ...]:
    """Read the table `factors`; levels that are no values are reported and left out."""
    return tuple(_Reader(document, report).read())


class _Reader:
    def __init__(self, document: Document, report: Diagnostics) -> None:
        self._document = document
        self._report = report

    def read(self) -> Iterator[Varied]:
        table = self._document.values.get("factors", {})
        if not isinstance(table, dict):
            self._wrong(("factors",), "a table: `[factors]`", table)
            return
        seen: dict[str, Keys] = {}
        for keys, value in self._entries(("factors",), table):
            name = _setting(keys)
            if name in seen:
                place = self._document.places[keys].key
                self._report.report("repeated-item", place, item=f"factor `{name}`")
                continue
            seen[name] = keys
            found = self._factor(name, keys, value)
            if found is not None:
                yield found

    def _entries(self, above: Keys, table: dict[str, Any]) -> Iterator[tuple[Keys, Any]]:
        """Yield the factors; tables that are no ranges are parts of names."""
        for name, value in table.items():
            keys = (*above, name)
            named = keys == ("factors", "faults")
            if isinstance(value, dict) and not named and not value.keys() & {"from", "to"}:
                if not value:
                    self._wrong(keys, _LEVELS, value)
                yield from self._entries(keys, value)
            else:
                yield keys, value

    def _factor(self, name: str, keys: Keys, value: Any) -> Varied | None:
        if name == "faults":
            return self._faults(keys, value)
        if name in ("model", "scenario"):
            kind: Kind = "model" if name == "model" else "scenario"
            levels = self._levels(keys, value, "paths", str)
            places = self._places(keys, levels)
            return Varied(Factor(name, levels), kind, self._key(keys), places=places)
        if "." not in name and not name.startswith((COUNT, SCENARIO)):
            help_ = (
                "a param has its member before it, as `robot.speed`, a number of members "
                "`count.`, and a setting of a scenario `scenario.`"
            )
            self._report.report(
                "unresolved-name", self._key(keys), kind="factor", name=name, help=help_
            )
            return None
        if isinstance(value, dict):
            return self._range(name, keys, value)
        return self._list(name, keys, value)

    def _list(self, name: str, keys: Keys, value: Any) -> Varied | None:
        if not isinstance(value, list) or not value:
            self._wrong(keys, _LEVELS, value)
            return None
        kinds = {bool: "booleans", str: "strings", int: "numbers", float: "numbers"}
        what = kinds.get(type(value[0]))
        if what is None:
            self._wrong((*keys, 0), "a number, a string or a boolean", value[0])
            return None
        types = tuple(each for each, word in kinds.items() if word == what)
        levels = self._levels(keys, value, what, *types)
        times = [duration(each) if isinstance(each, str) else None for each in levels]
        seconds = tuple(time / SECOND for time in times if time is not None)
        is_time = bool(levels) and len(seconds) == len(levels)
        shown: tuple[Value, ...] = seconds if is_time else levels
        places = dict(zip(shown, self._places(keys, levels).values(), strict=False))
        return Varied(Factor(name, shown), "setting", self._key(keys), is_time, places=places)

    def _levels(self, keys: Keys, value: Any, what: str, *types: type) -> tuple[Value, ...]:
        """Read a list of values of some types, each once."""
        if not isinstance(value, list) or not value:
            self._wrong(keys, f"a list of {what}", value)
            return ()
        found: list[Value] = []
        for number, each in enumerate(value):
            if type(each) not in types or each != each:
                self._wrong((*keys, number), f"{what}, as the first level", each)
            elif each in found:
                place = self._document.places[(*keys, number)].value
                self._report.report("repeated-item", place, item=f"level `{each}`")
            else:
                found.append(each)
        return tuple(found)

    def _places(self, keys: Keys, levels: tuple[Value, ...]) -> dict[Value, Span]:
        values: Any = self._document.values
        for key in keys:
            values = values[key]
        return (
            {
                each: self._document.places[(*keys, number)].value
                for number, each in enumerate(values)
                if each in levels
            }
            if isinstance(values, list)
            else {}
        )

    def _range(self, name: str, keys: Keys, value: dict[str, Any]) -> Varied | None:
        table = Table(self._document, keys, self._report)
        table.check_keys(_RANGE, "a range")
        missing = [each for each in ("from", "to") if each not in value]
        if missing:
            place, help_ = self._key(keys), "a range has `from` and `to`, and perhaps `step`"
            self._report.report("missing-key", place, name=missing[0], help=help_)
            return None
        texts = [value[each] for each in _RANGE if each in value]
        is_time = all(isinstance(each, str) for each in texts)
        numbers = [
            self._number((*keys, each), value[each], is_time) for each in _RANGE if each in value
        ]
        bounds = [each for each in numbers if each is not None]
        if len(bounds) < len(numbers):
            return None
        low, high, *steps = bounds
        if low >= high:
            self._wrong((*keys, "to"), f"more than `from`, which is {value['from']}", value["to"])
            return None
        whole = not is_time and all(isinstance(each, int) for each in texts)
        step = steps[0] if steps else 1 if whole else None
        if step is None:
            return Varied(Factor(name, (), low, high), "setting", self._key(keys), is_time)
        if not 0 < step <= high - low:
            between = f"from {value['from']} to {value['to']}"
            expected = f"a step of more than 0 that is not wider than {between}"
            self._wrong((*keys, "step"), expected, value["step"])
            return None
        count = int((high - low) / step + 1e-9) + 1
        if count > MOST_LEVELS:
            self._wrong(keys, f"at most {MOST_LEVELS} levels: a greater `step`", value)
            return None
        levels = tuple(low + number * step for number in range(count))
        assert all(a < b for a, b in pairwise(levels))
        return Varied(Factor(name, levels), "setting", self._key(keys), is_time)

    def _number(self, keys: Keys, value: Any, is_time: bool) -> int | float | None:
        time = duration(value) if isinstance(value, str) and is_time else None
        if time is not None:
            return time / SECOND
        if isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300:
            return value
        expected = 'a time like "1.5 s"' if is_time else "a number, as the other end of the range"
        self._wrong(keys, expected, value)
        return None

    def _faults(self, keys: Keys, value: Any) -> Varied | None:
        """Read sets of faults by name, each as a scenario has them."""
        if not isinstance(value, dict) or not value:
            self._wrong(keys, "a table with a list of faults for each name", value)
            return None
        found: dict[Value, Any] = {}
        places: dict[Value, Span] = {}
        for name, faults in value.items():
            if isinstance(faults, list):
                found[name] = faults
                places[name] = self._document.places[(*keys, name)].value
            else:
                self._wrong((*keys, name), "a list of faults, as in a scenario", faults)
        factor = Factor("faults", tuple(found))
        return Varied(factor, "faults", self._key(keys), faults=found, places=places)

    def _key(self, keys: Keys) -> Span:
        return self._document.places[keys].key

    def _wrong(self, keys: Keys, expected: str, found: Any) -> None:
        name = "factors" if len(keys) == 1 else _setting(keys)
        place = self._document.places[keys].value
        self._report.report("wrong-value", place, name=name, expected=expected, found=kind(found))


def _setting(keys: Keys) -> str:
    """Return the name of a setting; keys can follow those of a scenario."""
    first, *others = (each for each in keys[1:] if isinstance(each, str))
    if others and others[-1] in _RANGE:
        others.pop()
    if others and first == "count":
        return COUNT + ".".join(others)
    if others and first == "scenario":
        return SCENARIO + ".".join(others)
    if others and first == "params":
        return ".".join(others)
    return ".".join([first, *others])
