"""`swarmc completion`."""

from __future__ import annotations

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import OK
from swarmdsl.cli.suggestions import Choice


@click.command(epilog="Example: swarmc completion bash")
@click.argument("shell", type=Choice(("bash", "zsh", "fish")))
@options.debug
def completion(shell: str) -> int:
    """Print a script with which a shell completes commands, options and files.

    In ~/.bashrc or ~/.zshrc: eval "$(swarmc completion bash)". For fish, write the output to
    ~/.config/fish/completions/swarmc.fish.
    """
    from click.shell_completion import get_completion_class

    from swarmdsl.cli.commands import cli

    made = get_completion_class(shell)
    assert made is not None  # Click has all three
    click.echo(made(cli, {}, "swarmc", "_SWARMC_COMPLETE").source())
    return OK
