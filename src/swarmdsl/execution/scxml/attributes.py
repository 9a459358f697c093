"""Attributes and content of SCXML elements as functions; invalid ones are reported."""

from __future__ import annotations

import re
from collections.abc import Callable
from decimal import Decimal
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import Event, ExecutionError, Guard, InstanceLike
from swarmdsl.execution.engine.world import FAILURES
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.execution.scxml.ecmascript import Value, read
from swarmdsl.execution.scxml.grammar import Unreadable, inline_expression
from swarmdsl.execution.scxml.values import text, truth

_DELAY = re.compile(r"\s*\+?([0-9]+(?:\.[0-9]+)?|\.[0-9]+)(ms|s|m|min|h|d)\s*")
_UNITS = {"ms": 10**6, "s": 10**9, "m": 60 * 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
_UNITS["d"] = 24 * _UNITS["h"]

Data = Callable[[InstanceLike, Event], Any]


def delay_of(written: str) -> int | None:
    """Convert a CSS duration (`1.5s`, `200ms`) to nanoseconds; None if invalid."""
    found = _DELAY.fullmatch(written)
    return round(Decimal(found[1]) * _UNITS[found[2]]) if found is not None else None


class Attributes:
    """Compile attributes and content of the elements of a document."""

    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.report = report

    def guard(self, node: Node) -> Guard | None:
        """Return the condition of an element."""
        value = self.expression(node, "cond")
        if value is None:
            return None
        return lambda instance, event: truth(value(instance, event, {}))

    def expression(self, node: Node, attribute: str) -> Value | None:
        """Return the expression in an attribute; None if it is missing."""
        written = node.get(attribute)
        return self.read(written, node, attribute) if written is not None else None

    def read(self, written: str, node: Node, attribute: str, word: str = "") -> Value | None:
        """Return an expression at a word of an attribute; None if it is invalid."""
        try:
            return read(written)
        except Unreadable as error:
            self.invalid(node, attribute, error, word)
            return None

    def invalid(self, node: Node, attribute: str, error: Unreadable, word: str = "") -> None:
        """Report an invalid expression."""
        place = self.document.at(node, attribute, word)
        self.report.report("bad-expression", place, reason=str(error))

    def value(self, node: Node) -> Value:
        """Return the value of `expr`, or else of the content."""
        if node.get("expr") is not None:
            if node.text.strip():
                self.twice(node)
            return self.expression(node, "expr") or nothing
        if not node.text.strip():
            return nothing
        return self.read(inline_expression(node.text), node, "") or nothing

    def data(self, node: Node) -> Data | None:
        """Return event data from `<param>`s, `<content>` or a name list.

        If a param has no value, a `<send>` is not executed (6.2), but a `<donedata>` only omits
        that param (5.7).
        """
        fields: list[tuple[str, Value]] = []
        for name in (node.get("namelist") or "").split():
            fields.append((name, self.read(name, node, "namelist", name) or nothing))
        content = None
        for child in node.children:
            if child.name == "content":
                if content is not None:
                    self.twice(child)
                content = self.value(child)
                continue
            attribute = "location" if child.get("location") is not None else "expr"
            if child.get("location") is not None and child.get("expr") is not None:
                self.twice(child)
            found = self.expression(child, attribute)
            fields.append((child.get("name") or "", found or nothing))
        if content is not None:
            if fields:
                self.twice(node)
            value = content
            return lambda instance, event: value(instance, event, {})
        if not fields:
            return None
        if node.name == "donedata":
            return _with_value(fields)
        return lambda instance, event: {key: v(instance, event, {}) for key, v in fields}

    def delay(self, node: Node) -> Callable[[InstanceLike, Event], int] | None:
        """Return the delay of a `<send>` in nanoseconds; None without one."""
        written = node.get("delay")
        if written is not None:
            if node.get("delayexpr") is not None:
                self.twice(node)
            length = delay_of(written)
            if length is None:
                place = self.document.at(node, "delay")
                values = "a number followed by `s` or `ms`"
                self.report.report("bad-value", place, name="delay", values=values)
                return None
            return lambda instance, event: length
        value = self.expression(node, "delayexpr")
        if value is None:
            return None

        def computed(instance: InstanceLike, event: Event) -> int:
            found = value(instance, event, {})
            length = delay_of(text(found))
            if length is None:
                raise ExecutionError(f"`{text(found)}` is no delay")
            return length

        return computed

    def text(self, node: Node, attribute: str) -> Callable[[InstanceLike, Event], str]:
        """Return the string in an attribute, or in the one with the suffix `expr`."""
        written = node.get(attribute) or ""
        value = self.expression(node, f"{attribute}expr")
        if value is None:
            return lambda instance, event: written
        if written:
            self.twice(node)

        def computed(instance: InstanceLike, event: Event) -> str:
            found = value(instance, event, {})
            if found is None:
                raise ExecutionError(f"`{attribute}expr` has no value")
            return text(found)

        return computed

    def twice(self, node: Node) -> None:
        """Report an element with two values for the same thing, of which one would be lost."""
        fault = f"`<{node.name}>` gives the same thing twice"
        self.report.report("illegal-structure", self.document.at(node), fault=fault)


def _with_value(fields: list[tuple[str, Value]]) -> Data:
    """Return data of the fields that have a value; no data if none has (5.7)."""

    def data(instance: InstanceLike, event: Event) -> Any:
        found = {}
        for name, value in fields:
            try:
                found[name] = value(instance, event, {})
            except FAILURES as error:
                instance.fail(error)
        return found or None

    return data


def nothing(instance: InstanceLike, event: Event, names: object) -> None:
    """Value of a missing expression."""
