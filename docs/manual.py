"""Write the man page and the handbook page of the commands: `python docs/manual.py`.

Both come from the help of the command line. The wheel installs the man page `docs/swarmc.1`;
`docs/commands.md` has the same content. One page has all commands, so `/` finds any option.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import click

from swarmdsl.cli.commands import cli

HERE = Path(__file__).resolve().parent
TEXTS = {
    "EXIT STATUS": (
        ("0", "No errors."),
        ("1", "Errors, or findings of a check, a test or a comparison."),
        ("2", "A wrong command line; for `diff` and `merge` also unreadable input."),
        ("3", "A bug in swarmc."),
        ("130", "Ctrl-C, or the signal SIGINT."),
        ("143", "The signal SIGTERM."),
    ),
    "ENVIRONMENT": (
        ("NO_COLOR", "Never print colours."),
        ("FORCE_COLOR", "Print colours even if the output is not a terminal."),
        ("XDG_CACHE_HOME", "Folder of compiled templates, in swarmdsl/. Default: ~/.cache."),
        ("PYTHONDONTWRITEBYTECODE", "Do not store compiled templates."),
        (
            "AMENT_PREFIX_PATH, COLCON_PREFIX_PATH, ROS_PACKAGE_PATH",
            "ROS folders that `swarmc lsp` may read, as set by a sourced workspace.",
        ),
        ("ROS_DISTRO", "Shown by `swarmc --version --verbose` and `swarmc doctor`."),
    ),
    "FILES": (
        ("swarm.toml", "The project: sources, targets and options. Searched upwards."),
        ("*.swarm", "Models."),
        ("*.swarmtest.toml", "Behaviour tests, beside the model."),
        ("out/.swarmdsl.json", "The generated files of a build, with their origins in the model."),
        ("out/.swarmdsl.texts", "The content of the last builds, to merge edits with."),
    ),
    "LIMITS": (
        ("files", "Regular files are read and written; pipes, devices and sockets are errors."),
        ("8 MB", "Each model and interface file (SW1217); in editors 2 MB."),
        ("2 MB", "Each document of XML, JSON, YAML or TOML: imports, projects, scenarios, tests."),
        ("256 MB", "Each trace, file of events, and generated file. Logs have no limit."),
        ("100,000", "Files and folders below a folder that is searched (SW0018)."),
        ("16 MB", "Models below a folder that is searched, or in a revision, together (SW0018)."),
        ("65,536", "Characters of a string that constants are put together to (SW0707)."),
    ),
}
_SAYS = "compile swarms of robots"
# Options of all commands, which are listed once.
_EVERYWHERE = ("-h, --help", "--debug")
_SEE_ALSO = "git(1), roslaunch(1)"


@dataclass(frozen=True)
class Page:
    """Help of a command: full name, usage, text, options and example."""

    name: str
    usage: str
    text: tuple[str, ...]
    options: tuple[tuple[str, str], ...]
    example: str


def pages(command: click.Command = cli, above: click.Context | None = None) -> Iterator[Page]:
    """Yield the pages of a command and its subcommands, in the order of the help."""
    context = click.Context(
        command,
        info_name=command.name if above else "swarmc",
        parent=above,
        help_option_names=["-h", "--help"],
    )
    help_ = inspect.cleandoc(command.help or "").replace("\b\n", "")
    given = (each for each in command.get_params(context) if isinstance(each, click.Option))
    records = (each.get_help_record(context) for each in given)
    yield Page(
        context.command_path,
        " ".join((context.command_path, *command.collect_usage_pieces(context))),
        tuple(" ".join(each.split()) for each in help_.split("\n\n")),
        tuple(
            (name, " ".join(about.split()))
            for name, about in filter(None, records)
            if not above or name not in _EVERYWHERE
        ),
        " ".join((command.epilog or "").removeprefix("Example:").split()),
    )
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            below = command.get_command(context, name)
            assert below is not None
            below.name = name
            yield from pages(below, context)


def man_page() -> str:
    """Return the man page, as roff with the macros of man(7)."""
    top, *others = pages()
    lines = [
        '.\\" Written by docs/manual.py.',
        '.TH SWARMC 1 "" swarmdsl "User commands"',
        *(".SH NAME", f"swarmc \\- {_SAYS}"),
        *(".SH SYNOPSIS", ".B swarmc", _roff(top.usage.removeprefix("swarmc "))),
        *(".SH DESCRIPTION", *_paragraphs(top.text)),
        ".PP",
        "Without a file or folder, most commands use the sources of the project file, or the",
        "current folder. Results go to standard output, messages about the run to standard error.",
        *(".SH OPTIONS", *_options(top.options)),
        ".SH COMMANDS",
    ]
    for page in others:
        lines += [f".SS {_quoted(page.name)}", _roff(page.usage), ".PP", *_paragraphs(page.text)]
        lines += _options(page.options)
        if page.example:
            lines += [".PP", "Example:", ".PP", ".nf", ".RS 4", _roff(page.example), ".RE", ".fi"]
    for title, entries in TEXTS.items():
        lines += [f".SH {_quoted(title)}", *_options(entries)]
    lines += [".SH SEE ALSO", _roff(_SEE_ALSO)]
    return "\n".join(lines) + "\n"


def markdown() -> str:
    """Return the handbook page."""
    lines = ["<!-- Written by docs/manual.py: change the help of the command. -->", ""]
    lines += [
        "# Every command",
        "",
        "The output of `swarmc COMMAND --help`, also in the man page `swarmc(1)`.",
    ]
    for page in pages():
        lines += ["", f"## {page.name}", "", "```text", page.usage, "```"]
        for paragraph in page.text:
            lines += ["", _plain(paragraph)]
        if page.options:
            lines += ["", "| option | |", "|---|---|"]
            lines += (
                f"| `{_cell(name)}` | {_cell(_plain(about))} |" for name, about in page.options
            )
        if page.example:
            lines += ["", "```text", page.example, "```"]
    for title, entries in TEXTS.items():
        lines += ["", f"## {title.capitalize()}", "", "| | |", "|---|---|"]
        lines += (f"| `{name}` | {_cell(_plain(about))} |" for name, about in entries)
    return "\n".join(lines) + "\n"


def _paragraphs(texts: tuple[str, ...]) -> Iterator[str]:
    for number, text in enumerate(texts):
        if number:
            yield ".PP"
        yield _roff(text)


def _options(entries: Iterable[tuple[str, str]]) -> Iterator[str]:
    for name, about in entries:
        yield from (".TP", f".B {_roff(name)}", _roff(about))


def _roff(text: str) -> str:
    """Escape requests and escapes of roff; print `code` in bold."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace('"', "\\(dq")
    text = re.sub(r"`([^`]+)`", r"\\fB\1\\fR", text)
    return f"\\&{text}" if text.startswith((".", "'")) else text


def _quoted(text: str) -> str:
    return f'"{_roff(text)}"'


def _plain(text: str) -> str:
    """Escape Markdown outside of code."""
    parts = text.split("`")
    parts[::2] = (re.sub(r"([*_<>\[\]])", r"\\\1", part) for part in parts[::2])
    return "`".join(parts)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


if __name__ == "__main__":
    (HERE / "swarmc.1").write_text(man_page(), encoding="utf-8")
    (HERE / "commands.md").write_text(markdown(), encoding="utf-8")
