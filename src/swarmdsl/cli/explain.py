"""`swarmc explain`."""

from __future__ import annotations

import sys

import click

from swarmdsl.cli.exit_code import OK


@click.command(epilog="Example: swarmc explain SW0202")
@click.argument("word", metavar="[CODE|NAME]", required=False)
def explain(word: str | None) -> int:
    """Explain a diagnostic, or list all diagnostics."""
    from swarmdsl.base.diagnostics import explain as pages
    from swarmdsl.base.diagnostics.catalog import CODES

    if word is None:
        width = max(map(len, CODES))
        for name, entry in CODES.items():
            silent = " (on request)" if entry.silent else ""
            click.echo(f"{entry.code}  {name:<{width}}  {entry.severity}{silent}")
        return OK
    code = pages.find_code(word)
    if code is None:
        from swarmdsl.base.suggest import did_you_mean

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
