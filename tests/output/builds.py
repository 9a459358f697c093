"""Builds of files of a target that is called `t`, and what comes of them."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import fits
from swarmdsl.output import WriteOptions, Written, write

Output = dict[str, list[OutputFile]]

LINES = [f"line {number}\n" for number in range(1, 10)]


def text(**changes: str) -> str:
    """Nine lines, some of them changed: `text(l3="x")`."""
    lines = list(LINES)
    for name, line in changes.items():
        lines[int(name[1:]) - 1] = line
    return "".join(lines)


def build(out: Path, *files: OutputFile, **how: object) -> tuple[Written | None, list[Diagnostic]]:
    report = Diagnostics()
    written = write({"t": files}, out, report, WriteOptions(**how))  # type: ignore[arg-type]
    return written, list(report)


def names(found: tuple[Written | None, list[Diagnostic]]) -> list[str]:
    return [each.name for each in found[1]]


def tree(out: Path) -> dict[str, str]:
    """All files but the lists of swarmc."""
    return {
        path.relative_to(out).as_posix(): path.read_text(encoding="utf-8")
        for path in out.rglob("*")
        if path.is_file() and not path.name.startswith(".swarmdsl")
    }


def plain(content: str) -> OutputFile:
    return OutputFile("f", content)


def skeleton(name: str, *facts: str, body: str = "pass") -> list[OutputFile]:
    """The package of an element: one file to fill in, and one that is generated."""
    cls = name.capitalize()
    facts = (f"class {cls}", *facts)
    mine = f"# {fits(facts)}\nfrom {name}.base import {cls}Base\nclass {cls}({cls}Base):\n {body}\n"
    return [
        OutputFile(f"{name}/{name}.py", mine, keep=True, owner=name, facts=facts),
        OutputFile(f"{name}/base.py", f"class {cls}Base:\n  {len(facts)}\n", owner=name),
    ]


def write_ok(output: Output, out: Path, **options: object) -> Written:
    """Build without a complaint."""
    report = Diagnostics()
    written = write(output, out, report, WriteOptions(**options))  # type: ignore[arg-type]
    assert written is not None, [found.message for found in report]
    assert len(report) == 0
    return written


def errors(output: Output, out: Path, **options: object) -> list[str]:
    """The names of what was reported; nothing may have been written."""
    before = everything(out)
    report = Diagnostics()
    assert write(output, out, report, WriteOptions(**options)) is None  # type: ignore[arg-type]
    assert everything(out) == before
    return [found.name for found in report]


def everything(folder: Path) -> dict[str, bytes | None]:
    """All files and folders, those of swarmc too."""
    if not folder.is_dir():
        return {}
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }


def files(**texts: str) -> Output:
    """Files with these texts, of target `t`; `_` in a name stands for a dot."""
    return {"t": [OutputFile(name.replace("_", "."), text) for name, text in texts.items()]}
