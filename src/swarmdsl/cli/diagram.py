"""`swarmc diagram`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code
from swarmdsl.cli.suggestions import Choice


@click.command(
    epilog="Example: swarmc diagram examples/search_and_rescue --kind statechart -o pictures"
)
@options.files
@click.option(
    "--kind",
    type=Choice(("composition", "internal", "statechart", "map", "all")),
    default="all",
    show_default=True,
    help="composition: swarms with their members; internal: members with parts and connectors; "
    "statechart: state machines; map: environments, as SVG.",
)
@click.option(
    "--name",
    "names",
    metavar="NAME",
    multiple=True,
    help="Draw this swarm, member, state machine or environment; may be repeated.",
)
@click.option(
    "--format",
    "format_",
    type=Choice(("svg", "mermaid", "dot", "plantuml")),
    default="svg",
    show_default=True,
    help="Output format.",
)
@click.option(
    "-o",
    "--output",
    "out",
    metavar="FILE|FOLDER",
    type=click.Path(path_type=Path),
    help="The output; several diagrams need a folder.  [default: standard output]",
)
@options.debug
def diagram(
    paths: tuple[Path, ...], kind: str, names: tuple[str, ...], format_: str, out: Path | None
) -> int:
    """Draw diagrams of a model.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or
    the current folder. A model with errors is not drawn.
    """
    from swarmdsl.base.diagnostics.render import render, summary
    from swarmdsl.tools.diagram.command import draw
    from swarmdsl.tools.diagram.formats import SUFFIXES

    if out is not None:
        others = {each: f"--format {name}" for name, each in SUFFIXES.items() if name != format_}
        options.check_picture(out, "-o", SUFFIXES[format_], others)
    options.check_outputs({"-o": out}, paths)
    drawn = draw(paths, kind, names, format_, out)
    render(drawn.report, "text", sys.stderr)
    if drawn.text is not None:
        click.echo(drawn.text, nl=False)
    for path in drawn.written:
        click.echo(path.as_posix(), err=True)
    click.echo(summary(drawn.report, drawn.files), err=True)
    return exit_code(drawn.report)
