"""How a place in a model is opened in the editor of the user."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from typing import TypedDict
from urllib.parse import quote

from swarmdsl.base.records import dataclass

_PLACE = re.compile(r"(?P<file>.+):(?P<line>\d+):(?P<column>\d+)")
_GAP = re.compile(r"\{(\w*)\}")
_GAPS = ("file", "line", "column")
# All of them are told so where to go.
_KNOWN = ("code", "codium", "cursor", "windsurf")


class Opened(TypedDict, total=False):
    """What becomes of a place: `address` is for the browser to open, `failed` says why not.

    Nothing of both where the editor was started, `none` where there is none.
    """

    address: str
    failed: str
    none: bool


class TemplateError(ValueError):
    """A command that cannot be one; says why."""


@dataclass(frozen=True)
class Editor:
    """The words of a command, or an address; with `{file}`, `{line}` and `{column}` in them."""

    words: tuple[str, ...]
    is_address: bool = False

    def open(self, place: str) -> Opened:
        """Open a place, `FILE:LINE:COLUMN`; what the user sees of the program is its own matter."""
        values = _values(place)
        if values is None:
            return {"failed": "this is no place"}
        if self.is_address:
            # A drive of Windows is a part of the path.
            path = quote(values["file"].replace("\\", "/"), safe="/:")
            return {"address": _filled(self.words[0], {**values, "file": path})}
        command = [_filled(word, values) for word in self.words]
        try:
            subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        except OSError as error:
            return {"failed": f"{command[0]}: {error.strerror}"}
        return {}


def file_of(place: str) -> str | None:
    """The file of a place."""
    values = _values(place)
    return values["file"] if values is not None else None


def editor(template: str) -> Editor:
    """An editor as the user says how it is called. Raises TemplateError."""
    is_address = "://" in template
    try:
        words = (
            (template,) if is_address else tuple(shlex.split(template, posix=os.name == "posix"))
        )
    except ValueError as error:
        raise TemplateError(f"`{template}`: {str(error)[:1].lower()}{str(error)[1:]}") from error
    unknown = sorted({gap for word in words for gap in _GAP.findall(word)} - {*_GAPS})
    if unknown:
        raise TemplateError(f"`{{{unknown[0]}}}` is none of {{file}}, {{line}} and {{column}}")
    if not any("{file}" in word for word in words):
        raise TemplateError("`{file}` must stand where the file is to be named")
    if not is_address and shutil.which(words[0]) is None:
        raise TemplateError(f"there is no program `{words[0]}`")
    return Editor(words, is_address)


def found_editor() -> Editor | None:
    """The first editor on the PATH of those that are known to take a place."""
    program = next(filter(None, map(shutil.which, _KNOWN)), None)
    return Editor((program, "--goto", "{file}:{line}:{column}")) if program is not None else None


def _values(place: str) -> dict[str, str] | None:
    match = _PLACE.fullmatch(place)
    return match.groupdict() if match is not None else None


def _filled(text: str, values: dict[str, str]) -> str:
    return _GAP.sub(lambda gap: values[gap[1]], text)
