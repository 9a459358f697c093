"""Maps of all environments, and reports of what they cannot hold."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen import Diagnostics, OutputFile, Span, listed
from swarmdsl.ir import Environment, System

from ..environments.bounds import Bounds, bounds_of
from .grid import Grid
from .options import Options

TARGET = "nav2_map"
MOST_CELLS = 25_000_000
_RESOLUTIONS = (0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield the image and the YAML file of each environment."""
    for environment in system.environments:
        bounds = bounds_of(environment)
        if bounds is None:
            report.report(
                "no-place",
                environment.origin,
                target=TARGET,
                what=f"environment `{environment.name}`",
                notes=("it has neither a size nor anything in it",),
                help="give it a size: `size 100 m x 100 m`",
            )
            continue
        grid = Grid(bounds, float(options.resolution))
        if grid.cells > MOST_CELLS:
            _report_size(environment, grid, bounds, report)
            continue
        _report_left_out(environment, report)
        below = float(options.below) if options.below else None
        grid.fill(environment, float(options.thickness), below, zones=options.zones)
        image = f"{environment.name}.pgm"
        yield OutputFile(image, grid.pgm(), origin=environment.origin)
        text = _description(image, grid, bounds)
        yield OutputFile(f"{environment.name}.yaml", text, origin=environment.origin)


def _description(image: str, grid: Grid, bounds: Bounds) -> str:
    return (
        f"image: {image}\n"
        "mode: trinary\n"
        f"resolution: {grid.resolution:.6f}\n"
        f"origin: [{bounds.left:.6f}, {bounds.bottom:.6f}, {0.0:.6f}]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        "free_thresh: 0.196\n"
    )


def _report_size(environment: Environment, grid: Grid, bounds: Bounds, report: Diagnostics) -> None:
    fitting = (
        each
        for each in _RESOLUTIONS
        if each > grid.resolution and Grid(bounds, each).cells <= MOST_CELLS
    )
    coarser = next(fitting, None)
    report.report(
        "unsupported-construct",
        environment.origin,
        target=TARGET,
        construct=f"a map of {grid.columns} x {grid.rows} cells",
        notes=(f"a map has at most {MOST_CELLS // 1_000_000} million cells",),
        help="make the environment smaller"
        if coarser is None
        else f"make the cells larger: `--option {TARGET}.resolution={coarser:g}`",
    )


def _report_left_out(environment: Environment, report: Diagnostics) -> None:
    """Report what a map has no cells for, each kind at its first place."""
    kinds = (
        ("area", [(each.name, each.origin) for each in environment.areas]),
        ("target", [(each.kind, each.origin) for each in environment.targets]),
    )
    for kind, items in kinds:
        if items:
            names = listed(list(dict.fromkeys(name for name, _ in items)), "and")
            many = "s" if len(items) > 1 else ""
            _report(f"{kind}{many} {names}", items[0][1], report)
    if environment.winds:
        _report("wind", environment.winds[0].origin, report)
    if environment.rains:
        _report("rain", environment.rains[0].origin, report)


def _report(what: str, place: Span | None, report: Diagnostics) -> None:
    report.report("no-place", place, target=TARGET, what=what)
