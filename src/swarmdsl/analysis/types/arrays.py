"""Types of items, queries and new messages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.report_unresolved import report_missing
from swarmdsl.analysis.types.built_ins import BUILT_INS
from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.analysis.types.fitting import is_number
from swarmdsl.analysis.types.unit_rules import of_field
from swarmdsl.base.diagnostics.advice import Advice, edits
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    Call,
    Construction,
    EnumType,
    ExpressionTree,
    Field,
    FieldUse,
    IndexUse,
    NameUse,
    Parameter,
    Query,
    Word,
    walk,
)
from swarmdsl.syntax.types import BOOL, DURATION, INT, Array, Named, Primitive, Type

COUNT = Primitive("uint32")
"""Type of the number of an item, counted from 0."""


@dataclass(frozen=True)
class QueryKind:
    """Query of an array; `takes_key` if `by` may follow, `result` None for the item that it finds.

    A query without a key needs a condition.
    """

    result: Type | None
    doc: str
    takes_key: bool = False

    def signature(self, name: str) -> str:
        """Return the form, as the reference shows it."""
        if self.takes_key:
            return f"{name}(item in array where condition by value)"
        return f"{name}(item in array where condition) : {self.result}"


QUERIES: Mapping[str, QueryKind] = {
    "count": QueryKind(INT, "The number of items for which a condition holds."),
    "any": QueryKind(BOOL, "True if a condition holds for an item."),
    "all": QueryKind(BOOL, "True if a condition holds for all items."),
    "min": QueryKind(None, "The first item with the least value.", takes_key=True),
    "max": QueryKind(None, "The first item with the greatest value.", takes_key=True),
}


class Inference(Protocol):
    """Typing of expressions, as far as it is needed here."""

    @property
    def interfaces(self) -> Interfaces: ...  # noqa: D102

    @property
    def report(self) -> Diagnostics: ...  # noqa: D102

    @property
    def folding(self) -> Folding: ...  # noqa: D102

    def infer(self, tree: ExpressionTree) -> Type | None: ...  # noqa: D102

    def quietly(self, tree: ExpressionTree) -> Type | None: ...  # noqa: D102

    def expect(  # noqa: D102
        self, tree: ExpressionTree | None, expected: Type | None
    ) -> bool: ...

    def field_of(self, owner: Named, name: Word) -> Field | Parameter | None: ...  # noqa: D102


def type_of_item(use: IndexUse, typing: Inference) -> Type | None:
    """Return the type of an item of an array; report a wrong array or index."""
    array = typing.infer(use.base)
    if not typing.expect(use.index, COUNT):
        return array.element if isinstance(array, Array) else None
    if not isinstance(array, Array):
        if array is not None:
            typing.report.report(
                "bad-operand",
                use.span,
                operator="[]",
                operands=f"`{array}`",
                help="only arrays have items; write a space before the `[` of a guard",
            )
        return None
    number = typing.folding.value(use.index)
    if array.size is not None and isinstance(number, int) and number >= array.size:
        typing.report.report(
            "no-such-item",
            use.index.span,
            array=use.base.span.text,
            number=number,
            help=Advice(
                f"items are counted from 0: the last one is `[{array.size - 1}]`",
                "propose",
                f"{array.size - 1}",
            ),
        )
    return array.element


def type_of_query(query: Query, typing: Inference) -> Type | None:
    """Return the type of the result of a query; report what is wrong with it."""
    array = typing.infer(query.element.array)
    word = str(query.function)
    kind = QUERIES.get(word)
    if kind is None:
        help_ = "the queries are " + listed(list(QUERIES), "and")
        report_missing(
            "query", word, query.function.span, QUERIES, typing.report, hint=lambda: help_
        )
        return None
    if array is not None and not isinstance(array, Array):
        _report(query, f"`{array}`", "it queries the items of an array", typing)
        return kind.result
    typing.expect(query.condition, BOOL)
    key = typing.infer(query.key) if query.key is not None else None
    element = array.element if isinstance(array, Array) else None
    name = query.element.name
    if not kind.takes_key:
        if query.key is not None:
            _report(query, "`by`", _without_key(query), typing)
        elif query.condition is None:
            help_ = Advice(
                f"write `{word}({name} in {query.element.array.span.text} where ...)`",
                "add condition",
            )
            _report(query, "items without a condition", help_, typing)
        return kind.result
    compared = key if query.key is not None else element
    if compared is not None and not (is_number(compared) or compared == DURATION):
        help_ = f"compare numbers or durations: `by {name}...`"
        _report(query, f"`{compared}`", help_, typing)
    return element


def is_unnamed_query(call: Call, typing: Inference) -> bool:
    """Return True for a query of an array that does not name its items."""
    if call.function not in QUERIES or len(call.arguments) > 1:
        return False
    return call.function not in BUILT_INS or _array_in(call, typing) is not None


def type_of_unnamed_query(call: Call, typing: Inference) -> Type | None:
    """Report a query that does not name the items; return the type of its result."""
    from swarmdsl.analysis.types.hints import query_hint

    array = _array_in(call, typing)
    said = call.arguments[0].span.text if call.arguments else ""
    typing.report.report(
        "bad-operand",
        call.span,
        operator=call.function,
        operands=f"`{said}`" if said else "nothing",
        help=query_hint(str(call.function), said, array.span.text if array is not None else None),
    )
    return QUERIES[str(call.function)].result


def _array_in(call: Call, typing: Inference) -> NameUse | FieldUse | None:
    """Return the first name of an array in the arguments of a function."""
    paths = (use for argument in call.arguments for use in walk(argument))
    uses = (use for use in paths if isinstance(use, (NameUse, FieldUse)))
    return next((use for use in uses if isinstance(typing.quietly(use), Array)), None)


def type_of_construction(made: Construction, typing: Inference) -> Type | None:
    """Return the type of a new message; report what is wrong with its fields."""
    type_ = made.type.type
    known = typing.interfaces.get(type_) if isinstance(type_, Named) else None
    if type_ is not None and (not isinstance(type_, Named) or isinstance(known, EnumType)):
        typing.report.report(
            "interface-kind",
            made.type.span,
            name=made.type.name,
            actual="an enum" if isinstance(known, EnumType) else f"the type `{type_}`",
            expected="a message",
        )
        type_ = None
    first: dict[str, Word] = {}
    for given in made.values:
        earlier = first.setdefault(str(given.name), given.name)
        if earlier is not given.name:
            typing.report.report(
                "repeated-item",
                given.name.span,
                item=f"field `{given.name}`",
                related=(Label(earlier.span, "first given here"),),
            )
        field = typing.field_of(type_, given.name) if isinstance(type_, Named) else None
        typing.expect(given.value, of_field(field.type.type) if field is not None else None)
    return type_


def _report(query: Query, operands: str, help_: str, typing: Inference) -> None:
    typing.report.report(
        "bad-operand", query.span, operator=query.function, operands=operands, help=help_
    )


def _without_key(query: Query) -> str:
    """Return the help for `by` where nothing is compared."""
    last = query.condition or query.element.array
    assert query.key is not None  # it is reported
    place = last.span._replace(start=last.span.end, end=query.key.span.end)
    return edits(
        "only `min` and `max` compare items", f"Remove `{place.text.strip()}`", (place, "")
    )
