"""Suggestions for unknown commands, options and choices.

The module that compares words is imported on an error: help and completion do without it.
"""

from __future__ import annotations

from typing import Any

import click


class Choice(click.Choice):  # type: ignore[type-arg]  # no generic class in Click 8.1
    """A choice that suggests a similar one."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        """Return the choice as Click does."""
        try:
            return super().convert(value, param, context)
        except click.BadParameter as error:
            from swarmdsl.base.suggest import did_you_mean

            question = did_you_mean(str(value), self.choices)
            if question is None:
                raise
            self.fail(f"{error.message.rstrip('.')}: {question}", param, context)


class Group(click.Group):
    """A group of commands that suggests a similar one."""

    def resolve_command(
        self, context: click.Context, words: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command as Click does."""
        name, known = words[0], self.list_commands(context)
        if name not in known and not (name.startswith("-") or context.resilient_parsing):
            from swarmdsl.base.suggest import did_you_mean

            hint = did_you_mean(name, known) or f"`{context.command_path} --help` lists all"
            context.fail(f"there is no command `{name}`: {hint}")
        return super().resolve_command(context, words)


def unknown_option(error: click.NoSuchOption) -> str:
    """Message about an unknown option, with a similar one of this or another command."""
    from swarmdsl.base.suggest import closest, did_you_mean

    name, context = error.option_name, error.ctx
    message = f"there is no option `{name}`"
    # All options of one letter are equally similar.
    if context is None or not name.startswith("--"):
        return message
    if question := did_you_mean(name, _options_of(context.command, context)):
        return f"{message}: {question}"
    owners: dict[str, list[str]] = {}
    # Siblings of the command come first.
    for around in (context, context.find_root()):
        for path, command in _commands(around):
            for option in _options_of(command, context):
                owners.setdefault(option, []).append(path)
    meant = closest(name, owners, likeness=0.8)
    return f"{message} here: `{owners[meant][0]}` has `{meant}`" if meant else message


def _options_of(command: click.Command, context: click.Context) -> list[str]:
    return [
        name
        for param in command.get_params(context)
        if isinstance(param, click.Option) and not param.hidden
        for name in (*param.opts, *param.secondary_opts)
        if name.startswith("--")
    ]


def _commands(around: click.Context) -> list[tuple[str, click.Command]]:
    """Commands directly below a context, with their paths: `swarmc add`."""
    group = around.command
    if not isinstance(group, click.Group):
        return []
    found = [(name, group.get_command(around, name)) for name in group.list_commands(around)]
    return [(f"{around.command_path} {name}", each) for name, each in found if each is not None]
