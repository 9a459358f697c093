"""Descriptions of the targets, for people and for programs."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Feature, Generator, Mapped, Support
from swarmdsl.codegen.options import options_of


def all_targets(report: Diagnostics) -> list[Generator]:
    """Return every target that works; report the others."""
    for name in registry.shadowed_names():
        reason = "its name is that of a built-in target, which is used instead"
        report.report("broken-generator", name=name, reason=reason)
    found = []
    for name in registry.target_names():
        generator = registry.load(name)
        if isinstance(generator, Generator):
            found.append(generator)
        elif generator is not None:
            report.report("broken-generator", name=name, reason=generator.reason)
    return found


def one_target(name: str, report: Diagnostics) -> list[Generator]:
    """Return the target of that name in a list, or report why there is none."""
    generator = registry.load(name)
    if isinstance(generator, Generator):
        return [generator]
    if generator is None:
        hint = registry.similar_target(name)
        report.report("unknown-target", name=name, help=hint)
    else:
        report.report("generator-failed", target=name, reason=generator.reason)
    return []


def as_list(generators: Sequence[Generator]) -> str:
    """Return one line for each target."""
    width = max((len(generator.target) for generator in generators), default=0)
    return "".join(f"{made.target:<{width}}  {made.summary}\n" for made in generators)


def as_page(generator: Generator) -> str:
    """Return the full description of one target."""
    return "\n".join(_page(generator)) + "\n"


def _page(generator: Generator) -> Iterator[str]:
    yield f"{generator.target}: {generator.summary}"
    if generator.target in registry.ON_REQUEST:
        yield f"\nbuilt on request only: `--target {generator.target}`, or in swarm.toml"
    if options := options_of(generator).values():
        yield f"\noptions, given as `--option {generator.target}.NAME=VALUE`"
        for option in options:
            yield f"  {option.name}: {option.help}"
            only = option.only and f"; counts only with `{option.only}`"
            yield f"    takes {option.takes}; default: {_shown(option.default)}{only}"
    missing = _cannot_express(generator)
    mappings = _mappings(generator)
    refused = any(row.support is Support.REJECTED for rows in mappings.values() for row in rows)
    but = ", except what is rejected below" if refused else ""
    yield "\ncannot express" if missing else f"\ncan express every construct of state machines{but}"
    yield from (f"  {construct}" for construct in missing)
    for with_, mapping in mappings.items():
        with_ = with_ and f" with `{generator.target}.{with_}`"
        yield f"\ntranslation of the constructs of a model{with_}"
        wide = max(len(each.construct) for each in mapping)
        for each in mapping:
            yield f"  {each.construct:<{wide}}  {each.support.value:<8}  {each.means}"


def _mappings(generator: Generator) -> dict[str, tuple[Mapped, ...]]:
    """Return the tables of constructs, by the value of the option that selects them."""
    return {"": generator.mapping, **generator.mapping_with} if generator.mapping else {}


def _shown(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)


def _cannot_express(generator: Generator) -> list[str]:
    return [feature.value for feature in Feature if feature not in generator.supports]


def as_json(generators: Sequence[Generator]) -> str:
    """Return the descriptions as a JSON list of objects."""
    return json.dumps([_as_json(generator) for generator in generators], indent=2) + "\n"


def _as_json(generator: Generator) -> dict[str, Any]:
    return {
        "name": generator.target,
        "summary": generator.summary,
        "options": [
            {
                "name": option.name,
                "type": option.type.__name__,
                "default": option.default,
                "choices": list(option.choices),
                "help": option.help,
                **({"counts_only_with": option.only} if option.only else {}),
            }
            for option in options_of(generator).values()
        ],
        "cannot_express": _cannot_express(generator),
        "mapping": _rows(generator.mapping),
        "mapping_with": {
            option: _rows(mapping) for option, mapping in generator.mapping_with.items()
        },
    }


def _rows(mapping: Sequence[Mapped]) -> list[dict[str, str]]:
    return [
        {"construct": one.construct, "support": one.support.value, "means": one.means}
        for one in mapping
    ]
