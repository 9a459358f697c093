"""`swarmc optimize`."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.base.diagnostics.render import DOCUMENTS, render
from swarmdsl.cli import options, run_options
from swarmdsl.cli.engine_options import check_processes, engine
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK
from swarmdsl.cli.suggestions import Choice

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic
    from swarmdsl.execution.experiments.search.evaluation import Together
    from swarmdsl.execution.experiments.search.methods import Name

_MOST_SEEDS = 100_000


@click.command(
    epilog="Example: swarmc optimize examples/storage --scenario shift.toml --jobs 2 -o results"
)
@options.files
@run_options.candidates
@click.option(
    "--maximize",
    metavar="NAME",
    multiple=True,
    help="An objective instead of the fitness: one of its inputs, `fitness` or a property; may be "
    "repeated, for a front of several objectives.",
)
@click.option(
    "--minimize", metavar="NAME", multiple=True, help="As `--maximize`; less of it is better."
)
@click.option(
    "--method",
    type=Choice(("auto", "cma", "nsga", "tpe", "grid", "random")),
    default="auto",
    show_default=True,
    help="How candidates are found; `auto` tries all of them where they are few, else `cma`, or "
    "`nsga` for several objectives.",
)
@click.option(
    "--evaluations",
    type=options.Integer(1, 1_000_000),
    metavar="N",
    help="Number of candidates that are tried.  [default: that of `optimize`, or 200]",
)
@click.option(
    "--seeds",
    type=options.Integer(2, _MOST_SEEDS),
    metavar="N",
    default=30,
    show_default=True,
    help="Seeds of a candidate in the race, at most.",
)
@click.option(
    "--fresh",
    type=options.Integer(2, _MOST_SEEDS),
    metavar="N",
    default=100,
    show_default=True,
    help="Seeds with which the winner and the model as it is are measured in the end.",
)
@click.option(
    "--seed",
    type=options.Integer(0, 2**31 - 1),
    help="First seed, also of the search.  [default: that of `optimize`, or 0]",
)
@engine
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="Keep the runs, the history and the files of the winner in a folder.",
)
@click.option("--resume", is_flag=True, help="Use the runs that are in the folder.")
@click.option("--apply", is_flag=True, help="Write the winner into the model.")
@click.option(
    "--point",
    type=options.Integer(1, 1000),
    metavar="N",
    help="Point of the front that `--apply` writes.",
)
@options.diagnostics_format
@options.debug
def optimize(
    paths: tuple[Path, ...],
    swarm: str | None,
    scenarios: tuple[Path, ...],
    together: Together,
    maximize: tuple[str, ...],
    minimize: tuple[str, ...],
    properties: tuple[str, ...],
    method: Name,
    evaluations: int | None,
    seeds: int,
    fresh: int,
    seed: int | None,
    until: int | None,
    world: str | None,
    jobs: int | None,
    cluster: str | None,
    limit: float | None,
    feed: Path | None,
    is_json: bool,
    output: Path | None,
    resume: bool,
    apply: bool,
    point: int | None,
    format_: str,
) -> int:
    """Search for the params and numbers of robots with the best fitness.

    The ranges are those that the model declares with `optimize`. All candidates run with the same
    seeds; those that are worse leave the race. The winner runs with seeds that the search has not
    seen, beside the model as it is. The result does not depend on the number of processes.
    """
    from swarmdsl.execution.experiments.search.command import optimize as run_search
    from swarmdsl.execution.experiments.search.problem import Request

    check_processes(jobs, cluster)
    if resume and output is None:
        raise click.UsageError("`--resume` needs `-o`, the folder with the runs")
    run_options.check_scenarios(scenarios)
    objectives = (*maximize, *minimize)
    if len(set(objectives)) != len(objectives):
        raise click.UsageError("an objective is given twice")
    if len(objectives) > 1 and method == "cma":
        raise click.UsageError("`--method cma` has one objective: `nsga` and `tpe` take several")
    if point is not None and (not apply or len(objectives) < 2):
        raise click.UsageError("`--point` needs `--apply` and several objectives")
    is_document = format_ in DOCUMENTS
    if is_document and is_json:
        raise click.UsageError(f"`--format {format_}` and `--json` both print")
    options.check_outputs({"--feed": feed}, (*paths, *scenarios))
    request = Request(
        paths,
        swarm,
        scenarios,
        method,
        evaluations,
        seeds,
        fresh,
        seed,
        together,
        properties,
        until,
        world,
        jobs or os.cpu_count() or 1,
        cluster,
        output,
        resume,
        apply,
        feed,
        is_json,
        limit,
        maximize,
        minimize,
        point,
    )
    if not is_document:
        done = run_search(request, lambda report: render(report, format_, sys.stderr))
    else:
        found: list[Diagnostic] = []
        done = run_search(request, found.extend)
        render(found, format_, sys.stdout)
    return INTERRUPTED if done is None else OK if done else ERRORS
