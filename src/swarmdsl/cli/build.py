"""`swarmc build`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.cli.outcome import conclude
from swarmdsl.cli.parameters import FORMAT, LEVELS, WATCH, Option

if TYPE_CHECKING:
    from swarmdsl.compiler import Result
    from swarmdsl.project.settings import Settings

EPILOG = "Example: swarmc build model.swarm --target smach --option smach.NAME=VALUE -o out"
OPTIONS = (
    Option(
        "targets",
        ("--target", "-t"),
        "What to make; may be repeated. Without it: the targets of swarm.toml, or all that "
        "can express the model and need not be asked for.",
        kind=str,
        metavar="TARGET",
        repeated=True,
    ),
    Option(
        "out",
        ("--out", "-o"),
        "The output folder; each target has a folder in it.  [default: that of swarm.toml, "
        "or `out`]",
        kind=Path,
    ),
    Option(
        "given",
        ("--option",),
        "An option of a target; see `swarmc targets TARGET`.",
        kind=str,
        metavar="TARGET.NAME=VALUE",
        repeated=True,
    ),
    Option(
        "force",
        ("--force",),
        "Overwrite generated files that were edited, and others in their place.",
    ),
    Option("dump_ir", ("--dump-ir",), "Print the intermediate representation and write nothing."),
    WATCH,
    *LEVELS,
    FORMAT,
)


def build(
    paths: tuple[Path, ...],
    targets: tuple[str, ...],
    out: Path | None,
    given: tuple[str, ...],
    force: bool,
    dump_ir: bool,
    watch: bool,
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Check models and generate what the targets make of them.

    Files that were edited are not overwritten, files that are up to date not touched, and
    what an earlier build made and this one does not is removed.
    """
    from swarmdsl import compiler
    from swarmdsl.diagnostics import Diagnostics, Level
    from swarmdsl.project.command_line import UsageError, requests, run_settings

    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    report = Diagnostics()
    settings = run_settings(paths, levels, report)
    wanted = requests(targets, given, settings)
    if watch and dump_ir:
        raise UsageError("--dump-ir prints once: use it without --watch")
    if watch:
        from swarmdsl.cli.watch import watch_files

        def build_again(checked: Result, settings: Settings) -> int:
            wanted = requests(targets, given, settings)
            folder = out or settings.out
            result = compiler.generate(checked, wanted, folder, force=force)
            return conclude(result, format_, sys.stdout)

        return watch_files(paths, lambda report: run_settings(paths, levels, report), build_again)
    stream = sys.stderr if dump_ir else sys.stdout
    if report.has_errors:
        return conclude(compiler.Result(report, files=1), format_, stream)
    if not dump_ir:
        folder = out or settings.out
        result = compiler.build(settings.sources, wanted, folder, settings, force=force)
        return conclude(result, format_, stream)
    result = compiler.check(settings.sources, settings)
    if result.system is not None:
        from swarmdsl.ir.dump import dump

        sys.stdout.write(dump(result.system))
    return conclude(result, format_, stream)
