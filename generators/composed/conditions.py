"""Claims about numbers of robots in the syntax of a language."""

from __future__ import annotations

from swarmdsl.codegen import dataclass
from swarmdsl.execution.verify.composition import Combined, Reading

from .view import WatchView


@dataclass(frozen=True)
class Operators:
    """Operators of a language."""

    both: str
    either: str
    negated: str
    equal: str
    true: str


def claims(watch: WatchView | None, operators: Operators) -> list[tuple[str, str]]:
    """Return the claims of a watch, each with its condition on numbers of robots.

    `count_2` is the number for which term 2 holds; `my_count_2` is 1 if it holds for me.
    """
    read = watch.claims if watch is not None else ()
    return [(text, _condition(reading, operators)) for text, reading in read]


def _condition(reading: Reading, operators: Operators) -> str:
    if isinstance(reading, Combined):
        parts = [_condition(each, operators) for each in reading.parts]
        if reading.operator == "not":
            return f"{operators.negated}({parts[0]})"
        word = operators.both if reading.operator == "and" else operators.either
        return f"({f' {word} '.join(parts)})"
    name = f"count_{reading.term}"
    if reading.whose == "me":
        name = f"my_{name}"
    elif reading.whose == "others":
        name = f"{name} - my_{name}"
    if reading.least == reading.most:
        return f"({name} {operators.equal} {reading.least})"
    limits = [f"{name} >= {reading.least}"] if reading.least > 0 else []
    if reading.most is not None:
        limits.append(f"{name} <= {reading.most}")
    return f"({f' {operators.both} '.join(limits) or operators.true})"
