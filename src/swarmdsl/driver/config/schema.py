"""Schema of the project file."""

from __future__ import annotations

import datetime
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Label, Level
from swarmdsl.base.read_files import is_file
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.options import Option, options_of, parse_options
from swarmdsl.driver.config.lint import find_diagnostic, may_have, similar_diagnostic
from swarmdsl.driver.config.project_keys import BUILD, LINT, PACKAGE, PROJECT, TABLES
from swarmdsl.driver.config.settings import FILE_NAME, ModelSource, Settings
from swarmdsl.driver.config.toml import Document, Keys
from swarmdsl.ir.function_models import MODELS

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

# In the order of `isinstance`: a bool is an int, a datetime is a date.
_KINDS: dict[type | tuple[type, ...], str] = {
    str: "a string",
    bool: "a boolean",
    int: "a whole number",
    float: "a number",
    list: "a list",
    dict: "a table",
    (datetime.date, datetime.time): "a time",
}


def read_settings(document: Document, folder: Path, report: Diagnostics) -> Settings:
    """Read settings from a document; its paths are relative to `folder`."""
    return _Reader(document, folder, report).read()


class _Reader:
    def __init__(self, document: Document, folder: Path, report: Diagnostics) -> None:
        self._document = document
        self._folder = folder
        self._report = report

    def read(self) -> Settings:
        self._check_keys(self._document.values, (), TABLES)
        project = self._table("project", PROJECT)
        build = self._table("build", BUILD)
        targets = dict(self._targets())
        return Settings(
            name=self._name() if "name" in project else None,
            sources=tuple(self._sources()) if "sources" in project else (self._folder,),
            libraries=(self._folder, *(self._libraries() if "libraries" in project else ())),
            targets=targets,
            places={target: self._places(target, options) for target, options in targets.items()},
            levels=self._levels(),
            models={each.name: each for each in self._models()},
            out=self._path(("build", "out")) or Path() if "out" in build else self._folder / "out",
            folder=self._folder,
            out_place=self._value_place(("build", "out")) if "out" in build else None,
        )

    def _name(self) -> str | None:
        keys = ("project", "name")
        name = self._text(keys)
        if name is not None and not PACKAGE.fullmatch(name):
            self._report_wrong(keys, "a name like `sar` or `rescue.sea`", f"`{name}`")
        return name

    def _sources(self) -> Iterator[Path]:
        if self._get(("project", "sources")) == []:
            self._report_wrong(("project", "sources"), "files and folders", "nothing")
        for _, path in self._paths(("project", "sources")):
            yield path

    def _libraries(self) -> Iterator[Path]:
        for keys, path in self._paths(("project", "libraries")):
            if is_file(path):
                self._report_wrong(keys, "folders", f"the file `{path}`")
            yield path

    def _paths(self, keys: Keys) -> Iterator[tuple[Keys, Path]]:
        for item in self._items(keys):
            if (path := self._path(item)) is not None:
                if not os.path.lexists(path):
                    self._report.report("file-not-found", self._value_place(item), path=path)
                yield item, path

    def _path(self, keys: Keys) -> Path | None:
        text = self._text(keys)
        if text is None:
            return None
        if not text or "\0" in text:
            self._report_wrong(keys, "a path", "this")
            return None
        return Path(os.path.normpath(self._folder / text))

    def _targets(self) -> Iterator[tuple[str, dict[str, str]]]:
        for target in self._table("targets"):
            keys: Keys = ("targets", target)
            if not registry.has(target):
                place = self._document.places[keys].key
                hint = registry.similar_target(target)
                self._report.report("unknown-target", place, name=target, help=hint)
                continue
            generator = registry.load(target) if self._get(keys) else None
            known_options = options_of(generator) if isinstance(generator, Generator) else {}
            options = dict(self._options(keys, known_options))
            if isinstance(generator, Generator):
                places = self._places(target, options)
                parse_options(generator, options, self._report, places, is_all=False)
            yield target, options

    def _models(self) -> Iterator[ModelSource]:
        """Yield the function models: a class in a file of Python, or the name of an entry point."""
        for name in self._table("models"):
            keys: Keys = ("models", name)
            text, place = self._text(keys), self._value_place(keys)
            if text is None:
                continue
            if not _NAME.fullmatch(name):
                place = self._document.places[keys].key
                self._report.report(
                    "wrong-value", place, name="models", expected="names", found=f"`{name}`"
                )
                continue
            if name in MODELS:
                self._report_wrong(keys, "a name that swarmdsl has no model of", f"`{name}`")
                continue
            file, _, attribute = text.rpartition(":")
            if not file and _NAME.fullmatch(attribute):
                yield ModelSource(name, attribute, place=place)
            elif file.endswith(".py") and _NAME.fullmatch(attribute) and "\0" not in file:
                path = Path(os.path.normpath(self._folder / file))
                yield ModelSource(name, attribute, path, place)
            else:
                expected = "a class in a file, like `models/auction.py:Auction`, or an entry point"
                self._report_wrong(keys, expected, f"`{text}`")

    def _places(self, target: str, options: Iterable[str]) -> dict[str, Span]:
        return {name: self._pair_place(("targets", target, name)) for name in options}

    def _options(self, keys: Keys, known: dict[str, Option]) -> Iterator[tuple[str, str]]:
        """Return the options of a target as strings, as on a command line."""
        table = self._get(keys)
        if not isinstance(table, dict):
            self._report_wrong(keys, "a table of options", _kind(table))
            return
        for name, value in table.items():
            option = known.get(name)
            if option is not None and type(value) is not option.type:
                self._report_wrong((*keys, name), option.takes, _kind(value))
            elif isinstance(value, bool):
                yield name, str(value).lower()
            elif isinstance(value, (str, int)):
                yield name, str(value)
            else:
                expected = "a string, a whole number or a boolean"
                self._report_wrong((*keys, name), expected, _kind(value))

    def _levels(self) -> dict[str, Level]:
        given: dict[str, tuple[Level, Span]] = {}
        table = self._table("lint", LINT)
        for level in Level:
            for keys in self._items(("lint", level.value)) if level.value in table else ():
                word, place = self._text(keys), self._value_place(keys)
                name = find_diagnostic(word) if word is not None else None
                if word is not None and name is None:
                    help_ = similar_diagnostic(word) or "`swarmc explain` lists all"
                    self._report.report("unknown-diagnostic", place, name=word, help=help_)
                if name is None:
                    continue
                if not may_have(name, level):
                    self._report.report("not-a-warning", place, name=name)
                    continue
                if name in given:
                    related = (Label(given[name][1], "also given here"),)
                    item = f"the level of `{name}`"
                    self._report.report("repeated-item", place, item=item, related=related)
                given.setdefault(name, (level, place))
        return {name: level for name, (level, _) in given.items()}

    def _table(self, name: str, known: Iterable[str] | None = None) -> dict[str, Any]:
        """Return a top-level table, empty if missing; check its keys against `known`."""
        table = self._document.values.get(name, {})
        if not isinstance(table, dict):
            self._report_wrong((name,), f"a table: `[{name}]`", _kind(table))
            return {}
        if known is not None:
            self._check_keys(table, (name,), known)
        return table

    def _check_keys(self, table: dict[str, Any], above: Keys, known: Iterable[str]) -> None:
        for key in table:
            if key not in known:
                self._report.report(
                    "unknown-key",
                    self._document.places[(*above, key)].key,
                    name=key,
                    owner=f"`[{above[0]}]`" if above else f"`{FILE_NAME}`",
                    help=suggest(key, known, "keys" if above else "tables"),
                )

    def _items(self, keys: Keys) -> Iterator[Keys]:
        """Yield the keys of the items of a list."""
        value = self._get(keys)
        if not isinstance(value, list):
            self._report_wrong(keys, "a list of strings", _kind(value))
            return
        for number in range(len(value)):
            yield (*keys, number)

    def _text(self, keys: Keys) -> str | None:
        value = self._get(keys)
        if not isinstance(value, str):
            self._report_wrong(keys, "a string", _kind(value))
            return None
        return value

    def _get(self, keys: Keys) -> Any:
        value: Any = self._document.values
        for key in keys:
            value = value[key]
        return value

    def _value_place(self, keys: Keys) -> Span:
        return self._document.places[keys].value

    def _pair_place(self, keys: Keys) -> Span:
        key, value = self._document.places[keys]
        return Span(key.source, key.start, value.end)

    def _report_wrong(self, keys: Keys, expected: str, found: str) -> None:
        name = next(key for key in reversed(keys) if isinstance(key, str))
        self._report.report(
            "wrong-value", self._value_place(keys), name=name, expected=expected, found=found
        )


def _kind(value: object) -> str:
    return next(kind for types, kind in _KINDS.items() if isinstance(value, types))
