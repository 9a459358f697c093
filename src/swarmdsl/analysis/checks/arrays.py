"""Checks of effects that change arrays, and of the names of items in queries."""

from __future__ import annotations

import re

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.types import Typing, assignable, item_of
from swarmdsl.base.diagnostics.advice import Advice, edits, write
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.naming import fresh
from swarmdsl.syntax.ast import (
    Append,
    Clear,
    Expression,
    FieldUse,
    IndexUse,
    NameUse,
    Param,
    Query,
    Remove,
    StateMachine,
    Variable,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import Array


def check_array_effect(effect: Append | Remove | Clear, typing: Typing) -> None:
    """Check the target of an effect on an array, and the value that is appended."""
    target = effect.target.tree
    if target is None:
        return
    word = type(effect).__name__.lower()
    array = item_of(target) if isinstance(effect, Remove) else target
    if array is None and not isinstance(target, IndexUse):
        typing.report.report(
            "bad-operand",
            effect.span,
            operator=word,
            operands=f"`{effect.target.span.text}`",
            help=Advice(
                f"name an item of an array: `remove {effect.target.span.text}[0]`",
                "propose",
                f"remove {effect.target.span.text}[0]",
            ),
        )
        return
    if array is None or not assignable(array):
        is_item = isinstance(effect, Clear) and item_of(target) is not None
        help_ = write(f"remove {effect.target.span.text}") if is_item else None
        report_not_assignable(effect.target, typing, help_)
        return
    type_ = typing.infer(array)
    if isinstance(effect, Remove):
        typing.infer(target)
    if not isinstance(type_, Array):
        if type_ is not None and not isinstance(effect, Remove):
            typing.report.report(
                "bad-operand",
                effect.span,
                operator=word,
                operands=f"`{type_}`",
                help="it takes an array",
            )
    elif type_.size is not None and not type_.bounded:
        bounded = f"{type_.element}[<={type_.size}]"
        typing.report.report(
            "bad-operand",
            effect.span,
            operator=word,
            operands=f"`{type_}`",
            help=Advice(
                f"its length never changes; `{bounded}` has at most {type_.size} items",
                "bound",
                bounded,
                effect.target.span.text,
            ),
        )
    elif type_.size is None and isinstance(effect, Append):
        typing.report.report(
            "unbounded-array",
            effect.target.span,
            name=effect.target.span.text,
            help=Advice(
                f"give it a bound, such as `{type_.element}[<=16]`",
                "bound",
                f"{type_.element}[<=16]",
            ),
        )
    if isinstance(effect, Append):
        typing.expect(effect.value.tree, type_.element if isinstance(type_, Array) else None)


def report_not_assignable(target: Expression, typing: Typing, help_: str | None = None) -> None:
    """Report the target of a store that is not in a variable."""
    tree = target.tree
    while isinstance(tree, FieldUse):
        tree = tree.base
    if help_ is None and isinstance(tree, IndexUse) and item_of(tree) is not None:
        help_ = f"assign the whole item: `{tree.span.text} = ...`"
    help_ = help_ or "only variables (`var name : Type`) and their fields can be assigned to"
    typing.report.report("not-assignable", target.span, text=target.span.text, help=help_)


def check_element_names(machine: StateMachine, context: Context) -> None:
    """Report names of items that hide a variable, a param, or the name in an outer query."""
    known = {str(item.name): item for item in machine.items if isinstance(item, Variable | Param)}
    for query in nodes_of(machine, Query):
        name = query.element.name
        hidden = known.get(str(name))
        if hidden is not None:
            context.report.report(
                "hidden-value",
                name.span,
                name=name,
                hidden=f"{kind_name(hidden)} `{hidden.name}`",
                related=(Label(hidden.name.span, "declared here"),),
                help=_renamed(query, machine),
            )
        for part in (query.condition, query.key):
            for inner in walk(part) if part is not None else ():
                if isinstance(inner, Query) and inner.element.name == name:
                    context.report.report(
                        "hidden-value",
                        inner.element.name.span,
                        name=name,
                        hidden=f"the item `{name}`",
                        related=(Label(name.span, "declared here"),),
                        help=_renamed(inner, machine),
                    )


def _renamed(query: Query, machine: StateMachine) -> str:
    """Return the help for an item whose name something else has."""
    name = query.element.name
    new = fresh(str(name), re.findall(r"\w+", machine.span.text), gap="")
    uses = [
        each.span
        for each in walk(query)
        if isinstance(each, NameUse) and each.target is query.element
    ]
    changes = [(span, new) for span in (name.span, *uses)]
    return edits("give the item another name", f"Rename the item to `{new}`", *changes)
