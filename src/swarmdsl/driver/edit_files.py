"""Edits of files on disk that hold what was read before."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.rewriting import Change, Layout, rewritten
from swarmdsl.project.read_source import decoded, read_bytes, without_control_characters


def edited(
    changes: Mapping[Path, Iterable[Change]], texts: Mapping[Path, str], report: Diagnostics
) -> list[Layout] | None:
    """Apply changes of `texts`, which were read from files, to these files.

    A file that another program has changed or removed meanwhile is reported; None is returned then.
    """
    layouts = []
    for path, made in changes.items():
        content = read_bytes(path, None, report)
        now = decoded(path, content, None, report) if content is not None else None
        if content is None or now is None:
            return None
        if texts[path] not in (now.text, without_control_characters(now, Diagnostics()).text):
            reason = "another program has changed it meanwhile"
            report.report("cannot-write", path=path, reason=reason, help="run the command again")
            return None
        layouts.append(rewritten(str(path), content, made))
    return layouts
