"""What transitions and states do: executable content of SCXML as effects of the language."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import reduce

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange.scxml.portable import SEND_TYPE
from swarmdsl.execution.scxml.document import SCXML, Document, Node
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsayableError, path
from swarmdsl.ir import Assignment, Binary, Effect, Event, Expression, Send, Type, Unary
from swarmdsl.ir.expressions import reads
from swarmdsl.syntax.types import BOOL

_NOT_HERE = {
    "log": "a model writes no log",
    "script": "a model runs no scripts",
    "foreach": "a model does not go through lists",
    "if": "only transitions have conditions in a model",
    "cancel": "a model cancels delays only when their state is left",
}
_SENT = {"event", "id", "type", "target"}
# Where <send> without more leads: to the machine itself (SCXML 6.2.4, C.1).
_SELF = ("", "#_scxml", "#_internal", "scxml", "http://www.w3.org/TR/scxml/#SCXMLEventProcessor")
_MOST_WAYS = 16


class Content:
    """Reads the elements of one document; what has no place is reported."""

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

    def effects(self, nodes: Iterable[Node], event: Type | None = None) -> tuple[Effect, ...]:
        """The effects that elements are, where `event` is the message at hand."""
        made: list[Effect] = []
        for node in nodes:
            try:
                made.append(self._effect(node, event))
            except UnsayableError as fault:
                self.left_out(node, f"`<{node.name}>`", fault.reason)
        return tuple(made)

    def ways(
        self, nodes: list[Node], event: Type | None, changed: set[str]
    ) -> Iterator[tuple[list[Expression], list[Node]]]:
        """The ways through the `<if>`s in some elements, each with what must hold for it.

        Conditions are looked at before anything is done here, and on the way in SCXML: where
        it has been `changed` until then what they are about, they cannot be said.
        """
        ways: list[tuple[list[Expression], list[Node]]] = [([], [])]
        changed = set(changed)
        for node in nodes:
            if node.name != "if" or node.namespace != SCXML:
                ways = [(guards, [*done, node]) for guards, done in ways]
                changed |= self.changed([node])
                continue
            try:
                branches = list(self._branches(node, event))
                read = set().union(*(reads(guard) for guard, _ in branches if guard is not None))
                if read & changed:
                    raise UnsayableError("its condition is about what has just been changed")
                if len(ways) * len(branches) > _MOST_WAYS:
                    raise UnsayableError("there would be too many transitions")
            except UnsayableError as fault:
                self.left_out(node, "`<if>`", fault.reason)
                continue
            ways = [
                ([*guards, *conditions], [*done, *does])
                for guards, done in ways
                for conditions, does in _told_apart(branches)
            ]
            changed |= self.changed([node])
        yield from ways

    def changed(self, nodes: Iterable[Node]) -> set[str]:
        """The variables that elements assign to."""
        return {
            self.data.name(each.get("location", "").partition(".")[0])
            for node in nodes
            for each in node.walk()
            if each.name == "assign"
        }

    def _branches(
        self, node: Node, event: Type | None
    ) -> Iterator[tuple[Expression | None, list[Node]]]:
        """The conditions and contents of an `<if>`; the last has none."""
        guard: Expression | None = self.data.condition(node, event)
        does: list[Node] = []
        for child in node.children:
            if child.name not in ("elseif", "else"):
                if child.name == "if":
                    raise UnsayableError("there is another one in it")
                does.append(child)
                continue
            yield guard, does
            does = []
            guard = None
            if child.name == "elseif":
                guard = self.data.condition(child, event)
        yield guard, does
        if guard is not None:
            yield None, []

    def _effect(self, node: Node, event: Type | None) -> Effect:
        if node.namespace != SCXML:
            raise UnsayableError("it is no SCXML")
        if node.name == "assign":
            location = path(node.get("location", ""))
            written = node.get("expr", node.text.strip())
            value = self.data.read(node, "expr", written, self.data.type_at(location), event)
            return Assignment(self.data.variable(location, value), location[1:], value)
        if node.name in ("send", "raise"):
            return self._send(node, event)
        raise UnsayableError(_NOT_HERE.get(node.name, "a model has no such effect"))

    def _send(self, node: Node, event: Type | None) -> Effect:
        meant = self.events.known.get(node.get("event", ""))
        if meant is None:
            raise UnsayableError("its event is not known in advance")
        more = set(node.attributes) - _SENT
        if more:
            raise UnsayableError(f"a model has no `{min(more)}` for what it sends")
        away = node.get("type", "") == SEND_TYPE
        if not away and (node.get("type", ""), node.get("target", "")) not in [
            (type_, target) for type_ in _SELF for target in _SELF
        ]:
            raise UnsayableError("it goes elsewhere")
        internal = node.name == "raise" or node.get("target") == "#_internal"
        if not away and node.children:
            raise UnsayableError("it carries data")
        if internal:
            self.report.report("sent-later", self.document.at(node, "event"), event=meant.name)
        return Send(meant.name, tuple(self._argument(each, meant, event) for each in node.children))

    def _argument(self, node: Node, sent: Event, event: Type | None) -> tuple[str, Expression]:
        name = node.get("name", "")
        if node.name != "param":
            raise UnsayableError(f"there is `<{node.name}>` in it")
        wanted = self.data.expressions.field(sent.type, name)
        return name, self.data.read(node, "expr", node.get("expr", ""), wanted, event)

    def left_out(self, node: Node, what: str, reason: str, attribute: str = "") -> None:
        """Report that something has no place in a model."""
        place = self.document.at(node, attribute)
        self.report.report("left-out", place, what=what, reason=reason)


def all_of(guards: list[Expression]) -> Expression | None:
    """One condition of many; None where there is none."""
    return reduce(lambda left, right: Binary("and", left, right, BOOL), guards) if guards else None


def _told_apart(
    branches: list[tuple[Expression | None, list[Node]]],
) -> Iterator[tuple[list[Expression], list[Node]]]:
    """Each branch with all that must hold: its own condition, and none of those before."""
    refused: list[Expression] = []
    for guard, does in branches:
        yield [*refused, *([guard] if guard is not None else [])], does
        if guard is not None:
            refused.append(Unary("not", guard, BOOL))
