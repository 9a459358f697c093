"""Executable content of SCXML as effects."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.execution.engine import Effect, Event, ExecutionError, Guard, InstanceLike
from swarmdsl.execution.scxml.attributes import Attributes
from swarmdsl.execution.scxml.document import Node
from swarmdsl.execution.scxml.ecmascript import location
from swarmdsl.execution.scxml.grammar import Unreadable
from swarmdsl.execution.scxml.script import script
from swarmdsl.execution.scxml.sending import FailedSend, send
from swarmdsl.execution.scxml.session import RaisedEvent, session_of
from swarmdsl.execution.scxml.values import text

_VARIABLE = re.compile(r"[A-Za-z$][A-Za-z0-9_$]*")
_RESERVED = {
    *("break", "case", "catch", "class", "const", "continue", "debugger", "default", "delete"),
    *("do", "else", "enum", "export", "extends", "false", "finally", "for", "function", "if"),
    *("import", "in", "instanceof", "new", "null", "return", "super", "switch", "this", "throw"),
    *("true", "try", "typeof", "var", "void", "while", "with"),
}
_MOST_TURNS = 100_000
"""Maximum number of turns of the loops in a block: lists could grow with every turn."""


class Content(Attributes):
    """Create effects from the elements of a document, and report invalid ones."""

    def block(self, node: Node) -> Effect | None:
        """Return an effect that executes child elements in order, until one fails."""
        if not node.children:
            return None
        effect = _all_of([self._effect(child) for child in node.children])
        inside = {each.name for each in node.walk()}
        if effect is not None and "foreach" in inside:
            effect = _with_turns(effect)
        return _until_failure(effect) if effect is not None and "send" in inside else effect

    def _effect(self, node: Node) -> Effect | None:
        match node.name:
            case "raise":
                event = RaisedEvent(node.get("event") or "", None, "internal")
                return lambda instance, _: instance.raise_event(event)
            case "assign":
                return self._assign(node)
            case "if":
                return self._if(node)
            case "foreach":
                return self._foreach(node)
            case "log":
                return self._log(node)
            case "script":
                return self.script(node)
            case "send":
                return send(node, self)
            case "cancel":
                return self._cancel(node)
        return None

    def script(self, node: Node) -> Effect | None:
        """Return the effect of a `<script>`; None if it is not supported."""
        try:
            return script(node.text)
        except Unreadable as error:
            reason = f"only assignments are run; {error}"
            self.report.report(
                "not-understood", self.document.at(node), name="script", reason=reason
            )
            return None

    def _assign(self, node: Node) -> Effect | None:
        value = self.value(node)
        try:
            store = location(node.get("location") or "")
        except Unreadable as error:
            self.invalid(node, "location", error)
            return None
        return lambda instance, event: store(instance, event, value(instance, event, {}))

    def _if(self, node: Node) -> Effect:
        branches: list[tuple[Guard | None, list[Effect | None]]] = [(self.guard(node), [])]
        last = False
        for child in node.children:
            if child.name not in ("elseif", "else"):
                branches[-1][1].append(self._effect(child))
                continue
            if last:
                fault = f"`<{child.name}>` must not come after `<else>`"
                self.report.report("illegal-structure", self.document.at(child), fault=fault)
            last = child.name == "else"
            branches.append((self.guard(child), []))
        made = [(guard, _all_of(effects)) for guard, effects in branches]

        def choose(instance: InstanceLike, event: Event) -> None:
            for guard, effect in made:
                if guard is None or instance.holds(guard, event):
                    if effect is not None:
                        effect(instance, event)
                    return

        return choose

    def _foreach(self, node: Node) -> Effect | None:
        array = self.expression(node, "array")
        if array is None:
            return None
        names = (node.get("item") or "", node.get("index"))
        wrong = next((each for each in names if each is not None and not _is_variable(each)), None)
        turn = _all_of([self._effect(child) for child in node.children])

        def loop(instance: InstanceLike, event: Event) -> None:
            if wrong is not None:
                raise ExecutionError(f"`{wrong}` is not the name of a variable")
            values = array(instance, event, {})
            if not isinstance(values, list):
                raise ExecutionError(f"`{text(values)}` is not a list")
            session = session_of(instance)
            item, index = names
            # The list may change in a turn, but not what the loop goes through (4.6).
            for number, value in enumerate(tuple(values)):
                session.turns -= 1
                if session.turns < 0:
                    raise ExecutionError(f"the loops take more than {_MOST_TURNS:,} turns")
                session[item] = value
                if index is not None:
                    session[index] = number
                if turn is not None:
                    turn(instance, event)

        return loop

    def _cancel(self, node: Node) -> Effect:
        sendid = self.text(node, "sendid")

        def cancel(instance: InstanceLike, event: Event) -> None:
            # Events without an id have the empty one.
            if given := sendid(instance, event):
                instance.cancel(given)

        return cancel

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


def _is_variable(name: str) -> bool:
    return _VARIABLE.fullmatch(name) is not None and name not in _RESERVED


def _with_turns(effect: Effect) -> Effect:
    """Return a block that limits the turns of its loops."""

    def limited(instance: InstanceLike, event: Event) -> None:
        session_of(instance).turns = _MOST_TURNS
        effect(instance, event)

    return limited


def _until_failure(effect: Effect) -> Effect:
    """Return a block that ends when a `<send>` has failed."""

    def guarded(instance: InstanceLike, event: Event) -> None:
        try:
            effect(instance, event)
        except FailedSend:
            return

    return guarded


def _all_of(effects: Iterable[Effect | None]) -> Effect | None:
    made = [effect for effect in effects if effect is not None]
    if len(made) < 2:
        return made[0] if made else None

    def all_of_them(instance: InstanceLike, event: Event) -> None:
        for each in made:
            each(instance, event)

    return all_of_them
