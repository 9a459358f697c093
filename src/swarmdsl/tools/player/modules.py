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
Comments that have lines of their own are left out, and blanks that mean nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.read_files import read_text

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./([\w/.-]+\.js)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?(?:const|let|function\*?|class) (\w+))", re.MULTILINE)
_COMMENT = re.compile(r"^[ \t]*(?://.*|/\*\*?(?s:.*?)\*/)[ \t]*\n", re.MULTILINE)
_SIGNS = r"{}()\[\];,:=<>&|?*%!"
_STRING = re.compile(r""""(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'""")
_PATTERN = r"/(?![/*])(?:[^/\\\[\n]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/[a-z]*"
_TOKEN = re.compile(
    rf"(?P<kept>{_STRING.pattern}|(?<=[(,=:\[!&|?{{}};\n])[ ]?{_PATTERN})"
    rf"|(?P<line>\n\s*)|(?P<blank>[ ]+(?=[{_SIGNS}\n])|(?<=[{_SIGNS}])[ ]+)|(?P<other>.)"
)
_ANY = re.compile(r"^(?:import|export)\b.*$", re.MULTILINE)


class BadModuleError(ValueError):
    """A module with an import or export that cannot be joined, or that imports itself."""


def join(folder: Path, name: str) -> str:
    """Return a module and what it imports as one script."""
    done: dict[str, str] = {}
    _add(folder, name, done, ())
    # A block, so that two scripts of a page can have the same modules.
    return "\n".join(['"use strict";', "{", *done.values(), "}", ""])


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
    body = _shortened(_COMMENT.sub("", body)).replace("</script", r"<\/script")
    return f"const {_called(name)} = (() => {{\n{body}return {{ {names} }};\n}})();"


def _shortened(text: str) -> str:
    """Leave out blanks; those in strings, templates and regular expressions stay."""
    parts, at = [], 0
    while at < len(text):
        if text[at] == "`":
            end = _template_end(text, at + 1)
            parts.append(text[at:end])
        else:
            found = _TOKEN.match(text, at)
            assert found is not None  # it matches anything
            end = found.end()
            parts.append({"line": "\n", "blank": ""}.get(found.lastgroup or "", found[0]))
        at = end
    return "".join(parts)


def _template_end(text: str, at: int) -> int:
    """Return the end of a template, which may have templates in its holes."""
    while text[at] != "`":
        if text[at] == "\\":
            at += 2
        elif text.startswith("${", at):
            at = _hole_end(text, at + 2)
        else:
            at += 1
    return at + 1


def _hole_end(text: str, at: int) -> int:
    """Return the end of an expression in a template."""
    depth = 1
    while depth:
        if text[at] == "`":
            at = _template_end(text, at + 1)
            continue
        string = _STRING.match(text, at)
        depth += {"{": 1, "}": -1}.get(text[at], 0) if string is None else 0
        at = string.end() if string is not None else at + 1
    return at


def _exported(text: str) -> Iterator[str]:
    return (found[2] for found in _EXPORT.finditer(text))


def _renamed(names: str) -> str:
    """Return the names of an import as those of a pattern: `view as map` is `view: map`."""
    return re.sub(r"\b(\w+) as (\w+)\b", r"\1: \2", names)


def _called(name: str) -> str:
    return "$" + re.sub(r"\W", "_", name.removesuffix(".js"))
