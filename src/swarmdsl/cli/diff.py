"""`swarmc diff`."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import OK
from swarmdsl.cli.suggestions import Choice
from swarmdsl.tools.compare.rules import RULES

if TYPE_CHECKING:
    from swarmdsl.base.source import Span
    from swarmdsl.ir import System
    from swarmdsl.tools.compare.revisions import Revision

# As of diff(1): 1 for a difference, 2 for trouble.
DIFFERENT, TROUBLE = 1, 2


def _rule(word: str) -> str:
    """Return the rule of this name, in any case."""
    rule = word.upper()
    if rule not in RULES:
        from swarmdsl.base.suggest import did_you_mean

        hint = did_you_mean(rule, RULES) or "`swarmc diff --rules` lists all"
        raise click.BadParameter(f"there is no rule `{word}`: {hint}")
    return rule


def _show_rules(context: click.Context, _param: click.Parameter, wanted: bool) -> None:
    if wanted:
        width = max(map(len, RULES))
        for rule, about in RULES.items():
            click.echo(f"{rule:<{width}}  {about}")
        context.exit()


@click.command(epilog="Example: swarmc diff --against main --breaking examples/search_and_rescue")
@click.argument("models", metavar="[[BEFORE] AFTER]", nargs=-1)
@click.option(
    "--against",
    metavar="REVISION",
    help="Compare with a revision of git: `main`, `v1.0`, `HEAD~2`, `.git#branch=main`.",
)
@click.option("--breaking", is_flag=True, help="Show only changes that break users of the model.")
@click.option(
    "--allow",
    metavar="RULE",
    multiple=True,
    callback=lambda _context, _param, words: tuple(map(_rule, words)),
    help="With --breaking: ignore this rule; may be repeated.",
)
@click.option(
    "--rules",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_rules,
    help="List the rules of --breaking and exit.",
)
@click.option(
    "--format",
    "format_",
    type=Choice(("text", "markdown", "json")),
    default="text",
    show_default=True,
    help="Output format; JSON is one line per difference.",
)
@options.debug
def diff(
    models: tuple[str, ...],
    against: str | None,
    breaking: bool,
    allow: tuple[str, ...],
    format_: str,
) -> int:
    """Show the differences between two models, in terms of the model.

    A model is a file, a folder or, as git writes it, REVISION:PATH; with --against alone it is
    the current folder. The exit code is 0 without differences (with --breaking: without
    breaking ones), 1 with differences, and 2 if a model cannot be read.
    """
    from swarmdsl.base.read_files import exists
    from swarmdsl.tools.compare import report
    from swarmdsl.tools.compare.comparison import compare
    from swarmdsl.tools.compare.revisions import is_revision, parse_model
    from swarmdsl.tools.compare.revisions import parse_against as revision

    if not models and against is not None:
        models = (".",)
    if len(models) != (1 if against is not None else 2):
        raise click.UsageError("give two models, or one and `--against`")
    if allow and not breaking:
        raise click.UsageError("`--allow` needs `--breaking`")
    first, last = models[0], Path(models[-1])
    if against is None and not exists(first) and is_revision(first, last):
        way = f"write `swarmc diff --against {first} {last}`"
        raise click.UsageError(f"`{first}` is not a file but a revision of git: {way}")
    after = parse_model(models[-1])
    before = parse_model(models[0]) if against is None else revision(against, Path(models[0]))
    with ExitStack() as stack:
        shown = _Shown()
        systems = [_system(each, shown, stack) for each in (before, after)]
        old, new = systems
        if old is None or new is None:
            return TROUBLE
        changes, breaking_changes = compare(old, new)
        if breaking:
            breaking_changes = [each for each in breaking_changes if each.rule not in allow]
            lines = report.format_breaking_changes(breaking_changes, format_, shown.place)
        else:
            lines = report.format_changes(changes, breaking_changes, format_, shown.place)
        found = list(lines)
    for line in found:
        click.echo(line)
    if not found and format_ == "text":
        click.echo("nothing breaks" if breaking else "no differences", err=True)
    return DIFFERENT if found else OK


class _Shown:
    """Names to show for files in temporary folders."""

    def __init__(self) -> None:
        self._revisions: dict[str, str] = {}

    def add(self, folder: Path, revision: str) -> None:
        self._revisions[f"{folder}/"] = f"{revision}:"

    def name(self, name: str) -> str:
        for folder, revision in self._revisions.items():
            if name.startswith(folder):
                return f"{revision}{name.removeprefix(folder)}"
        return name

    def place(self, span: Span) -> str:
        return f"{self.name(span.absolute.source.name)}:{span.line}"


def _system(model: Path | Revision, shown: _Shown, stack: ExitStack) -> System | None:
    """Return the checked model; None if it has errors, which are printed."""
    from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.driver import pipeline
    from swarmdsl.driver.config.command_line import run_settings
    from swarmdsl.tools.compare.revisions import extract

    report = Diagnostics()
    path: Path | None
    if isinstance(model, Path):
        path = model
    else:
        folder = Path(os.path.realpath(stack.enter_context(TemporaryDirectory())))
        shown.add(folder, model.revision)
        path = extract(model, folder, report)
    if path is not None:
        settings = run_settings((path,), {}, report)
        if not report.has_errors:
            result = pipeline.check(settings.sources, settings)
            if result.system is not None:
                return result.system
            report = result.report
    errors = [found for found in report if found.severity is Severity.ERROR]
    spans = {label.span for each in errors for label in (each.primary, *each.related) if label}
    for source in {span.absolute.source for span in spans}:
        source.name = shown.name(source.name)
    render(errors, "concise", sys.stderr)
    return None
