"""Words on a command line that mean nothing, and what may be meant instead.

What compares words is imported when there is one: help and completion do without it.
"""

from __future__ import annotations

from typing import Any

import click


class Choice(click.Choice):  # type: ignore[type-arg]  # no generic class in Click 8.1
    """One of some words."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        """The word, as Click takes it."""
        try:
            return super().convert(value, param, context)
        except click.BadParameter as error:
            from swarmdsl.base.suggest import did_you_mean

            question = did_you_mean(str(value), self.choices)
            if question is None:
                raise
            self.fail(f"{error.message.rstrip('.')}: {question}", param, context)


class Group(click.Group):
    """Commands below another one."""

    def resolve_command(
        self, context: click.Context, words: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that the words begin with, as Click takes it."""
        name, known = words[0], self.list_commands(context)
        if name not in known and not (name.startswith("-") or context.resilient_parsing):
            from swarmdsl.base.suggest import did_you_mean

            hint = did_you_mean(name, known) or f"`{context.command_path} --help` lists all"
            context.fail(f"there is no command `{name}`: {hint}")
        return super().resolve_command(context, words)


def unknown_option(error: click.NoSuchOption) -> str:
    """What is said of an option that a command does not have: which one it, or another, has."""
    from swarmdsl.base.suggest import closest, did_you_mean

    name, context = error.option_name, error.ctx
    said = f"there is no option `{name}`"
    # Of one letter, any other is as like.
    if context is None or not name.startswith("--"):
        return said
    if question := did_you_mean(name, _options_of(context.command, context)):
        return f"{said}: {question}"
    owners: dict[str, list[str]] = {}
    # What stands below the same command is nearer than what stands below others.
    for around in (context, context.find_root()):
        for path, command in _commands(around):
            for option in _options_of(command, context):
                owners.setdefault(option, []).append(path)
    meant = closest(name, owners, likeness=0.8)
    return f"{said} here: `{owners[meant][0]}` has `{meant}`" if meant else said


def _options_of(command: click.Command, context: click.Context) -> list[str]:
    return [
        name
        for param in command.get_params(context)
        if isinstance(param, click.Option) and not param.hidden
        for name in (*param.opts, *param.secondary_opts)
        if name.startswith("--")
    ]


def _commands(around: click.Context) -> list[tuple[str, click.Command]]:
    """The commands directly below one, with their paths: `swarmc add`."""
    group = around.command
    if not isinstance(group, click.Group):
        return []
    found = [(name, group.get_command(around, name)) for name in group.list_commands(around)]
    return [(f"{around.command_path} {name}", each) for name, each in found if each is not None]
