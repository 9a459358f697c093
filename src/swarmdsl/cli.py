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
    from swarmdsl.diagnostics import Diagnostics
    from swarmdsl.emit import Request

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
@_format
@_debug
def check(paths: tuple[Path, ...], format_: str) -> int:
    """Find mistakes in models.

    A FOLDER stands for all .swarm files below it; nothing, for the current folder.
    """
    from swarmdsl import compiler

    return _conclude(compiler.check(paths or (Path(),)), format_, sys.stdout)


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
    help="What to make; may be repeated. Without it: all that can express the model.",
)
@click.option(
    "--out",
    "-o",
    type=click.Path(path_type=Path),
    default="out",
    show_default=True,
    help="The output folder; each target has a folder in it.",
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
@_format
@_debug
def build(
    paths: tuple[Path, ...],
    targets: tuple[str, ...],
    out: Path,
    options: tuple[str, ...],
    force: bool,
    dump_ir: bool,
    format_: str,
) -> int:
    """Check models and generate what the targets make of them.

    Files that were edited are not overwritten, files that are up to date not touched, and
    what an earlier build made and this one does not is removed.
    """
    from swarmdsl import compiler

    requests = _requests(targets, options)
    if dump_ir:
        result = compiler.check(paths or (Path(),))
        if result.system is not None:
            from swarmdsl.ir.dump import dump

            click.echo(dump(result.system), nl=False)
        return _conclude(result, format_, sys.stderr)
    result = compiler.build(paths or (Path(),), requests, out, force=force)
    return _conclude(result, format_, sys.stdout)


def _requests(targets: tuple[str, ...], options: tuple[str, ...]) -> list[Request]:
    from swarmdsl import plugins
    from swarmdsl.emit import Request

    requests = [Request(target) for target in targets]
    if not targets:
        requests = [Request(target, required=False) for target in plugins.target_names()]
    known = {request.target for request in requests}
    for option in options:
        name, equals, value = option.partition("=")
        target, dot, name = name.partition(".")
        if not (equals and dot and name):
            raise click.UsageError(f"`--option {option}` has not the form TARGET.NAME=VALUE")
        if target not in known:
            raise click.UsageError(f"`--option {option}`: target `{target}` is not built")
        # Not required: only a `--target` makes it so.
        requests.append(Request(target, {name: value}, required=False))
    return requests


def _conclude(result: Result, format_: str, stream: TextIO) -> int:
    """Print what came of a run; return the exit code."""
    render(result.report, format_, stream)
    if result.written is not None:
        from swarmdsl.render.written import render_written

        render_written(result.written, sys.stderr)
    click.echo(summary(result.report, result.files), err=True)
    return _exit_code(result.report)


def _exit_code(report: Diagnostics) -> int:
    errors = {found.name for found in report if found.severity.value == "error"}
    if not errors:
        return OK
    return USAGE if errors <= _USAGE_FAULTS else ERRORS


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
            click.echo(f"{entry.code}  {name:<{width}}  {entry.severity}")
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
