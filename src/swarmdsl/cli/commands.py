"""The command line as Click parses it, with help."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce, wraps
from importlib import import_module
from keyword import iskeyword
from types import ModuleType

import click

from swarmdsl import __version__
from swarmdsl.base.errors import UsageError
from swarmdsl.cli import options
from swarmdsl.cli.command_names import COMMANDS, PLAIN
from swarmdsl.cli.exit_code import INTERRUPTED, OK
from swarmdsl.cli.suggestions import Group, unknown_option


class _Commands(Group):
    """Group of the commands, each imported on demand."""

    def list_commands(self, _context: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, _context: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            return None
        called = f"{name}_" if iskeyword(name) else name
        module = import_module(f"swarmdsl.cli.{called}")
        command = _of_click(module, name) if name in PLAIN else getattr(module, called)
        assert isinstance(command, click.Command)
        return command


def _of_click(module: ModuleType, name: str) -> click.Command:
    """Make a Click command of a plain function and its options as plain data."""
    function = getattr(module, name)

    @wraps(function)
    def called_by_click(*arguments: object, **named: object) -> object:
        try:
            return function(*arguments, **named)
        except UsageError as error:
            raise click.UsageError(str(error)) from error

    decorators = [options.files, *map(options.option, module.OPTIONS), options.debug]
    decorated = reduce(
        lambda inner, decorator: decorator(inner), reversed(decorators), called_by_click
    )
    return click.command(epilog=module.EPILOG)(decorated)


@click.command(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example: swarmc build examples/search_and_rescue --target smach -o out",
    invoke_without_command=True,
    no_args_is_help=True,
)
@click.option("--version", is_flag=True, help="Show the version.")
@click.option("--verbose", is_flag=True, help="With --version: everything that a bug report needs.")
@options.debug
@click.pass_context
def cli(context: click.Context, version: bool, verbose: bool) -> None:
    """Compile .swarm models of robot swarms to exchange formats and ROS packages."""
    if verbose and not version:
        raise click.UsageError("`--verbose` needs `--version`")
    if version:
        click.echo(f"swarmc, version {__version__}")
        if verbose:
            from swarmdsl.tools.doctor import environment

            for name, value in environment():
                click.echo(f"{name}: {value}")
        context.exit()
    if context.invoked_subcommand is None:
        raise click.UsageError("Missing command.")


def run(arguments: Sequence[str]) -> int:
    """Run a command line; return the exit code."""
    try:
        return cli.main(list(arguments), prog_name="swarmc", standalone_mode=False) or OK
    except click.NoSuchOption as error:
        click.UsageError(unknown_option(error), error.ctx).show()
        return error.exit_code
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except click.Abort:
        return INTERRUPTED
