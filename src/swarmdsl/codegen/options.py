"""Options of a target: from strings to the generator's options dataclass."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, get_type_hints

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.errors import describe_exception
from swarmdsl.base.records import dataclass, fields_of
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.registry import BUILT_IN

_BOOLEANS = {"true": True, "false": False}
_TAKES = {str: "a string", int: "a whole number", bool: "`true` or `false`"}


@dataclass(frozen=True)
class Option:
    """Description of an option of a target."""

    name: str
    type: type
    default: str | bool | int
    help: str
    choices: tuple[str, ...]
    check: Callable[[Any], str | None] | None
    beside: str
    only: str

    @property
    def takes(self) -> str:
        """Allowed values, for people."""
        return listed(list(self.choices)) if self.choices else _TAKES[self.type]

    def parse(self, text: str) -> str | bool | int | None:
        """Return the value of a string, or None if the option does not allow it."""
        if self.choices and text not in self.choices:
            return None
        if self.type is bool:
            return _BOOLEANS.get(text)
        if self.type is int:
            return int(text) if _is_integer(text) else None
        return text


def options_of(generator: Generator) -> dict[str, Option]:
    """Return the options of a target by name."""
    return _options(generator.options_type)


@cache
def _options(type_: type) -> dict[str, Option]:
    types = get_type_hints(type_)
    return {
        name: _option(name, types[name], about["default"], about.get("metadata", {}))
        for name, about in fields_of(type_).items()
    }


def _option(name: str, type_: type, default: Any, about: Mapping[str, Any]) -> Option:
    return Option(
        name,
        type_,
        default,
        about.get("help", ""),
        tuple(about.get("choices", ())),
        about.get("check"),
        about.get("beside", ""),
        about.get("only", ""),
    )


def parse_options(
    generator: Generator,
    given: Mapping[str, str],
    report: Diagnostics,
    places: Mapping[str, Span] | None = None,
    *,
    is_all: bool = True,
) -> object:
    """Return the generator's options; report wrong values and use defaults for them.

    `places` are the origins of the values: in the project file, or on the command line. If not
    `is_all`, further options can be given elsewhere.
    """
    places = places or {}
    known = options_of(generator)
    values: dict[str, str | bool | int] = {}
    for name, text in given.items():
        place = places.get(name)
        if name not in known:
            fault = f"there is no option `{name}`"
            hint = suggest(name, known, "options")
            report.report("bad-option", place, target=generator.target, fault=fault, help=hint)
            continue
        value = known[name].parse(text)
        if value is None:
            fault = f"option `{name}` takes {known[name].takes}, not `{text}`"
            report.report("bad-option", place, target=generator.target, fault=fault)
        elif _passes(known[name], value, generator, place, report):
            values[name] = value
    options = generator.options_type(**values)
    for name in values if is_all else ():
        condition = known[name].only
        other, _, value_of_other = condition.partition("=")
        if condition and str(getattr(options, other)) != value_of_other:
            fault = f"option `{name}` counts only with `{condition}`"
            report.report("bad-option", places.get(name), target=generator.target, fault=fault)
    return options


def _passes(
    option: Option,
    value: str | bool | int,
    generator: Generator,
    place: Span | None,
    report: Diagnostics,
) -> bool:
    """Return True if the generator accepts a value; report the fault otherwise."""
    if option.check is None:
        return True
    try:
        fault = option.check(value)
    except Exception as error:
        if generator.target in BUILT_IN:
            raise
        # A bug in third-party code is not one of swarmdsl.
        fault = describe_exception(f"checking an option of target {generator.target}", error)
        reason = f"its check of option `{option.name}` ends with {fault}"
        report.report("generator-failed", place, target=generator.target, reason=reason)
        return False
    if fault is not None:
        report.report("bad-option", place, target=generator.target, fault=fault)
    return fault is None


def _is_integer(text: str) -> bool:
    digits = text.removeprefix("-")
    return digits.isascii() and digits.isdecimal() and len(digits) <= 18
