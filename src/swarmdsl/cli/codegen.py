"""`swarmc codegen`."""

from __future__ import annotations

from pathlib import Path

import click

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.base.errors import UsageError
from swarmdsl.cli import options
from swarmdsl.cli.output_options import CHECK, DIFF, DRY_RUN, FORCE, RENAME, writing
from swarmdsl.cli.suggestions import Choice
from swarmdsl.driver.config.command_line import named_levels

_FILE = options.PLACE


@click.command(epilog="Example: swarmc codegen --env ROS --scxml sar.xml --adf uav.json -o out")
@click.option(
    "--env",
    "-e",
    type=Choice(["ROS"], case_sensitive=False),
    default="ROS",
    show_default=True,
    help="Target environment.",
)
@click.option(
    "--scxml", "--src", type=_FILE, required=True, metavar="FILE", help="The state machine."
)
@click.option(
    "--adf", type=_FILE, metavar="FILE", help="Description of the functions that it calls."
)
@click.option(
    "--output",
    "-o",
    "--target",
    "out",
    type=_FILE,
    required=True,
    metavar="DIR",
    help="The folder for the packages.",
)
@click.option(
    "--mode", type=Choice(["simulation"]), help="Add a launch file for Gazebo and a world."
)
@click.option(
    "--package", default="fsm_behaviour", show_default=True, help="The name of the package."
)
@click.option(
    "--language",
    type=Choice(["cpp", "python"]),
    default="cpp",
    show_default=True,
    help="The language of skeletons.",
)
@options.option(FORCE)
@options.option(CHECK)
@options.option(DRY_RUN)
@options.option(DIFF)
@options.option(RENAME)
@options.levels
@options.diagnostics_format
@options.debug
def codegen(
    env: str,
    scxml: Path,
    adf: Path | None,
    out: Path,
    mode: str | None,
    package: str,
    language: str,
    force: bool,
    check: bool,
    dry_run: bool,
    diff: bool,
    renames: tuple[str, ...],
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Generate ROS packages from SCXML and ADF files, like the CPSwarm code generator.

    To keep the model in between, use `swarmc import scxml`.
    """
    from swarmdsl.tools.codegen_command import codegen as generate

    try:
        how_to_write = writing(locals())
        levels = named_levels({Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny})
    except UsageError as error:
        raise click.UsageError(str(error)) from error
    described = () if adf is None else ("--adf", adf)
    simulation = () if mode is None else ("--mode", mode)
    called = ("--package", package, "--language", language, *simulation)
    how = how_to_write.how("swarmc", "codegen", "--scxml", scxml, *described, "-o", out, *called)
    result = generate(
        scxml, adf, out, package, levels, language=language, simulation=mode is not None, how=how
    )
    return how_to_write.conclude(result, format_)
