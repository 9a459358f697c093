"""Compare layouts of state machines with those of ELK, by what makes them hard to read."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from pathlib import Path
from statistics import median
from time import process_time

import peers
from elk_graph import DIRECTIONS, Handling, drawing_of_elk, elk_graph
from measure import Section, process
from mission_model import mission_model, states
from picture_counts import Counts, counts, drawing_of
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.driver import pipeline
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.layout.directions import fitted_size
from swarmdsl.tools.diagram.views import diagrams

ROUNDS = 5
_COLUMNS = (
    *("size", "crossings", "bends", "jogs", "on rules", "heads", "label distance"),
    *("edge length", "CPU, ms"),
)
_ROOT = Path(__file__).resolve().parents[1]
_GOLDEN = ("everything", "language", "submachine")

Measured = tuple[Counts, float]
"""Counts of a layout, and its CPU time in milliseconds."""


def models(folder: Path) -> Iterator[tuple[str, list[Diagram]]]:
    """Yield state machines to lay out, in named groups."""
    large = folder / "mission.swarm"
    large.write_text(mission_model(), encoding="utf-8")
    yield f"{len(states())} states on three levels", _machines(large)
    examples = sorted(path for path in (_ROOT / "examples").iterdir() if path.is_dir())
    yield "all examples", [each for path in examples for each in _machines(path)]
    golden = [_ROOT / "tests" / "golden" / name for name in _GOLDEN]
    yield "golden models", [each for path in golden for each in _machines(path)]


def _machines(path: Path) -> list[Diagram]:
    system = pipeline.check([path]).system
    assert system is not None, path
    return list(diagrams(system, ("statechart",)))


def ours(group: Sequence[Diagram]) -> list[Measured]:
    """Measure the layouts of swarmdsl."""
    found = []
    for diagram in group:
        times = []
        for _ in range(ROUNDS):
            start = process_time()
            picture = lay_out(diagram)
            times.append(1e3 * (process_time() - start))
        found.append((counts(drawing_of(picture)), median(times)))
    return found


def of_elk(group: Sequence[Diagram], handling: Handling, folder: Path) -> list[Measured]:
    """Measure the layouts of ELK: for each diagram the direction that fits a page better."""
    file = folder / "graphs.json"
    graphs = [elk_graph(each, handling, way) for each, way in product(group, DIRECTIONS)]
    file.write_text(json.dumps(graphs), encoding="utf-8")
    laid_out = json.loads(process(["node", str(peers.FOLDER / "elk.mjs"), str(file)]).output)
    found = []
    for at, diagram in enumerate(group):
        pair = laid_out[at * len(DIRECTIONS) : (at + 1) * len(DIRECTIONS)]
        choices = [(counts(drawing_of_elk(diagram, graph)), time) for graph, time in pair]
        found.append(min(choices, key=lambda each: fitted_size(each[0].width, each[0].height)))
    return found


def section(folder: Path) -> Section:
    """Lay out each group with each program."""
    programs: dict[str, Callable[[Sequence[Diagram]], list[Measured]]] = {"swarmdsl": ours}
    absent = []
    if peers.version("elkjs") is None:
        absent.append("ELK was not measured: elkjs is not installed")
    else:
        title = peers.title("ELK", "elkjs")
        programs[f"{title}, whole"] = lambda group: of_elk(group, "INCLUDE_CHILDREN", folder)
        programs[f"{title}, by level"] = lambda group: of_elk(group, "SEPARATE_CHILDREN", folder)
    found = Section(
        "Layout of state machines, with the same sizes of boxes and labels. A jog is a part of an "
        "edge below 14 pixels between two bends; *on rules* are edges that lie on a line in a box "
        "or continue it; *heads* are pairs of arrow heads that meet; the distance of a label is "
        "that from where its edge leaves the source, the mean over all. CPU time in milliseconds "
        "of one layout, in a process that has done some before. ELK does levels together, or by "
        "themselves with alternating directions; its better direction counts.",
        ["state machines", *_COLUMNS],
    )
    for name, group in models(folder):
        for program, lay in programs.items():
            found.rows.append([f"{name}, {program}", *_cells(lay(group))])
    found.notes += absent
    return found


def _cells(measured: Sequence[Measured]) -> Iterator[str]:
    """Yield sums over a group, and the size of one diagram, or the mean area of several."""
    every = [each for each, _ in measured]
    if len(every) == 1:
        yield f"{every[0].width} x {every[0].height}"
    else:
        area = sum(each.width * each.height for each in every) / len(every)
        yield f"{area / 1e3:.0f}k on average"
    for name in ("crossings", "bends", "jogs", "on_rules", "head_to_head"):
        yield str(sum(getattr(each, name) for each in every))
    labels = sum(each.labels for each in every)
    yield f"{sum(each.label_distance * each.labels for each in every) / max(labels, 1):.0f}"
    yield f"{sum(each.length for each in every):,}"
    yield f"{sum(time for _, time in measured):.0f}"
