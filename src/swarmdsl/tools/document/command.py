"""Write the page of a model: `swarmc doc`."""

from __future__ import annotations

import os
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_RECORDED, exists, is_file, is_folder, read_file
from swarmdsl.base.records import dataclass
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.tools.document import document

_SUFFIX = ".html"
_SIGNATURE = b"<!-- swarmc doc "


@dataclass(frozen=True)
class DocumentResult:
    """Result of a run; `written` is the page, if it was written."""

    report: Diagnostics
    files: int
    written: Path | None = None


def run(paths: tuple[Path, ...], out: Path | None, *, libraries: bool) -> DocumentResult:
    """Write the page of the model in the given files.

    It goes to file `out`, or into folder `out` or the current folder with the name of the model. A
    file that swarmc has not written or that was edited is not overwritten.
    """
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return DocumentResult(report, 1)
    checked = pipeline.check(paths or settings.sources, settings)
    report.include(checked.report)
    if checked.valid is None:
        return DocumentResult(report, checked.files)
    name, text = document(checked.valid, checked.name, libraries=libraries)
    path = _path(out, name)
    is_written = _write(path, _signed(text), report)
    return DocumentResult(report, checked.files, path if is_written else None)


def _path(out: Path | None, name: str) -> Path:
    if out is None:
        return Path(f"{name}{_SUFFIX}")
    inside = is_folder(out) or (not out.suffix and not exists(out))
    return out / f"{name}{_SUFFIX}" if inside else out


def _signed(text: str) -> bytes:
    """Page with a hash in its last line, by which edits are detected."""
    content = text.encode()
    return content + _SIGNATURE + sha256(content).hexdigest().encode() + b" -->\n"


def _is_ours(content: bytes) -> bool:
    page, _, _ = content.rpartition(_SIGNATURE)
    return not content or content == _signed(page.decode("utf-8", "replace"))


def _write(path: Path, content: bytes, report: Diagnostics) -> bool:
    # Keep a symbolic link and replace its target.
    place = Path(os.path.realpath(path))
    try:
        if is_file(place) and not _is_ours(read_file(place, MOST_RECORDED)):
            reason = "it was edited or not written by swarmc"
            help_ = "move it away, or choose another file with `-o`"
            report.report("would-overwrite", path=path.as_posix(), reason=reason, help=help_)
            return False
        with Staging() as staging:
            staging.add(place, content)
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        reason = error.strerror or str(error)
        reason = reason[:1].lower() + reason[1:]
        report.report("cannot-write", path=path.as_posix(), reason=reason)
        return False
    return True
