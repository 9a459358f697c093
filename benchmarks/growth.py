"""Measure how the work of each phase grows with the model, for each kind of model.

The exponent of a phase is 1 if four times the model takes four times as long, and 2 if it takes 16
times as long.
"""

from __future__ import annotations

import gc
import os
import resource
import sys
from collections.abc import Collection, Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from math import inf, isinf, log
from pathlib import Path
from signal import SIGXCPU
from time import process_time
from traceback import format_exc
from typing import NoReturn

from growth_models import FAMILIES, Family
from growth_phases import PHASES, Action, Model, NotApplicableError
from measure import FailedError, Section

LIMIT = 1.2
ROUNDS = 2
# Other work on the machine only adds to the time: a high exponent is measured again.
MORE_ROUNDS = 4
MOST_SECONDS = 100
# Less than this cannot be told from noise.
LEAST_SECONDS = 0.02
_NOT_APPLICABLE = 2


@dataclass(frozen=True)
class Sizes:
    """Numbers of a construct: the time for `fixed` of them is subtracted from the others."""

    small: int
    large: int
    fixed: int = 2


SIZES = Sizes(250, 1_000)
# Phases that are fast enough to be measured with larger models.
LARGE_SIZES = Sizes(500, 2_000)
FAST_PHASES = frozenset({"parse", "check", "format", "lower"})
# YASMIN lists each outcome of a parallel state for each region: the output is their product.
PRODUCTS = frozenset({("yasmin", "regions with events out")})


def section(folder: Path) -> Section:
    """Measure all phases with all families."""
    return described(exponents(folder, FAMILIES, sizes_of_phases()))


def sizes_of_phases() -> dict[str, Sizes]:
    """Return the sizes to measure each phase with."""
    return {name: LARGE_SIZES if name in FAST_PHASES else SIZES for name in PHASES}


def described(table: Mapping[str, Mapping[str, float | None]]) -> Section:
    """Describe exponents by family and phase."""
    found = Section(
        "Exponents of growth: 1.0 is linear, 2.0 quadratic. Each is that of the CPU time of a "
        f"phase alone, with {SIZES.small:,} and {SIZES.large:,} of a construct "
        f"({LARGE_SIZES.small:,} and {LARGE_SIZES.large:,} for {', '.join(sorted(FAST_PHASES))}), "
        f"without the time for {SIZES.fixed}; minima of {ROUNDS} or more rounds. A dot is less "
        f"than {LEAST_SECONDS * 1e3:.0f} ms. A dash is a phase that does not apply, or an output "
        "that is a product by its format: YASMIN lists each outcome of a parallel state for each "
        "region.",
        ["construct", *PHASES],
    )
    for family, row in table.items():
        found.rows.append([family, *(_cell(row[phase]) for phase in PHASES)])
    known = {
        f"{phase} of {family}": value
        for family, row in table.items()
        for phase, value in row.items()
        if value is not None
    }
    worst = max(known, key=lambda name: known[name])
    found.goal(f"the largest exponent, {worst}", known[worst], LIMIT, "{:.2f}")
    found.notes += [
        f"above {LIMIT}: {name}, {value:.2f}" for name, value in known.items() if value > LIMIT
    ]
    return found


def exponents(
    folder: Path, families: Mapping[str, Family], sizes: Mapping[str, Sizes]
) -> dict[str, dict[str, float | None]]:
    """Return the exponent of each phase in `sizes` for each family.

    It is None if the phase does not apply, and 0 if the work is too little to measure.
    """
    found = {}
    for number, (name, family) in enumerate(families.items()):
        models: dict[int, Model] = {}
        for count in {count for each in sizes.values() for count in vars(each).values()}:
            models[count] = Model(folder / f"{number}" / f"{count}", family(count))
        _warm_up(models[min(models)], sizes)
        found[name] = {
            phase: _exponent(phase, models, each) if (phase, name) not in PRODUCTS else None
            for phase, each in sizes.items()
        }
        row = ", ".join(f"{phase} {_cell(value)}" for phase, value in found[name].items())
        print(f"{name}: {row}", file=sys.stderr, flush=True)
    return found


def _warm_up(model: Model, phases: Collection[str]) -> None:
    """Import the modules of all phases, which happens once in a process."""
    with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        for phase in phases:
            try:
                PHASES[phase](model)()
            except NotApplicableError:
                continue
    gc.collect()
    gc.freeze()


def _exponent(phase: str, models: Mapping[int, Model], sizes: Sizes) -> float | None:
    try:
        actions = [PHASES[phase](models[count]) for count in vars(sizes).values()]
        best = [min(_seconds(each) for _ in range(ROUNDS)) for each in actions]
        for _ in range(MORE_ROUNDS):
            if _growth(best, sizes) <= LIMIT:
                break
            best = [min(known, _seconds(each)) for known, each in zip(best, actions, strict=True)]
    except NotApplicableError:
        return None
    return _growth(best, sizes)


def _growth(seconds: Sequence[float], sizes: Sizes) -> float:
    small, large, fixed = seconds
    if large - fixed < LEAST_SECONDS or isinf(large):
        return large if isinf(large) else 0
    return max(
        0,
        log((large - fixed) / max(small - fixed, LEAST_SECONDS / 10))
        / log(sizes.large / sizes.small),
    )


def _seconds(action: Action) -> float:
    """Return the CPU seconds of an action in a copy of this process.

    The copy leaves this process as it was, and has no more time than MOST_SECONDS.
    """
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        _run(action, writer)
    os.close(writer)
    with os.fdopen(reader, encoding="utf-8") as stream:
        output = stream.read()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status == -SIGXCPU:
        return inf
    if status == _NOT_APPLICABLE:
        raise NotApplicableError
    if status:
        raise FailedError(output)
    return float(output)


def _run(action: Action, writer: int) -> NoReturn:
    """Run an action, and end the process; the output is the seconds or a traceback."""
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1))
    status, output = 0, ""
    # As in the command line, which collects no garbage.
    gc.disable()
    try:
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            start = process_time()
            action()
            output = str(process_time() - start)
    except NotApplicableError:
        status = _NOT_APPLICABLE
    except BaseException:
        status, output = 1, format_exc()
    os.write(writer, output.encode())
    os._exit(status)


def _cell(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.2f}" if value else "·"
