"""Render the model: a file for each swarm, and for each property that Storm can decide."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, OutputFile, Templates
from swarmdsl.ir import System

from ..composed.options import Options
from ..composed.view import SwarmView
from ..composed.viewer import views
from .document import Document


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files."""
    made = []
    for view in views(system, options, "jani", report):
        document = Document(view)
        text = _templates().fill(
            "swarm.jani.j2",
            swarm=view,
            watch=view.watch,
            description=_description(view),
            constants=document.constants,
            variables=document.variables,
            automata=document.automata,
            violated=document.is_violated(),
        )
        made.append(OutputFile(f"{view.name}.jani", text, origin=view.origin))
    return made


def _description(view: SwarmView) -> str:
    lines = [f"{view.title} ({view.place})" if view.place else view.title]
    if view.watch is not None:
        lines.append(f"property {view.watch.name}: {view.watch.text}")
    return "\n".join((*lines, *view.conditions))


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates", json=_json)
