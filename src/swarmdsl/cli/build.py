"""`swarmc build`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.outcome import conclude


@click.command(
    epilog="Example: swarmc build model.swarm --target smach --option smach.NAME=VALUE -o out"
)
@options.files
@click.option(
    "--target",
    "-t",
    "targets",
    multiple=True,
    metavar="TARGET",
    help="What to make; may be repeated. Without it: the targets of swarm.toml, or all that "
    "can express the model and need not be asked for.",
)
@click.option(
    "--out",
    "-o",
    type=click.Path(path_type=Path),
    help="The output folder; each target has a folder in it.  [default: that of swarm.toml, "
    "or `out`]",
)
@click.option(
    "--option",
    "given",
    multiple=True,
    metavar="TARGET.NAME=VALUE",
    help="An option of a target; see `swarmc targets TARGET`.",
)
@click.option(
    "--force",
    is_flag=True,
    help="Overwrite generated files that were edited, and others in their place.",
)
@click.option(
    "--dump-ir", is_flag=True, help="Print the intermediate representation and write nothing."
)
@options.watch
@options.allow
@options.warn
@options.deny
@options.diagnostics_format
@options.debug
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
    from swarmdsl.project.command_line import requests, run_settings

    report = Diagnostics()
    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    settings = run_settings(paths, levels, report)
    wanted = requests(targets, given, settings)
    stream = sys.stderr if dump_ir else sys.stdout
    if watch and dump_ir:
        raise click.UsageError("--dump-ir prints once: use it without --watch")
    if report.has_errors:
        return conclude(compiler.Result(report, files=1), format_, stream)
    if not dump_ir:
        out = out or settings.out
        if watch:
            from swarmdsl.cli.watch import watch_files
            from swarmdsl.workspace import Workspace

            def build_again(workspace: Workspace) -> int:
                result = compiler.Result(workspace.report, workspace.files)
                if not result.report.has_errors:
                    sources = settings.sources
                    result = compiler.build(sources, wanted, out, settings, force=force)
                return conclude(result, format_, stream)

            return watch_files(settings, build_again)
        result = compiler.build(settings.sources, wanted, out, settings, force=force)
        return conclude(result, format_, stream)
    result = compiler.check(settings.sources, settings)
    if result.system is not None:
        from swarmdsl.ir.dump import dump

        click.echo(dump(result.system), nl=False)
    return conclude(result, format_, stream)
