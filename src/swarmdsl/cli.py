"""The command line: `swarmc`.

What was asked for goes to stdout, all about the run to stderr. Whatever a command needs
is imported when it runs, so that `swarmc --version` is quick.
"""

from __future__ import annotations

import errno
import logging
import os
import signal
import sys
from collections.abc import Sequence
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import click

from swarmdsl.render import FORMATS, render, summary

if TYPE_CHECKING:
    from swarmdsl.compiler import Result
    from swarmdsl.diagnostics import Diagnostic, Diagnostics

OK, ERRORS, USAGE, INTERNAL = range(4)
# As a shell reports it for a program that a signal ended.
_INTERRUPTED = 128 + signal.SIGINT
_TERMINATED = 128 + signal.SIGTERM

_LOG = logging.getLogger(__name__)

# Mistakes on the command line that only the pipeline can find.
_USAGE_FAULTS = frozenset({"unknown-target", "bad-option"})

_files = click.argument(
    "paths", metavar="[FILE|FOLDER]...", nargs=-1, type=click.Path(path_type=Path)
)
_format = click.option(
    "--format",
    "format_",
    type=click.Choice(FORMATS),
    default=FORMATS[0],
    show_default=True,
    help="How diagnostics are printed.",
)
_allow = click.option(
    "--allow", multiple=True, metavar="NAME", help="Silence a warning; may be repeated."
)
_warn = click.option(
    "--warn",
    multiple=True,
    metavar="NAME",
    help="Report a warning that is silent unless asked for, or that swarm.toml silences or denies. "
    "May be repeated.",
)
_deny = click.option(
    "--deny",
    multiple=True,
    metavar="NAME",
    help="Take a warning for an error; `warnings` stands for all. May be repeated.",
)


def _show_debug(_context: click.Context, _param: click.Parameter, debug: bool) -> None:
    if debug:
        logging.basicConfig(format="%(message)s")
        logging.getLogger("swarmdsl").setLevel(logging.DEBUG)


_debug = click.option(
    "--debug",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_show_debug,
    help="Show tracebacks.",
)


@click.group(
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example: swarmc build examples/search_and_rescue --target smach -o out",
)
@click.version_option(package_name="swarmdsl", prog_name="swarmc")
@_debug
def cli() -> None:
    """Compile swarms of robots: .swarm models to exchange formats and ROS packages."""


