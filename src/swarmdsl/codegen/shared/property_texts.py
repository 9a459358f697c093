"""Properties in the words of the model, and their facts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.ir import Count, Expression, Fact, Measure, Property
from swarmdsl.ir.sentences import Condition, Named, Part, facts_in, measure, sentence


def condition_text(condition: Expression) -> str:
    """Return what robots have, without its brackets: `box > 3`."""
    return expression(condition)


def sentence_text(property_: Property, named: Callable[[str], str] = str) -> str:
    """Return a property without its name: `each robot : in Work only after Start`.

    `named` prints the names of variables.
    """
    return parts_text(sentence(property_), named)


def measure_text(each: Measure, named: Callable[[str], str] = str) -> str:
    """Return a measure, with names of variables printed by `named`: `total(uav sends Found)`."""
    return parts_text(measure(each), named)


def parts_text(parts: Iterable[Part], named: Callable[[str], str] = str) -> str:
    """Return parts of a sentence as text."""
    return "".join(
        each
        if isinstance(each, str)
        else each.name
        if isinstance(each, Named)
        else expression(each.expression if isinstance(each, Condition) else each, named)
        for each in parts
    )


def facts_of(said: Property | Measure) -> Iterator[Fact | Count]:
    """Yield the facts in a property and in its scope, or in a measure."""
    if isinstance(said, Measure):
        yield from facts_in(said.claim)
        return
    scope = said.scope.claims if said.scope is not None else ()
    for claim in (*said.claims, *scope):
        yield from facts_in(claim)
