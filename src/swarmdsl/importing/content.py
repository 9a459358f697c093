"""Convert executable content of SCXML to effects."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import reduce

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange.scxml.portable import SEND_TYPE
from swarmdsl.execution.scxml.document import SCXML, Document, Node
from swarmdsl.execution.scxml.session import PROCESSOR
from swarmdsl.importing.data import MachineData, written_value
from swarmdsl.importing.delays import read_delay
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsupportedError, path
from swarmdsl.importing.names import is_plain
from swarmdsl.ir import (
    Address,
    Assignment,
    Binary,
    Cancel,
    Effect,
    Event,
    Expression,
    Literal,
    Send,
    Type,
    Unary,
)
from swarmdsl.ir.expressions import reads
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, INT, STRING

_UNSUPPORTED = {
    "log": "a model has no logging",
    "script": "a model has no scripts",
    "foreach": "a model has no loops",
    "if": "only transitions have conditions in a model",
}
_SENT = {"event", "id", "type", "target"}
_DELAY = {"delay", "delayexpr"}
# Id of a delayed send in the portable profile.
_SENDID = re.compile(r"send\.(.+)\.[0-9]+")
# Other strings are ids: a role has no keyword as its name, and no robot a longer number.
_ROBOT = re.compile(r"([A-Za-z_]\w*)(?:\[([0-9]{1,9})\])?", re.ASCII)
# Types and targets of a <send> to the machine itself (SCXML 6.2.4, C.1).
_OWN_TYPES = ("", "scxml", PROCESSOR)
_OWN_TARGETS = ("", "#_internal")
_MAX_PATHS = 16


class ExecutableContent:
    """Converts the elements of one document; unsupported ones are reported."""

    def __init__(
        self,
        document: Document,
        events: Events,
        data: MachineData,
        report: Diagnostics,
    ) -> None:
        self.document = document
        self.events = events
        self.data = data
        self.report = report
        self._delayed: dict[str, set[str]] = {}
        """Ids of the delayed sends of each event, as it is called in the document."""
        for node in document.root.walk():
            if node.name == "send" and _DELAY & set(node.attributes):
                self._delayed.setdefault(node.get("event", ""), set()).add(node.get("id", ""))

    def effects(self, nodes: Iterable[Node], event: Type | None = None) -> tuple[Effect, ...]:
        """Effects of elements; `event` is the type of the current message."""
        made: list[Effect] = []
        nodes = list(nodes)
        cancelled = {node.get("sendid", "") for node in nodes if node.name == "cancel"}
        for node in nodes:
            try:
                effect = self._effect(node, event, cancelled)
                # The portable profile cancels each delayed send of an event.
                if not (isinstance(effect, Cancel) and made and made[-1] == effect):
                    made.append(effect)
            except UnsupportedError as fault:
                self.left_out(node, f"`<{node.name}>`", fault.reason)
        return tuple(made)

    def paths_through(
        self, nodes: list[Node], event: Type | None, changed: set[str]
    ) -> Iterator[tuple[list[Expression], list[Node]]]:
        """Yield the execution paths through `<if>` elements, with the conditions of each.

        A transition evaluates all guards before its effects, unlike SCXML. Conditions that read
        variables in `changed` are therefore not supported.
        """
        paths: list[tuple[list[Expression], list[Node]]] = [([], [])]
        changed = set(changed)
        for node in nodes:
            if node.name != "if" or node.namespace != SCXML:
                paths = [(guards, [*done, node]) for guards, done in paths]
                changed |= self.changed([node])
                continue
            try:
                branches = list(self._branches(node, event))
                read = set().union(*(reads(guard) for guard, _ in branches if guard is not None))
                if read & changed:
                    raise UnsupportedError("its condition reads a variable that was just changed")
                if len(paths) * len(branches) > _MAX_PATHS:
                    raise UnsupportedError("it would need too many transitions")
            except UnsupportedError as fault:
                self.left_out(node, "`<if>`", fault.reason)
                continue
            paths = [
                ([*guards, *conditions], [*done, *actions])
                for guards, done in paths
                for conditions, actions in _exclusive(branches)
            ]
            changed |= self.changed([node])
        yield from paths

    def changed(self, nodes: Iterable[Node]) -> set[str]:
        """Variables that elements assign to."""
        return {
            self.data.name(each.get("location", "").partition(".")[0])
            for node in nodes
            for each in node.walk()
            if each.name == "assign"
        }

    def _branches(
        self, node: Node, event: Type | None
    ) -> Iterator[tuple[Expression | None, list[Node]]]:
        """Yield conditions and contents of an `<if>`; the last condition is None."""
        guard: Expression | None = self.data.condition(node, event)
        actions: list[Node] = []
        for child in node.children:
            if child.name not in ("elseif", "else"):
                if child.name == "if":
                    raise UnsupportedError("nested `<if>` is not supported")
                actions.append(child)
                continue
            yield guard, actions
            actions = []
            guard = None
            if child.name == "elseif":
                guard = self.data.condition(child, event)
        yield guard, actions
        if guard is not None:
            yield None, []

    def _effect(self, node: Node, event: Type | None, cancelled: set[str]) -> Effect:
        if node.namespace != SCXML:
            raise UnsupportedError("it is not SCXML")
        if node.name == "assign":
            location = path(node.get("location", ""))
            value = self.data.read(
                node, "expr", written_value(node), self.data.type_at(location), event
            )
            return Assignment(self.data.variable(location, value), location[1:], value)
        if node.name in ("send", "raise"):
            return self._send(node, event)
        if node.name == "cancel":
            return self._cancel(node.get("sendid", ""), cancelled)
        raise UnsupportedError(_UNSUPPORTED.get(node.name, "a model has no such effect"))

    def _cancel(self, sendid: str, cancelled: set[str]) -> Cancel:
        """Return the cancellation of an event, all of whose delayed sends are cancelled together.

        Raises UnsupportedError.
        """
        named = _SENDID.fullmatch(sendid)
        of = [text for text, ids in self._delayed.items() if sendid in ids and text]
        if not of and named is not None and named[1] in self.events.known:
            of = [named[1]]
        if not sendid or len(of) != 1:
            raise UnsupportedError("no delayed event has this id")
        if not self._delayed.get(of[0], set()) <= cancelled:
            raise UnsupportedError(f"other delayed sends of `{of[0]}` go on")
        event = self.events.known.get(of[0])
        if event is None:
            raise UnsupportedError("its event is computed at run time")
        return Cancel(event.name)

    def _send(self, node: Node, event: Type | None) -> Effect:
        sent_event = self.events.known.get(node.get("event", ""))
        if sent_event is None:
            raise UnsupportedError("its event is computed at run time")
        away = node.get("type", "") == SEND_TYPE
        delayed = bool(_DELAY & set(node.attributes))
        more = set(node.attributes) - _SENT - _DELAY - ({"targetexpr"} if away else set())
        if more:
            raise UnsupportedError(f"`{min(more)}` has no equivalent in a model")
        is_own = node.get("type", "") in _OWN_TYPES and node.get("target", "") in _OWN_TARGETS
        if not away and not is_own:
            raise UnsupportedError("its target is outside of the machine")
        internal = node.name == "raise" or node.get("target") == "#_internal"
        if not away and node.children:
            raise UnsupportedError("it carries data")
        if internal:
            self.report.report("sent-later", self.document.at(node, "event"), event=sent_event.name)
        return Send(
            sent_event.name,
            tuple(self._argument(each, sent_event, event) for each in node.children),
            self._address(node, event) if away else None,
            read_delay(node, self.data, event) if delayed else None,
        )

    def _address(self, node: Node, event: Type | None) -> Address | None:
        """Return the address of a send, if it has one: a role, one of its robots, or a value."""
        value: Expression
        if "targetexpr" in node.attributes:
            value = self.data.read(node, "targetexpr", node.get("targetexpr", ""), STRING, event)
        elif target := node.get("target", ""):
            if forbidden := forbidden_character(target):
                raise UnsupportedError(f"a string of a model cannot contain {forbidden}")
            value = Literal(target, STRING)
        else:
            return None
        match value:
            case Literal(value=str(text)) if (found := _ROBOT.fullmatch(text)) and is_plain(
                found[1]
            ):
                index = Literal(int(found[2]), INT) if found[2] is not None else None
                return Address(found[1], index)
            case Binary(
                operator="+",
                left=Binary(operator="+", left=Literal(value=str(head)), right=index),
                right=Literal(value="]"),
            ) if head.endswith("[") and head[:-1].isidentifier():
                return Address(head[:-1], index)
        return Address(id=value)

    def _argument(self, node: Node, sent: Event, event: Type | None) -> tuple[str, Expression]:
        name = node.get("name", "")
        if node.name != "param":
            raise UnsupportedError(f"it contains `<{node.name}>`")
        expected = self.data.expressions.field(sent.type, name)
        return name, self.data.read(node, "expr", node.get("expr", ""), expected, event)

    def left_out(self, node: Node, what: str, reason: str, attribute: str = "") -> None:
        """Report an element that a model cannot express."""
        place = self.document.at(node, attribute)
        self.report.report("left-out", place, what=what, reason=reason)


def all_of(guards: list[Expression]) -> Expression | None:
    """Conjunction of conditions; None if there are none."""
    return reduce(lambda left, right: Binary("and", left, right, BOOL), guards) if guards else None


def _exclusive(
    branches: list[tuple[Expression | None, list[Node]]],
) -> Iterator[tuple[list[Expression], list[Node]]]:
    """Yield each branch with its condition and the negation of the conditions before."""
    refused: list[Expression] = []
    for guard, actions in branches:
        yield [*refused, *([guard] if guard is not None else [])], actions
        if guard is not None:
            refused.append(Unary("not", guard, BOOL))
