"""Target `fitness`: Python scripts that compute a fitness from a run's rosbag.

The simulation managers of CPSwarm call it with the bag and limits of the run, and read
`fitness=<number>` from its output. It also takes what the monitor of a swarm on ROS 2 tells.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.codegen.api import Generator, NoOptions, OutputFile
from swarmdsl.codegen.shared.constants import constant, params_by_name
from swarmdsl.codegen.templates import Templates
from swarmdsl.ir import (
    Array,
    Fitness,
    FitnessInput,
    Primitive,
    System,
    VariableRef,
    subexpressions,
)
from swarmdsl.ir.expression_printer import (
    PYTHON_DIVISION,
    PYTHON_FUNCTIONS,
    Dialect,
    envelope_name,
    python_literal,
    translate,
)

_DIALECT = Dialect(
    literal=python_literal,
    variable="values[{!r}]".format,
    param="values[{!r}]".format,
    event="",
    envelope=envelope_name,  # a run has no event
    identity=str,  # a run has no robot of its own
    operators={},
    functions=PYTHON_FUNCTIONS,
    division=PYTHON_DIVISION,
)
_TIMES = ("time", "duration")


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a script for each fitness."""
    for fitness in system.fitness:
        if _can_be_computed(fitness, report):
            # The managers require this name; a shared folder could hide a module of Python.
            path = f"{snake_case(fitness.name)}/fitness.py"
            yield OutputFile(path, _script(fitness), executable=True, origin=fitness.origin)


def _can_be_computed(fitness: Fitness, report: Diagnostics) -> bool:
    """Return True if all values are known; report the others."""
    known = params_by_name(fitness.params)
    unknown = [
        param
        for param in fitness.params
        if param.default is None or constant(param.default, known) is None
    ]
    structured = [each for each in fitness.inputs if not _is_plain(each)]
    for param in unknown:
        what = f"param `{param.name}`, which has no value"
        hint = "give it a value: the script is not written otherwise"
        report.report("no-place", param.origin, target="fitness", what=what, help=hint)
    for each in structured:
        what = f"input `{each.name}` of type `{each.type}`"
        note = "a script reads a number, a string, a time or an array of numbers"
        hint = "measure fields of it: the script is not written otherwise"
        report.report(
            "no-place", each.origin, target="fitness", what=what, notes=(note,), help=hint
        )
    return not unknown and not structured


def _is_plain(each: FitnessInput) -> bool:
    """Return True for messages of std_msgs with such `data`."""
    match each.type:
        case Primitive():
            return True
        case Array(element=Primitive(name=name)):
            return name not in ("string", "wstring", *_TIMES)
    return False


def _script(fitness: Fitness) -> str:
    known = params_by_name(fitness.params)
    value = translate(fitness.value, _DIALECT)
    small = fitness.goal == "minimize"
    parts = subexpressions(fitness.value)
    used = {part.name for part in parts if isinstance(part, VariableRef)}
    return Templates(Path(__file__).parent).fill(
        "fitness.py.j2",
        name=fitness.name,
        comment=fitness.doc.splitlines(),
        sense=": what is to be small has its sign changed" if small else "",
        inputs={
            each.name: isinstance(each.type, Primitive) and each.type.name in _TIMES
            for each in fitness.inputs
        },
        measures=[each.name for each in fitness.inputs if each.measure is not None],
        used=[each.name for each in fitness.inputs if each.name in used],
        params={
            param.name: constant(param.default, known)
            for param in fitness.params
            if param.default is not None
        },
        value=f"-({value})" if small else value,
    )


generator = Generator(
    target="fitness",
    summary="each fitness as a Python script that computes it from the rosbag of a run",
    emit=emit,
)
