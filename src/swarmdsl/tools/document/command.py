"""What `swarmc doc` does: from files to one page on disk."""

from __future__ import annotations

import os
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.tools.document import document

_SUFFIX = ".html"
_SIGNATURE = b"<!-- swarmc doc "


@dataclass(frozen=True)
class Documented:
    """What came of a run: `written` is the page, if there is one."""

    report: Diagnostics
    files: int
    written: Path | None = None


def run(paths: tuple[Path, ...], out: Path | None, *, libraries: bool) -> Documented:
    """Write the page about the model in these files.

    It is file `out`, or is called like the model, in folder `out` or in the current one. What
    swarmc has not written, or somebody has edited since, is not overwritten.
    """
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return Documented(report, 1)
    checked = pipeline.check(paths or settings.sources, settings)
    report.include(checked.report)
    if checked.valid is None:
        return Documented(report, checked.files)
    name, text = document(checked.valid, checked.name, libraries=libraries)
    path = _path(out, name)
    is_written = _write(path, _signed(text), report)
    return Documented(report, checked.files, path if is_written else None)


def _path(out: Path | None, name: str) -> Path:
    if out is None:
        return Path(f"{name}{_SUFFIX}")
    is_folder = out.is_dir() or (not out.suffix and not out.exists())
    return out / f"{name}{_SUFFIX}" if is_folder else out


def _signed(text: str) -> bytes:
    """The page with a last line that tells whether it is as it was written."""
    content = text.encode()
    return content + _SIGNATURE + sha256(content).hexdigest().encode() + b" -->\n"


def _is_ours(content: bytes) -> bool:
    page, _, _ = content.rpartition(_SIGNATURE)
    return not content or content == _signed(page.decode("utf-8", "replace"))


def _write(path: Path, content: bytes, report: Diagnostics) -> bool:
    # A link stays one: the file that it leads to is replaced.
    place = Path(os.path.realpath(path))
    try:
        if place.is_file() and not _is_ours(place.read_bytes()):
            reason = "it is not from swarmc, or has been edited"
            help_ = "move it away, or name another file with `-o`"
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
