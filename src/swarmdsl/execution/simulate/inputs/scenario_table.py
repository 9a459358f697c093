"""Typed access to tables of scenarios and tests."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.driver.config.toml import Document, Keys
from swarmdsl.execution.simulate.inputs.values import MisfitError, Way, kind
from swarmdsl.execution.simulate.scenario.durations import (
    Fixed,
    Length,
    Normal,
    Uniform,
    duration,
    is_too_long,
)
from swarmdsl.syntax.parser.literals import UNITS

T = TypeVar("T")
_LENGTH = 'a time like "1.5 s"'
_DURATION = f"{_LENGTH}, with {listed(list(UNITS))}"


class Table:
    """TOML table; invalid values are reported and read as None."""

    def __init__(self, document: Document, keys: Keys, report: Diagnostics) -> None:
        self.document = document
        self.keys = keys
        self.report = report
        values: Any = document.values
        for key in keys:
            values = values[key]
        self.values: dict[str, Any] = values if isinstance(values, dict) else {}
        if not isinstance(values, dict):
            self.wrong((), "a table", values)

    def __contains__(self, key: str) -> bool:
        return key in self.values

    def check_keys(self, known: Iterable[str], owner: str, what: str = "keys") -> None:
        """Report unknown keys."""
        for key in self.values:
            if key not in known:
                help_ = suggest(key, known, what)
                self.report.report(
                    "unknown-key", self.key_place(key), name=key, owner=owner, help=help_
                )

    def inside(self, key: str) -> Table:
        """Return the table at a key, empty if missing."""
        if key not in self.values:
            return Table(Document(self.document.source, {}), (), self.report)
        return Table(self.document, (*self.keys, key), self.report)

    def items(self, key: str) -> Iterator[Table]:
        """Yield the tables of an array; report and skip other items."""
        found = self.values.get(key, [])
        if not isinstance(found, list):
            self.wrong((key,), f"tables: `[[{key}]]`", found)
            return
        for number, each in enumerate(found):
            table = Table(self.document, (*self.keys, key, number), self.report)
            if isinstance(each, dict):
                yield table

    def length(self, key: str) -> Length | None:
        """Read a fixed or random duration."""
        value = self.values[key]
        if not isinstance(value, dict):
            fixed = self._duration((key,), value)
            return Fixed(fixed) if fixed is not None else None
        inner = self.inside(key)
        if list(value) not in (["uniform"], ["normal"]):
            expected = f"{_LENGTH}, `{{ uniform = [...] }}` or `{{ normal = [...] }}`"
            self.wrong((key,), expected, value)
            return None
        (name,) = value
        return inner._pair(name)

    def _pair(self, name: str) -> Length | None:
        pair = self.values[name]
        if not isinstance(pair, list) or len(pair) != 2:
            words = "minimum and maximum" if name == "uniform" else "mean and deviation"
            self.wrong((name,), f"a list of two times, {words}", pair)
            return None
        first, second = (self._duration((name, i), each) for i, each in enumerate(pair))
        if first is None or second is None:
            return None
        if name == "normal":
            return Normal(first, second)
        if first > second:
            self.wrong((name,), "the minimum before the maximum", pair)
            return None
        return Uniform(first, second)

    def duration(self, key: str) -> int | None:
        """Read a fixed duration."""
        return self._duration((key,), self.values[key])

    def _duration(self, way: Way, value: Any) -> int | None:
        length = duration(value) if isinstance(value, str) else None
        if length is None:
            too_long = isinstance(value, str) and is_too_long(value)
            self.wrong(way, "at most 292 years" if too_long else _DURATION, value)
        return length

    def share(self, key: str) -> float | None:
        """Read a probability."""
        value = self.values[key]
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 <= value <= 1:
            self.wrong((key,), "a probability from 0 to 1", value)
            return None
        return float(value)

    def whole(self, key: str, low: int | None = None, high: int | None = None) -> int | None:
        """Read an integer."""
        value = self.values[key]
        plain = isinstance(value, int) and not isinstance(value, bool)
        if plain and (low is None or value >= low) and (high is None or value <= high):
            return int(value)
        words = "a whole number"
        if low is not None:
            words += f" from {low}" + (f" to {high}" if high is not None else "")
        if low is not None and low == high:
            words = f"{low}"
        self.wrong((key,), words, value)
        return None

    def text(self, key: str, what: str) -> str | None:
        """Read a string that is not empty."""
        value = self.values[key]
        if isinstance(value, str) and value:
            return value
        self.wrong((key,), what, value)
        return None

    def name(self, key: str, known: Iterable[str], what: str) -> str | None:
        """Read one of the known names."""
        return self._name((key,), self.values[key], known, what)

    def names(self, key: str, known: Iterable[str], what: str) -> tuple[str, ...]:
        """Read one or several known names."""
        return self.names_at((key,), known, what)

    def names_at(self, way: Way, known: Iterable[str], what: str) -> tuple[str, ...]:
        """Read one or several known names in a list of such groups."""
        value: Any = self.values
        for key in way:
            value = value[key]
        if not isinstance(value, list):
            found = self._name(way, value, known, what)
            return (found,) if found is not None else ()
        each = [self._name((*way, i), name, known, what) for i, name in enumerate(value)]
        return tuple(name for name in each if name is not None)

    def _name(self, way: Way, name: Any, known: Iterable[str], what: str) -> str | None:
        if not isinstance(name, str):
            self.wrong(way, f"the name of a {what}", name)
            return None
        if name in known:
            return name
        self.unknown(self.value_place(way), name, known, what)
        return None

    def unknown(self, place: Span, name: str, known: Iterable[str], what: str) -> None:
        """Report an unknown name."""
        help_ = suggest(
            name, known, f"{what.removesuffix('y')}ies" if what.endswith("y") else f"{what}s"
        )
        self.report.report("unresolved-name", place, kind=what, name=name, help=help_)

    def fitted(self, fit: Callable[[Any, Way], T], *way: str | int) -> T | None:
        """Read a value of a type of the model."""
        value: Any = self.values
        for key in way:
            value = value[key]
        try:
            return fit(value, way)
        except MisfitError as error:
            place = self.value_place(error.way)
            if error.code == "unknown-field":
                place = self.document.places[(*self.keys, *error.way)].key
            self.report.report(error.code, place, help=error.help, **error.fields)
            return None

    def wrong(self, way: Way, expected: str, found: Any) -> None:
        """Report a value of the wrong kind."""
        keys = (*self.keys, *way)
        name = next((key for key in reversed(keys) if isinstance(key, str)), "")
        self.report.report(
            "wrong-value", self.value_place(way), name=name, expected=expected, found=kind(found)
        )

    def key_place(self, key: str) -> Span:
        """Return the span of a key."""
        return self.document.places[(*self.keys, key)].key

    def value_place(self, way: Way) -> Span:
        """Return the span of a value."""
        return self.document.places[(*self.keys, *way)].value
