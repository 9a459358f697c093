"""Settings and build requests from the command line and the project file.

Raises UsageError for invalid options.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostics, Level
from swarmdsl.base.errors import UsageError
from swarmdsl.base.records import replace
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import did_you_mean
from swarmdsl.driver.config import find_settings
from swarmdsl.driver.config.settings import Settings

if TYPE_CHECKING:
    from swarmdsl.codegen.emit import Request


def run_settings(
    paths: tuple[Path, ...], levels: Mapping[Level, Iterable[str]], report: Diagnostics
) -> Settings:
    """Return the settings of the project, overridden by the command line."""
    given = named_levels(levels)
    found = find_settings(paths, report)
    return replace(found, sources=paths or found.sources, levels={**found.levels, **given})


def requests(targets: Iterable[str], options: Iterable[str], settings: Settings) -> list[Request]:
    """Return the targets to build: named or configured ones, else the defaults.

    An option on the command line overrides the one in the project file.
    """
    named = list(dict.fromkeys(targets))
    from swarmdsl.codegen import registry
    from swarmdsl.codegen.emit import Request

    # Only an explicitly requested target must be able to express the model.
    required = bool(named or settings.targets)
    built = named or list(settings.targets) or registry.default_names()
    given: dict[str, dict[str, str]] = {target: {} for target in built}
    places: dict[str, dict[str, Span]] = {target: {} for target in built}
    for option in options:
        name, equals, value = option.partition("=")
        target, dot, name = name.partition(".")
        if not (equals and dot and name):
            way = f": write `{built[0]}.{option}`" if equals and len(built) == 1 else ""
            raise UsageError(f"`--option {option}` is not of the form TARGET.NAME=VALUE{way}")
        if target not in given:
            way = did_you_mean(target, given) or f"add `--target {target}`"
            raise UsageError(f"`--option {option}`: target `{target}` is not built: {way}")
        if given[target].setdefault(name, value) != value:
            raise UsageError(
                f"`{target}.{name}` is given as `{given[target][name]}` and as `{value}`"
            )
        places[target][name] = _place(option)
    return [
        Request(
            target,
            {**settings.targets.get(target, {}), **own},
            required,
            {**settings.places.get(target, {}), **places[target]},
        )
        for target, own in given.items()
    ]


def _place(option: str) -> Span:
    """Return the span of an option, as it is written."""
    source = Source(COMMAND_LINE, f"--option {option}")
    return Span(source, len(source.text) - len(option), len(source.text))


def named_levels(levels: Mapping[Level, Iterable[str]]) -> dict[str, Level]:
    """Map each named diagnostic to its level; raise UsageError for an unknown one."""
    found: dict[str, Level] = {}
    if not any(levels.values()):
        return found
    # Imported here because most runs name no level and do not need the catalog.
    from swarmdsl.driver.config.lint import find_diagnostic, may_have, similar_diagnostic

    for level, words in levels.items():
        for word in words:
            name = find_diagnostic(word)
            option = f"`--{level.value} {word}`"
            if name is None:
                hint = similar_diagnostic(word) or "`swarmc explain` lists all"
                raise UsageError(f"{option}: there is no diagnostic `{word}`: {hint}")
            if not may_have(name, level):
                raise UsageError(f"{option}: errors cannot be allowed")
            if (other := found.setdefault(name, level)) is not level:
                raise UsageError(f"{option}: `--{other.value}` names `{name}` too")
    return found
