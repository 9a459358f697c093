"""Representatives of data that come from outside: messages, and results of functions.

A number that is only compared with constants has one representative for each outcome of all
comparisons.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from copy import deepcopy
from itertools import count, pairwise, product
from math import inf, nextafter
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import ExecutionError, bounded
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.syntax.types import FLOATS, INTEGERS

Path = tuple[str, ...]
Cut = tuple[str, Any]
"""Comparison with a constant: operator and value."""

_MOST = 64
"""Maximum number of representatives of one message or result."""
_OTHER = "another"
"""Text that stands for all that a model does not compare with."""


@dataclass(frozen=True)
class Part:
    """Part of a message that decides on anything, with what it is compared with.

    `exact` is an expression for which its very value counts, None if only comparisons do.
    """

    path: Path
    type: ir.Type | None
    default: Any
    cuts: frozenset[Cut]
    exact: ir.Expression | None


@dataclass(frozen=True)
class Values:
    """Representatives of a message or result, with doubts, and conditions in words."""

    values: tuple[dict[str, Any], ...]
    doubts: tuple[Doubt, ...]
    conditions: tuple[str, ...]


def combinations(name: str, parts: Iterable[Part], blank: Callable[[], dict[str, Any]]) -> Values:
    """Combine the representatives of the parts of a message; all else is as in `blank`."""
    doubts: list[Doubt] = []
    conditions: list[str] = []
    axes: list[tuple[Path, list[Any]]] = []
    for part in parts:
        values, is_complete = _values(part)
        shown = ".".join((name, *part.path))
        if not is_complete:
            place = getattr(part.exact, "origin", None)
            way = "compare it with constants only, or name its values in a `--scenario`"
            doubts.append(
                Doubt(f"only some values of `{shown}` were tried: {way}", place, more=True)
            )
        elif any(each is not True for _, each in part.cuts):
            conditions.append(f"`{shown}` {_regions(part.cuts)}")
        if part.path:
            axes.append((part.path, values))
    made: list[dict[str, Any]] = []
    for choice in product(*(values for _, values in axes)):
        if len(made) == _MOST:
            way = "compare fewer of its fields with fewer constants"
            doubts.append(Doubt(f"only {_MOST} values of `{name}` were tried: {way}", more=True))
            break
        message = blank()
        for (path, _), value in zip(axes, choice, strict=True):
            _put(message, path, value)
        made.append(message)
    return Values(tuple(made), tuple(doubts), tuple(conditions))


def is_covered(part: Part) -> bool:
    """Return True if there are representatives for all values of a part."""
    return _values(part)[1]


def _values(part: Part) -> tuple[list[Any], bool]:
    """Return representatives of a value, and True if they stand for all values."""
    cuts = part.cuts
    match part.type:
        case ir.Primitive(name="bool"):
            return [False, True], True
        case ir.Primitive(name="string" | "wstring"):
            texts = sorted({c for _, c in cuts if isinstance(c, str)} - {""})
            ordered = any(symbol not in ("==", "!=") for symbol, _ in cuts)
            other = next(t for n in count() if (t := f"{_OTHER}{n or ''}") not in texts)
            return ["", *texts, other], part.exact is None and not ordered
        case ir.Primitive(name=name) if name in (*FLOATS, *INTEGERS, "duration"):
            return _numbers(cuts, name), part.exact is None
    return [part.default], False


def _numbers(cuts: Iterable[Cut], type_: str) -> list[Any]:
    """Return one number for each outcome of all comparisons; zero for its own."""
    compared = sorted(cuts, key=repr)
    constants = sorted({each for _, each in compared if isinstance(each, (int, float))})
    candidates: list[Any] = [0]
    if type_ not in FLOATS:
        near = (int(c) + step for c in constants for step in (-1, 0, 1))
        candidates += [n for n in near if type_ not in INTEGERS or _fits(n, type_)]
    elif constants:
        least, most = float(constants[0]), float(constants[-1])
        candidates += constants
        candidates += [a / 2 + b / 2 for a, b in pairwise(constants)]
        # One more is the same number where numbers are large.
        candidates += [least - 1, most + 1, nextafter(least, -inf), nextafter(most, inf)]
    found: dict[tuple[bool, ...], Any] = {}
    for number in candidates:
        found.setdefault(tuple(bool(OPERATIONS[s](number, c)) for s, c in compared), number)
    return list(found.values())


def _fits(number: int, type_: str) -> bool:
    try:
        bounded(number, type_)
    except ExecutionError:
        return False
    return True


def _regions(cuts: Iterable[Cut]) -> str:
    """Describe comparisons: `>= 0.4`."""
    return ", ".join(f"{s} {c!r}" for s, c in sorted(cuts, key=repr))


def _put(message: Any, path: Path, value: Any) -> None:
    for name in path[:-1]:
        message = message.setdefault(name, {})
    message[path[-1]] = deepcopy(value)
