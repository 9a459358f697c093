"""Join modules of JavaScript into one script, each in a scope of its own.

    // a.js                              const $a = (() => {
    export const one = 1;                const one = 1;
                                         return { one };
                                         })();
    // b.js                              const $b = (() => {
    import { one } from "./a.js";        const { one } = $a;
    console.log(one);                    console.log(one);
                                         return {  };
                                         })();

Imports and exports must have these forms, one a line: no default, no star, no list of exports.
Comments that have lines of their own and indentation are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.read_files import read_text

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./([\w/.-]+\.js)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?(?:const|let|function\*?|class) (\w+))", re.MULTILINE)
_COMMENT = re.compile(r"^[ \t]*(?://.*|/\*\*?(?s:.*?)\*/)[ \t]*\n", re.MULTILINE)
_INDENTED = re.compile(r"^[ \t]+", re.MULTILINE)
_ANY = re.compile(r"^(?:import|export)\b.*$", re.MULTILINE)


class BadModuleError(ValueError):
    """A module with an import or export that cannot be joined, or that imports itself."""


def join(folder: Path, name: str) -> str:
    """Return a module and what it imports as one script."""
    done: dict[str, str] = {}
    _add(folder, name, done, ())
    return "\n".join(['"use strict";', *done.values(), ""])


def _add(folder: Path, name: str, done: dict[str, str], above: tuple[str, ...]) -> None:
    if name in above:
        raise BadModuleError(" imports ".join((*above, name)))
    if name in done:
        return
    text = read_text(folder / name)
    for found in _IMPORT.finditer(text):
        _add(folder, found[2], done, (*above, name))
    done[name] = _scoped(name, text)


def _scoped(name: str, text: str) -> str:
    names = ", ".join(_exported(text))
    body = _IMPORT.sub(lambda found: f"const {{{_renamed(found[1])}}} = {_called(found[2])};", text)
    body = _EXPORT.sub(r"\1", body)
    odd = _ANY.search(body)
    if odd is not None:
        raise BadModuleError(f"{name}: {odd[0]}")
    body = _INDENTED.sub("", _COMMENT.sub("", body)).replace("</script", r"<\/script")
    return f"const {_called(name)} = (() => {{\n{body}return {{ {names} }};\n}})();"


def _exported(text: str) -> Iterator[str]:
    return (found[2] for found in _EXPORT.finditer(text))


def _renamed(names: str) -> str:
    """Return the names of an import as those of a pattern: `view as map` is `view: map`."""
    return re.sub(r"\b(\w+) as (\w+)\b", r"\1: \2", names)


def _called(name: str) -> str:
    return "$" + re.sub(r"\W", "_", name.removesuffix(".js"))
