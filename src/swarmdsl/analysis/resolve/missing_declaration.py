"""Hints for a missing declaration: a line that imports or declares it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache, lru_cache
from itertools import islice
from pathlib import Path

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.find_files import files_below
from swarmdsl.base.read_files import read_text
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    AliasType,
    Component,
    Constant,
    EnumType,
    Environment,
    Event,
    Fitness,
    Function,
    Member,
    MessageType,
    Node,
    StateMachine,
    StructType,
)

# Kinds of declarations by keyword.
_WORDS: dict[str, type[Node]] = {
    **dict.fromkeys(("sensor", "actuator", "controller", "virtual"), Component),
    "const": Constant,
    "enum": EnumType,
    "environment": Environment,
    "event": Event,
    "fitness": Fitness,
    "function": Function,
    "member": Member,
    "message": MessageType,
    "statemachine": StateMachine,
    "struct": StructType,
    "type": AliasType,
}
_DECLARATION = re.compile(
    rf"^(?:(?:swarm|operator|endless) +)*({'|'.join(_WORDS)}) +([A-Za-z]\w*)\b", re.MULTILINE
)
_PACKAGE = re.compile(r"^package +([\w.]+)", re.MULTILINE)

# Files of a folder that are searched for a declaration.
_MOST_SIBLINGS = 50
# The shortest correct declarations.
_LINES: dict[type[Node], str] = {
    Component: "sensor {0} {{ }}",
    Environment: "environment {0} {{ size 50 m x 50 m }}",
    Event: "event {0} : std_msgs/Empty",
    Function: 'function {0} : abstraction {{ service "{0}" : std_srvs/Trigger }}',
    Member: "member {0} {{ }}",
    StateMachine: "statemachine {0} {{ initial Done; final Done }}",
    StructType: "struct {0} {{ }}",
}


def suggest_import(name: str, kinds: tuple[type[Node], ...], project: Project) -> str | None:
    """Return the import of a declaration in a library that comes with swarmdsl.

    Libraries with the same declarations cannot be combined, so the library must be one that the
    project uses, or else the only one with the name. Return None if there is none.
    """
    packages = [package for kind, package in _in_library().get(name, ()) if kind in kinds]
    used = _used_libraries(project)
    if used:
        packages = [package for package in packages if _root(package) in used]
    return f"import {packages[0]}.{name}" if len(packages) == 1 else None


def sibling_imports(name: str, kinds: tuple[type[Node], ...], file: File) -> list[str]:
    """Return the imports of the files in the folder of a file that declare a name.

    A folder with many files is no model, and reading them all takes a while.
    """
    path = file.source.path
    if path is None:
        return []
    siblings = sorted(islice(path.parent.glob(f"*{SUFFIX}"), _MOST_SIBLINGS + 1))
    return [
        f'import "{each.name}"'
        for each in (siblings if len(siblings) <= _MOST_SIBLINGS else ())
        if each != path
        and any(found == name and issubclass(kind, kinds) for kind, found in _declared_in(each))
    ]


def _declared_in(path: Path) -> tuple[tuple[type[Node], str], ...]:
    """Return the kinds and names of the declarations of a file; none if it cannot be read."""
    try:
        return _declared_at(path, path.stat().st_mtime_ns)
    except (OSError, ValueError):
        return ()


@lru_cache(maxsize=_MOST_SIBLINGS)
def _declared_at(path: Path, _time: int) -> tuple[tuple[type[Node], str], ...]:
    # A wrong model in an editor is checked at each letter.
    return tuple((_WORDS[word], name) for word, name in _DECLARATION.findall(read_text(path)))


def library_imports(kinds: tuple[type[Node], ...], project: Project) -> Iterator[tuple[str, str]]:
    """Yield the declarations of some kinds in a library that comes with swarmdsl.

    Each has its import. Libraries other than those that the project uses do not count.
    """
    used = _used_libraries(project)
    for name, found in _in_library().items():
        for kind, package in found:
            if issubclass(kind, kinds) and (not used or _root(package) in used):
                yield name, f"import {package}.{name}"


def _used_libraries(project: Project) -> set[str]:
    """Return the libraries of swarmdsl that the files of a project import."""
    return {
        _root(target.package)
        for file in project.files
        if not file.library
        for _, target in file.imports
    } & {_root(package) for found in _in_library().values() for _, package in found}


def _root(package: str) -> str:
    return package.partition(".")[0]


def suggest_declaration(name: str, kinds: tuple[type[Node], ...]) -> str | None:
    """Return a hint that declares a name as one of these kinds.

    Return None for a kind that cannot be declared by its name alone, like a fitness or an enum.
    """
    if Event in kinds and name.lower() in ("timeout", "timer"):
        return Advice("write a delay without `on`: `after 5 s -> Target`", "delay", "after 5 s")
    line = next((_LINES[kind] for kind in kinds if kind in _LINES), None)
    if line is None:
        return None
    elsewhere = f", or name its ROS package: `package/{name}`" if StructType in kinds else ""
    declared = line.format(name)
    return Advice(f"declare it: `{declared}`{elsewhere}", "declare", declared)


@cache
def _in_library() -> Mapping[str, list[tuple[type[Node], str]]]:
    """Kinds and packages of the declarations of the bundled library, by name.

    A pattern finds them, which takes a hundredth of the time of the parser.
    """
    found: dict[str, list[tuple[type[Node], str]]] = {}
    for path in files_below(resources.library(), SUFFIX):
        text = read_text(path)
        package = "".join(_PACKAGE.findall(text))
        for word, name in _DECLARATION.findall(text):
            found.setdefault(name, []).append((_WORDS[word], package))
    return found
