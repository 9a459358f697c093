"""Executable content of SCXML as effects, and the data of events."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from decimal import Decimal
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import Effect, Event, ExecutionError, Guard, InstanceLike
from swarmdsl.execution.engine.world import FAILURES
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.execution.scxml.ecmascript import Unreadable, Value, location, read
from swarmdsl.execution.scxml.values import text, truth

_DELAY = re.compile(r"\s*\+?([0-9]+(?:\.[0-9]+)?|\.[0-9]+)(ms|s|m|min|h|d)\s*")
_UNITS = {"ms": 10**6, "s": 10**9, "m": 60 * 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
_UNITS["d"] = 24 * _UNITS["h"]
# Targets and types of <send> that mean the machine itself.
_HERE = ("", "#_scxml", "http://www.w3.org/TR/scxml/#SCXMLEventProcessor", "scxml")

Data = Callable[[InstanceLike, Event], Any]


def delay_of(written: str) -> int | None:
    """Convert a CSS duration (`1.5s`, `200ms`) to nanoseconds; None if invalid."""
    found = _DELAY.fullmatch(written)
    return round(Decimal(found[1]) * _UNITS[found[2]]) if found is not None else None


class Content:
    """Create effects from the elements of a document, and report invalid ones."""

    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.report = report

    def block(self, node: Node) -> Effect | None:
        """Return an effect that executes child elements in order, until one fails."""
        if not node.children:
            return None
        return _all_of([self._effect(child) for child in node.children])

    def guard(self, node: Node) -> Guard | None:
        """Return the condition of an element."""
        value = self.expression(node, "cond")
        if value is None:
            return None
        return lambda instance, event: truth(value(instance, event, {}))

    def expression(self, node: Node, attribute: str) -> Value | None:
        """Return the expression in an attribute; None if it is missing."""
        written = node.get(attribute)
        if written is None:
            return None
        try:
            return read(written)
        except Unreadable as error:
            self.report.report(
                "bad-expression", self.document.at(node, attribute), reason=str(error)
            )
            return None

    def data(self, node: Node) -> Data | None:
        """Return event data from `<param>`s, `<content>` or a name list.

        If a param has no value, a `<send>` is not executed (6.2), but a `<donedata>` only omits
        that param (5.7).
        """
        fields: list[tuple[str, Value]] = []
        for name in (node.get("namelist") or "").split():
            fields.append((name, self._read(name, node, "namelist")))
        for child in node.children:
            if child.name == "content":
                value = self.value(child)
                return lambda instance, event: value(instance, event, {})
            attribute = "location" if child.get("location") is not None else "expr"
            found = self.expression(child, attribute)
            fields.append((child.get("name") or "", found or nothing))
        if not fields:
            return None
        if node.name == "donedata":
            return _with_value(fields)
        return lambda instance, event: {key: v(instance, event, {}) for key, v in fields}

    def value(self, node: Node) -> Value:
        """Return the value of `expr`, or else of the content: an expression or a string."""
        if node.get("expr") is not None:
            return self.expression(node, "expr") or nothing
        written = node.text.strip()
        if not written:
            return nothing
        try:
            return read(written)
        except Unreadable:
            return lambda instance, event, names: " ".join(written.split())

    def _read(self, written: str, node: Node, attribute: str) -> Value:
        try:
            return read(written)
        except Unreadable as error:
            place = self.document.at(node, attribute, written)
            self.report.report("bad-expression", place, reason=str(error))
            return nothing

    def _effect(self, node: Node) -> Effect | None:
        match node.name:
            case "raise":
                event = Event(node.get("event") or "")
                return lambda instance, _: instance.raise_event(event)
            case "assign":
                return self._assign(node)
            case "if":
                return self._if(node)
            case "log":
                return self._log(node)
            case "send":
                return self._send(node)
            case "cancel":
                sendid = self._text(node, "sendid")
                return lambda instance, event: instance.cancel(sendid(instance, event))
        return None

    def _assign(self, node: Node) -> Effect | None:
        value = self.value(node)
        try:
            store = location(node.get("location") or "")
        except Unreadable as error:
            place = self.document.at(node, "location")
            self.report.report("bad-expression", place, reason=str(error))
            return None
        return lambda instance, event: store(instance, event, value(instance, event, {}))

    def _if(self, node: Node) -> Effect:
        branches: list[tuple[Guard | None, list[Effect | None]]] = [(self.guard(node), [])]
        for child in node.children:
            if child.name == "elseif":
                branches.append((self.guard(child), []))
            elif child.name == "else":
                branches.append((None, []))
            else:
                branches[-1][1].append(self._effect(child))
        made = [(guard, _all_of(effects)) for guard, effects in branches]

        def choose(instance: InstanceLike, event: Event) -> None:
            for guard, effect in made:
                if guard is None or instance.holds(guard, event):
                    if effect is not None:
                        effect(instance, event)
                    return

        return choose

    def _log(self, node: Node) -> Effect:
        label = node.get("label")
        value = self.expression(node, "expr")

        def log(instance: InstanceLike, event: Event) -> None:
            words = [label] if label is not None else []
            if value is not None:
                words.append(text(value(instance, event, {})))
            if instance.observer is not None:
                instance.observer.logged(instance, ": ".join(words))

        return log

    def _send(self, node: Node) -> Effect:
        name = self._text(node, "event")
        target = self._text(node, "target")
        kind = self._text(node, "type")
        sendid = self._text(node, "id")
        data = self.data(node)
        delay = self._delay(node)

        def send(instance: InstanceLike, event: Event) -> None:
            named = name(instance, event)
            if not named:
                raise ExecutionError("an event without a name cannot be sent")
            sent = Event(named, data(instance, event) if data is not None else None)
            length = delay(instance, event) if delay is not None else 0
            place = target(instance, event)
            if place in _HERE and kind(instance, event) in _HERE:
                instance.send_after(sent, length, sendid(instance, event))
            elif length > 0:
                raise ExecutionError(f"`{sent.name}` has a target of its own: it cannot be delayed")
            elif place == "#_internal":
                instance.raise_event(sent)
            else:
                instance.emit(sent)

        return send

    def _delay(self, node: Node) -> Callable[[InstanceLike, Event], int] | None:
        written = node.get("delay")
        if written is not None:
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

    def _text(self, node: Node, attribute: str) -> Callable[[InstanceLike, Event], str]:
        """Return the string in an attribute, or in the one with the suffix `expr`."""
        written = node.get(attribute) or ""
        value = self.expression(node, f"{attribute}expr")
        if value is None:
            return lambda instance, event: written
        return lambda instance, event: text(value(instance, event, {}))


def _with_value(fields: list[tuple[str, Value]]) -> Data:
    """Return data of the fields that have a value."""

    def data(instance: InstanceLike, event: Event) -> Any:
        found = {}
        for name, value in fields:
            try:
                found[name] = value(instance, event, {})
            except FAILURES as error:
                instance.fail(error)
        return found

    return data


def nothing(instance: InstanceLike, event: Event, names: object) -> None:
    """Value of a missing expression."""


def _all_of(effects: Iterable[Effect | None]) -> Effect | None:
    made = [effect for effect in effects if effect is not None]
    if len(made) < 2:
        return made[0] if made else None

    def all_of_them(instance: InstanceLike, event: Event) -> None:
        for each in made:
            each(instance, event)

    return all_of_them
