"""Open a place of a model in the user's editor."""

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
_FIELD = re.compile(r"\{(\w*)\}")
_FIELDS = ("file", "line", "column")
# All of these have the option --goto.
_KNOWN = ("code", "codium", "cursor", "windsurf")


class OpenResult(TypedDict, total=False):
    """Result of opening a place: `address` to open in the browser, or the error in `failed`.

    Empty if the editor was started; `none` if there is no editor.
    """

    address: str
    failed: str
    none: bool


class TemplateError(ValueError):
    """Invalid editor command; the message names the reason."""


@dataclass(frozen=True)
class Editor:
    """Command line or address with the placeholders `{file}`, `{line}` and `{column}`."""

    words: tuple[str, ...]
    is_address: bool = False

    def open(self, place: str) -> OpenResult:
        """Open a place `FILE:LINE:COLUMN`; output of the editor is discarded."""
        values = _values(place)
        if values is None:
            return {"failed": "not a place FILE:LINE:COLUMN"}
        if self.is_address:
            # Keep the colon of a Windows drive.
            path = quote(values["file"].replace("\\", "/"), safe="/:")
            return {"address": _substitute(self.words[0], {**values, "file": path})}
        command = [_substitute(word, values) for word in self.words]
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
    """Return the file of a place."""
    values = _values(place)
    return values["file"] if values is not None else None


def editor(template: str) -> Editor:
    """Parse the editor command given by the user. Raises TemplateError."""
    is_address = "://" in template
    try:
        words = (
            (template,) if is_address else tuple(shlex.split(template, posix=os.name == "posix"))
        )
    except ValueError as error:
        raise TemplateError(f"`{template}`: {str(error)[:1].lower()}{str(error)[1:]}") from error
    unknown = sorted({field for word in words for field in _FIELD.findall(word)} - {*_FIELDS})
    if unknown:
        raise TemplateError(
            f"unknown field `{{{unknown[0]}}}`, expected {{file}}, {{line}} or {{column}}"
        )
    if not any("{file}" in word for word in words):
        raise TemplateError("field `{file}` is missing")
    if not is_address and shutil.which(words[0]) is None:
        raise TemplateError(f"program `{words[0]}` not found")
    return Editor(words, is_address)


def detect_editor() -> Editor | None:
    """Return the first known editor on the PATH."""
    program = next(filter(None, map(shutil.which, _KNOWN)), None)
    return Editor((program, "--goto", "{file}:{line}:{column}")) if program is not None else None


def _values(place: str) -> dict[str, str] | None:
    match = _PLACE.fullmatch(place)
    return match.groupdict() if match is not None else None


def _substitute(text: str, values: dict[str, str]) -> str:
    return _FIELD.sub(lambda field: values[field[1]], text)
