"""`swarmc verify`."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK

if TYPE_CHECKING:
    from swarmdsl.execution.verify.automata.limits import Limits
    from swarmdsl.execution.verify.swarm.sizes import Size

_NUMBER = re.compile(r"([0-9]+(?:\.[0-9]+)?) ?(k|M|MB|GB)?")
_UNITS = {None: 1, "k": 10**3, "M": 10**6, "MB": 10**6, "GB": 10**9}
_MOST_CAPACITY = 100
_MOST_FAULTS = 1000


def _sizes(
    _context: click.Context, _param: click.Parameter, texts: tuple[str, ...]
) -> tuple[Size, ...]:
    """Parse numbers of members: `robot=2..5` or `robot=any`."""
    from swarmdsl.execution.verify.swarm.sizes import read_size

    found: list[Size] = []
    for text in texts:
        size = read_size(text)
        if size is None:
            raise click.BadParameter(
                f"`{text}` is not a size like `robot=8`, `robot=2..5` or `robot=any`"
            )
        if any(name == size[0] for name, _ in found):
            raise click.BadParameter(f"the size of `{size[0]}` is given twice")
        found.append(size)
    return tuple(found)


def _limits(_context: click.Context, _param: click.Parameter, texts: tuple[str, ...]) -> Limits:
    """Parse limits: numbers of states, durations, or sizes of memory."""
    from swarmdsl.base.records import replace
    from swarmdsl.execution.simulate.scenario.durations import SECOND, duration
    from swarmdsl.execution.verify.automata.limits import Limits

    limits = Limits()
    for text in texts:
        number = _NUMBER.fullmatch(text)
        length = duration(text)
        if length is not None and length > 0:
            limits = replace(limits, seconds=length / SECOND)
        elif number is not None and (amount := int(float(number[1]) * _UNITS[number[2]])) > 0:
            is_memory = number[2] in ("MB", "GB")
            limits = replace(limits, **{"memory" if is_memory else "states": amount})
        elif number is not None or length is not None:
            raise click.BadParameter(f"`{text}` leaves nothing to look at")
        else:
            raise click.BadParameter(
                f"`{text}` is no number of states like `5M`, time like `2min` or memory like `1GB`"
            )
    return limits


def _new_test(_context: click.Context, _param: click.Parameter, path: Path | None) -> Path | None:
    """Return the path of a test file that does not exist yet."""
    from swarmdsl.execution.testing.discovery import SUFFIX

    if path is not None and not path.name.endswith(SUFFIX):
        raise click.BadParameter(f"`{path}` is no test file: its name must end with `{SUFFIX}`")
    if path is not None and os.path.lexists(path):
        raise click.BadParameter(f"`{path}` exists: name another file, or remove it")
    return path


@click.command(epilog="Example: swarmc verify examples/emergency_exit -o runs")
@options.files
@click.option("--machine", metavar="NAME", help="Verify this state machine alone.")
@click.option("--swarm", metavar="NAME", help="Verify this swarm.")
@click.option(
    "--property",
    "properties",
    metavar="NAME",
    multiple=True,
    help="Prove only this property, without other findings; may be repeated.",
)
@click.option(
    "--size",
    "sizes",
    metavar="ROLE=N|ROLE=N..M|ROLE=any",
    multiple=True,
    callback=_sizes,
    help="Numbers of members of a role, within its multiplicity; with `any`, properties are proved "
    "for every number; may be repeated.  [default: the smallest, at least 1]",
)
@click.option(
    "--channel",
    type=options.Integer(1, _MOST_CAPACITY),
    metavar="N",
    default=2,
    show_default=True,
    help="Events of one kind on their way to a robot, at most; of more, the rest is lost.",
)
@click.option("--lossy", is_flag=True, help="Any event between robots may be lost.")
@click.option(
    "--time",
    type=click.Choice(("ignore", "exact")),
    default="ignore",
    show_default=True,
    help="Let functions, delays and events take any time, or as long as in a simulation.",
)
@click.option(
    "--faults",
    type=options.Integer(0, _MOST_FAULTS),
    metavar="N",
    help="At most N robots may be lost, at any time and for ever.  [default: those that the "
    "scenario loses, else 0]",
)
@click.option(
    "--never",
    "silent",
    metavar="FUNCTION",
    multiple=True,
    help="A function that may never answer; may be repeated.",
)
@click.option(
    "--scenario",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Take numbers of members, params, outcomes of functions, the network, events from outside "
    "and losses from a scenario of `swarmc simulate`.",
)
@click.option(
    "--limit",
    "limits",
    metavar="STATES|TIME|MEMORY",
    multiple=True,
    callback=_limits,
    help="End each search at a number of states, or all at a time, or a size of the process, such "
    "as `5M`, `2min`, `1GB`; may be repeated.  [default: 1M]",
)
@click.option(
    "-o",
    "--output",
    "output",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="Write the runs that show what is wrong, as traces for `swarmc simulate --replay`.",
)
@click.option(
    "--save-test",
    "saved_test",
    type=click.Path(path_type=Path),
    metavar="FILE",
    callback=_new_test,
    help="Write the runs that show what is wrong as behaviour tests, which fail until the model is "
    "mended: NAME.swarmtest.toml.",
)
@click.option(
    "--play",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write a page that plays the first run that violates a property, else one that shows "
    "what is wrong, as HTML.",
)
@click.option(
    "--results",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the verdicts with their conditions as JSON.",
)
@click.option(
    "--junit",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the verdicts as JUnit XML, for CI.",
)
@options.diagnostics_format
@options.debug
def verify(
    paths: tuple[Path, ...],
    machine: str | None,
    swarm: str | None,
    properties: tuple[str, ...],
    sizes: tuple[Size, ...],
    channel: int,
    lossy: bool,
    time: str,
    faults: int | None,
    silent: tuple[str, ...],
    scenario: Path | None,
    limits: Limits,
    output: Path | None,
    saved_test: Path | None,
    play: Path | None,
    results: Path | None,
    junit: Path | None,
    format_: str,
) -> int:
    """Prove properties of a swarm, and find what can go wrong in it.

    All orders of events, outcomes of functions and losses are looked at, for a given number of
    members or for every number. A verdict is `holds`, `fails` with a shortest run, `holds up to` a
    number of states, or `unknown`, and is printed with its conditions.
    """
    from swarmdsl.execution.verify.command import Request
    from swarmdsl.execution.verify.command import verify as run_verification

    if machine is not None and swarm is not None:
        raise click.UsageError("`--machine` and `--swarm` conflict")
    outputs = {"--save-test": saved_test, "--play": play, "--results": results, "--junit": junit}
    options.check_outputs(outputs, paths)
    shown: list[tuple[str, str]] = []
    request = Request(
        paths,
        machine,
        swarm,
        properties,
        sizes,
        channel,
        lossy,
        time == "exact",
        faults,
        silent,
        scenario,
        limits,
        format_,
        output,
        results,
        junit,
        saved_test,
        (lambda name, trace: shown.append((name, trace))) if play is not None else None,
    )
    succeeded = run_verification(request, sys.stdout, sys.stderr)
    if play is not None:
        from swarmdsl.cli.play_pages import play_counterexample

        if not play_counterexample(request, shown, play):
            return ERRORS
    return INTERRUPTED if succeeded is None else OK if succeeded else ERRORS