@cli.command(epilog="Example: swarmc check examples/search_and_rescue --format concise")
@_files
@_allow
@_warn
@_deny
@_format
@_debug
def check(
    paths: tuple[Path, ...],
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Find mistakes in models.

    A FOLDER stands for all .swarm files below it; nothing, for the sources that swarm.toml
    names, or for the current folder.
    """
    from swarmdsl import compiler
    from swarmdsl.diagnostics import Diagnostics, Level
    from swarmdsl.project.command_line import run_settings

    report = Diagnostics()
    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    settings = run_settings(paths, levels, report)
    if report.has_errors:
        return _conclude(compiler.Result(report, files=1), format_, sys.stdout)
    return _conclude(compiler.check(settings.sources, settings), format_, sys.stdout)


@cli.command(
    epilog="Example: swarmc build model.swarm --target smach --option smach.NAME=VALUE -o out"
)
@_files
@click.option(
    "--target",
    "-t",
    "targets",
    multiple=True,
    metavar="TARGET",
    help="What to make; may be repeated. Without it: the targets of swarm.toml, or all that "
    "can express the model.",
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
    "options",
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
@_allow
@_warn
@_deny
@_format
@_debug
def build(
    paths: tuple[Path, ...],
    targets: tuple[str, ...],
    out: Path | None,
    options: tuple[str, ...],
    force: bool,
    dump_ir: bool,
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
    wanted = requests(targets, options, settings)
    stream = sys.stderr if dump_ir else sys.stdout
    if report.has_errors:
        return _conclude(compiler.Result(report, files=1), format_, stream)
    if not dump_ir:
        out = out or settings.out
        result = compiler.build(settings.sources, wanted, out, settings, force=force)
        return _conclude(result, format_, stream)
    result = compiler.check(settings.sources, settings)
    if result.system is not None:
        from swarmdsl.ir.dump import dump

        click.echo(dump(result.system), nl=False)
    return _conclude(result, format_, stream)


def _conclude(result: Result, format_: str, stream: TextIO) -> int:
    """Print what came of a run; return the exit code."""
    render(result.report, format_, stream)
    if result.written is not None:
        from swarmdsl.render.written import render_written

        render_written(result.written, sys.stderr)
    click.echo(summary(result.report, result.files), err=True)
    return _exit_code(result.report)


def _exit_code(report: Diagnostics) -> int:
    errors = [found for found in report if found.severity.value == "error"]
    if not errors:
        return OK
    return USAGE if all(map(_is_usage_fault, errors)) else ERRORS


def _is_usage_fault(found: Diagnostic) -> bool:
    # In a file it is the project file that has them.
    in_file = found.primary is not None and not found.primary.span.on_command_line
    return found.name in _USAGE_FAULTS and not in_file


@cli.command(epilog="Example: swarmc fmt examples --diff")
@_files
@click.option("--check", "check_only", is_flag=True, help="List what would change, write nothing.")
@click.option("--diff", is_flag=True, help="Show what would change, write nothing.")
@_format
@_debug
def fmt(paths: tuple[Path, ...], check_only: bool, diff: bool, format_: str) -> int:
    """Bring files into the canonical layout.

    A FOLDER stands for all .swarm files below it; nothing, for the current folder; `-`, for
    standard input, whose layout goes to standard output. A file with syntax errors is left
    as it is. With `--check` and `--diff`, the exit code is 1 when there is something to change.
    """
    from swarmdsl.diagnostics import Diagnostics
    from swarmdsl.format import command

    if Path("-") in paths and len(paths) > 1:
        raise click.UsageError("`-` stands alone")
    report = Diagnostics()
    if check_only or diff:
        outcome = command.inspect(paths, report, as_diff=diff)
    else:
        outcome = command.rewrite(paths, report)
    render(report, format_, sys.stderr)
    if outcome.summary:
        click.echo(outcome.summary, err=True)
    return _exit_code(report) or (OK if outcome.done else ERRORS)


@cli.command(epilog="Example: swarmc targets smach")
@click.argument("name", required=False)
@click.option(
    "--format",
    "format_",
    type=click.Choice(("text", "json")),
    default="text",
    show_default=True,
    help="How the answer is printed.",
)
@_debug
def targets(name: str | None, format_: str) -> int:
    """List the targets, or say what one of them takes and what it cannot express."""
    from swarmdsl import targets as known
    from swarmdsl.diagnostics import Diagnostics

    report = Diagnostics()
    found = known.all_targets(report) if name is None else known.one_target(name, report)
    if format_ == "json":
        click.echo(known.as_json(found), nl=False)
    elif name is None:
        click.echo(known.as_list(found), nl=False)
    else:
        click.echo("".join(map(known.as_page, found)), nl=False)
    render(report, "text", sys.stderr)
    return _exit_code(report)


@cli.command(epilog="Example: swarmc explain SW0202")
@click.argument("word", metavar="[CODE|NAME]", required=False)
def explain(word: str | None) -> int:
    """Explain a diagnostic, or list all there are."""
    from swarmdsl import explain as pages
    from swarmdsl.codes import CODES

    if word is None:
        width = max(map(len, CODES))
        for name, entry in CODES.items():
            silent = " (if asked for)" if entry.silent else ""
            click.echo(f"{entry.code}  {name:<{width}}  {entry.severity}{silent}")
        return OK
    code = pages.find_code(word)
    if code is None:
        from swarmdsl.suggest import did_you_mean

        known = [*CODES, *(entry.code for entry in CODES.values())]
        hint = did_you_mean(word, known) or "`swarmc explain` lists all"
        raise click.UsageError(f"there is no diagnostic `{word}`: {hint}")
    text = pages.page(code)
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.markdown import Markdown

        Console().print(Markdown(text))
    else:
        click.echo(text, nl=False)
    return OK


def main() -> None:
    """Run `swarmc` in its own process."""
    for stream in (sys.stdout, sys.stderr):
        # A name of a file or of a model may have what the terminal's encoding lacks.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if hasattr(signal, "SIGPIPE"):
        # `swarmc targets | head -1` ends quietly, as other programs do.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    # As an exception, so that files that are being written are cleaned up.
    signal.signal(signal.SIGTERM, lambda _signal, _frame: sys.exit(_TERMINATED))
    sys.exit(run(sys.argv[1:]))


def run(arguments: Sequence[str]) -> int:
    """Run a command line; return the exit code."""
    try:
        code = cli.main(list(arguments), prog_name="swarmc", standalone_mode=False)
        sys.stdout.flush()
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        return _INTERRUPTED
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _STDOUT_FAULTS:
            _close_stdout()
            click.echo(f"swarmc: cannot write the output: {error.strerror}", err=True)
            return ERRORS
        _LOG.debug("internal error", exc_info=True)
        click.echo(f"swarmc: internal error: {type(error).__name__}: {error}", err=True)
        click.echo("this is a bug in swarmc; `--debug` shows where", err=True)
        return INTERNAL
    return int(code or OK)


# All other input and output of swarmc turns its errors into diagnostics.
_STDOUT_FAULTS = frozenset({errno.ENOSPC, errno.EIO, errno.EBADF})


def _close_stdout() -> None:
    """Spare the interpreter a second attempt to write what cannot be written."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
