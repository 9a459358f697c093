"""Python source of the tables of a monitor: properties and measures as plain data."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.python import Call, Source, comments, layout, source_place
from swarmdsl.codegen.shared import constant, measure_text, sentence_text
from swarmdsl.ir import (
    DURATION,
    Claim,
    Count,
    Fact,
    FitnessInput,
    Junction,
    Measure,
    Property,
    Robots,
    bound_of_any,
)

from .imports import WIDTH, Imports
from .told_conditions import told_text

STEP = "    "
"""Indent of an item of a table."""
_SECOND = 1_000_000_000


@dataclass(frozen=True)
class Entry:
    """Item of a table, and the comments above it."""

    comments: tuple[str, ...]
    text: str


class MonitorSource:
    """Writes properties as plain data, and imports its classes."""

    def __init__(self, imports: Imports, named: Callable[[str], str]) -> None:
        self._imports = imports
        self._named = named

    def entry(self, property_: Property) -> Entry:
        """Return the entry of a property, which says where it is in the model."""
        text = sentence_text(property_, self._named)
        where = f" ({source_place(property_.origin)})" if property_.origin is not None else ""
        scope = property_.scope
        keywords: list[tuple[str, object]] = []
        if scope is not None:
            keywords.append(("scope", tuple(map(self._claim, scope.claims))))
        if property_.each is not None:
            keywords.append(("each", property_.each))
        if property_.chance is not None:
            keywords.append(("chance", property_.chance.probability))
        keywords.append(("origin", f"{text}{where}"))
        claims = tuple(map(self._claim, property_.claims))
        call = self._call("Property", (property_.name, self._sentence(property_), claims), keywords)
        said = comments(property_.origin, property_.doc)
        return Entry(said, layout(call, 1, STEP, ",", WIDTH))

    def measure_entry(self, input_: FitnessInput) -> Entry:
        """Return the entry of a measure, which says where it is in the model."""
        assert input_.measure is not None
        keywords: list[tuple[str, object]] = []
        if (bound := bound_of_any(input_.type)) is not None:
            keywords.append(("bound", bound))
        if input_.type == DURATION:
            keywords.append(("unit", "s"))
        text = input_text(input_, self._named)
        where = f" ({source_place(input_.origin)})" if input_.origin is not None else ""
        measured = self._measure(input_.name, input_.measure)
        class_ = self._imports.own("swarm_measures", "Input")
        call = Call(class_, (measured, f"{text}{where}"), tuple(keywords))
        said = comments(input_.origin, input_.doc)
        return Entry(said, layout(call, 1, STEP, ",", WIDTH))

    def _measure(self, name: str, each: Measure) -> Call:
        claim = self._claim(each.claim)
        if each.counted_role is not None:
            assert isinstance(each.claim, Fact)
            claim = self._fact(each.claim, self._call("Robots", (each.counted_role, "every")))
        keywords: list[tuple[str, object]] = []
        for key, value in (("over", each.over), ("aggregate", each.aggregate), ("each", each.each)):
            if value is not None:
                keywords.append((key, value))
        return self._call("Measure", (name, each.kind, claim), keywords)

    def _sentence(self, property_: Property) -> Call:
        keywords: list[tuple[str, object]] = []
        if property_.scope is not None:
            keywords.append(("scope", property_.scope.kind))
        if property_.within is not None:
            seconds = constant(property_.within, {})
            assert isinstance(seconds, (int, float))
            keywords.append(("within", Source(f"{round(seconds * _SECOND):_}")))
        if property_.times is not None:
            keywords.append(("times", property_.times))
        return self._call("Sentence", (property_.kind,), keywords)

    def _claim(self, claim: Claim) -> Call:
        if isinstance(claim, Junction):
            inner = tuple(map(self._claim, claim.claims))
            return self._call("Junction", (claim.operator, inner))
        if isinstance(claim, Count):
            numbers = (claim.role, claim.state, claim.comparison, claim.number)
            return self._call("Count", numbers)
        return self._fact(claim, self._robots(claim.robots) if claim.robots is not None else None)

    def _fact(self, fact: Fact, robots: Call | None) -> Call:
        keywords: list[tuple[str, object]] = []
        if robots is not None:
            keywords.append(("robots", robots))
        if fact.guard is not None:
            keywords.append(("condition", told_text(fact)))
        if fact.outcome:
            keywords.append(("outcome", fact.outcome))
        name = (fact.name,) if fact.name else ()
        return self._call("Fact", (fact.act, *name), keywords)

    def _robots(self, robots: Robots) -> Call:
        keywords: list[tuple[str, object]] = []
        if robots.number is not None:
            keywords.append(("least", robots.number.lower))
            if robots.number.upper is not None:
                keywords.append(("most", robots.number.upper))
        if robots.index:
            keywords.append(("number", robots.index))
        if robots.other:
            keywords.append(("other", True))
        return self._call("Robots", (robots.role, robots.quantifier), keywords)

    def _call(
        self,
        name: str,
        arguments: tuple[object, ...],
        keywords: Iterable[tuple[str, object]] = (),
    ) -> Call:
        return Call(self._imports.own("property_monitors", name), arguments, tuple(keywords))


def input_text(input_: FitnessInput, named: Callable[[str], str]) -> str:
    """Return the text of the measure of an input."""
    assert input_.measure is not None
    return measure_text(input_.measure, named)
