"""`swarmc build`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.cli.exit_code import briefly, conclude
from swarmdsl.cli.output_options import OPTIONS as WRITING_OPTIONS
from swarmdsl.cli.parameters import FORMAT, LEVELS, WATCH, Option

if TYPE_CHECKING:
    from swarmdsl.driver.config.settings import Settings
    from swarmdsl.driver.pipeline import Result

EPILOG = "Example: swarmc build model.swarm --target smach --option smach.NAME=VALUE -o out"
OPTIONS = (
    Option(
        "targets",
        ("--target", "-t"),
        "The target; may be repeated. Default: the targets of swarm.toml, or all that can "
        "express the model and are not on request.",
        kind=str,
        metavar="TARGET",
        repeated=True,
    ),
    Option(
        "out",
        ("--out", "-o"),
        "The output folder, with a folder for each target.  [default: that of swarm.toml, "
        "or `out`]",
        kind=Path,
    ),
    Option(
        "given",
        ("--option",),
        "Set an option of a target; see `swarmc targets TARGET`.",
        kind=str,
        metavar="TARGET.NAME=VALUE",
        repeated=True,
    ),
    *WRITING_OPTIONS,
    Option(
        "clean",
        ("--clean",),
        "Remove generated files without edits, of the given targets or of all; build nothing.",
    ),
    Option("dump_ir", ("--dump-ir",), "Print the intermediate representation; write nothing."),
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
    check: bool,
    dry_run: bool,
    diff: bool,
    renames: tuple[str, ...],
    clean: bool,
    dump_ir: bool,
    watch: bool,
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Check models and generate the output of targets.

    Files that are up to date are not touched; files of an earlier build that are no longer
    generated are removed. Your code stays: files to fill in are left as they are, edits of
    other files are merged, and code for elements that are gone is set aside.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics, Level
    from swarmdsl.base.records import replace
    from swarmdsl.cli.output_options import writing
    from swarmdsl.driver import pipeline
    from swarmdsl.driver.config.command_line import requests, run_settings
    from swarmdsl.driver.write_bounds import may_write_output

    mode = writing(locals())
    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    report = Diagnostics()
    settings = run_settings(paths, levels, report)
    wanted = requests(targets, given, settings)
    how = mode.how("swarmc", "build", *paths, *_repeated(targets, given, out))
    if watch:
        from swarmdsl.cli.watch import Concluded, watch_files

        def build_again(checked: Result, settings: Settings) -> Concluded:
            wanted = requests(targets, given, settings)
            if out or may_write_output(settings, checked.report):
                result = pipeline.generate(checked, wanted, out or settings.out, how)
            else:
                result = replace(checked, valid=None)

            def say() -> str:
                if not how.dry:
                    return briefly(result, format_, sys.stdout)
                mode.show(result, format_)
                return briefly(replace(result, written=None), format_, sys.stderr)

            return Concluded(how.dry or len(result.report) > 0, say)

        return watch_files(paths, lambda report: run_settings(paths, levels, report), build_again)
    stream = sys.stderr if dump_ir else sys.stdout
    if report.has_errors:
        return conclude(pipeline.Result(report, files=1), format_, stream)
    folder = out or settings.out
    if not (out or dump_ir or may_write_output(settings, report)):
        return conclude(pipeline.Result(report, files=0), format_, stream)
    if clean:
        from swarmdsl.output.clean import clean as clean_folder

        written = clean_folder(folder, targets, report, dry=dry_run)
        return mode.conclude(pipeline.Result(report, files=0, written=written), format_)
    if not dump_ir:
        result = pipeline.build(settings.sources, wanted, folder, settings, how)
        return mode.conclude(result, format_)
    result = pipeline.check(settings.sources, settings)
    if result.system is not None:
        from swarmdsl.ir.dump import dump

        sys.stdout.write(dump(result.system))
    return conclude(result, format_, stream)


def _repeated(targets: tuple[str, ...], given: tuple[str, ...], out: Path | None) -> list[object]:
    """Options to repeat on a command line."""
    words: list[object] = []
    for flag, values in (("--target", targets), ("--option", given)):
        words += (word for value in values for word in (flag, value))
    return words if out is None else [*words, "-o", out]
