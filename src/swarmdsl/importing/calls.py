"""Read the activity of a state in all generations of the CPSwarm dialect."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.types import qualified
from swarmdsl.ir import Named, Policy

_BODIES = {"rosaction": "action", "rosservice": "service", "rosmonitor": "monitor"}
_TYPES = {"ROS_ACTION": "rosaction", "ROS_SERVICE": "rosservice", "ROS_MONITOR": "rosmonitor"}
# `object` and `slot` are names of 2018.
_POLICIES = {"object": "fixed", "slot": "userdata"}
_TOPIC = re.compile(r"[~/]?[A-Za-z][\w/]*", re.ASCII)
_FIELD = re.compile(r"[A-Za-z]\w*", re.ASCII)
_SPARE = ("adf", "input", "invoke")


@dataclass(frozen=True)
class Monitor:
    """A monitored topic; `topic` is empty if the file does not give it."""

    node: Node
    topic: str
    type: Named


@dataclass(frozen=True)
class Call:
    """A called action or service; `function` is its name in ADF."""

    node: Node
    paradigm: Literal["action", "service"]
    name: str
    type: Named
    function: str
    goal: Policy
    goal_items: tuple[str, ...]
    result: Policy
    result_items: tuple[str, ...]
    mappings: tuple[tuple[str, str], ...]


class Calls:
    """Reads the calls of one document and reports repairs."""

    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.report = report

    def read(self, state: Node) -> Call | Monitor | None:
        """Call or monitor of a state; None if it has neither."""
        data = [each for each in _inside(state, "datamodel") if each.name == "data"]
        invokes = [each for each in state.children if each.name == "invoke"]
        holder = next((each for each in data if each.get("id") == "invoke"), None)
        body = (
            next((each for each in holder.children if each.name in _BODIES), None)
            if (holder is not None)
            else None
        )
        if holder is None:
            body = next((each for each in state.children if each.name in _BODIES), None)
            holder = state
            if body is None and any(each.name in ("action", "srv") for each in state.children):
                # The exporter of 2021 omits the enclosing elements.
                self._repaired(state, "its call is outside of `<data>` and `<invoke>`")
                body = state
        for spare in invokes[1:]:
            self._left_out(spare, "a second `<invoke>`", "a state has one activity")
        for each in data:
            if each.get("id") not in _SPARE:
                self._left_out(
                    each, f"data `{each.get('id', '')}`", "only state machines have data"
                )
        if body is None:
            if invokes:
                name = invokes[0].get("type") or invokes[0].get("id") or "invoke"
                why = "it names no ROS action, service or topic"
                self._left_out(invokes[0], f"`{name}`", why)
            return None
        kind = _BODIES.get(body.name) or (
            "service" if any(each.name == "srv" for each in body.children) else "action"
        )
        written = invokes[0].get("type") if invokes else None
        if body is not state and _TYPES.get(written or "") != body.name:
            fault = f"`{written}` does not match" if written else "`<invoke>` is missing"
            self._repaired(
                invokes[0] if invokes else body, f"{fault}: it is read as a call of a {kind}"
            )
        if kind == "monitor":
            return self._monitor(body)
        function = next((_text(each, "name") for each in data if each.get("id") == "adf"), "")
        return self._call(body, "action" if kind == "action" else "service", holder, function)

    def _monitor(self, body: Node) -> Monitor:
        topic = _text(body, "topic").lstrip("/")
        if not _TOPIC.fullmatch(topic):
            self._assumed(body, f"topic `{topic}` is undefined", "the name of the event")
            topic = ""
        return Monitor(body, topic, self._type(body, "msg", "message"))

    def _call(
        self, body: Node, paradigm: Literal["action", "service"], holder: Node, function: str
    ) -> Call:
        names = {"action": ("goal", "result"), "service": ("request", "response")}[paradigm]
        tag = "action" if paradigm == "action" else "srv"
        if not any(each.name == tag for each in body.children):
            tag = "srv" if tag == "action" else "action"
        name = _text(body, "name").lstrip("/")
        if not _TOPIC.fullmatch(name):
            new = re.sub(r"\W+", "_", name).strip("_") or "unnamed"
            self._renamed(body, name, new)
            name = new
        goal, goal_items = self._policy(body, names[0], "goal")
        result, result_items = self._policy(body, names[1], "result")
        return Call(
            body,
            paradigm,
            name,
            self._type(body, tag, paradigm),
            function,
            goal,
            goal_items,
            result,
            result_items if result is Policy.USERDATA else (),
            tuple(self._mappings(holder)),
        )

    def _type(self, body: Node, tag: str, kind: str) -> Named:
        text = _text(body, tag)
        type_ = qualified(text, kind)
        if not re.search(r"[/.]", text):
            self._assumed(body, f"the package of `{text}` is missing", f"`{type_}`", tag)
        return type_

    def _policy(self, body: Node, name: str, other: str) -> tuple[Policy, tuple[str, ...]]:
        """Policy of a goal or result with its values or fields."""
        node = _child(body, name)
        if node is None and name != other:
            node = _child(body, other)
            if node is not None:
                self._repaired(node, f"`<{other}>` of a service is read as `<{name}>`")
        if node is None:
            if name in ("goal", "request"):
                self._repaired(body, f"`<{name}>` is missing: it is read as empty")
            else:
                self._repaired(body, f"`<{name}>` is missing: its values are not stored")
            return Policy.EMPTY, ()
        values = [each for each in node.children if each.name in ("param", "var")]
        for value in values:
            if value.name == "var" and not _FIELD.fullmatch(value.text.strip()):
                self._left_out(value, f"`{value.text.strip()}`", "it is not a valid field name")
                values = [each for each in values if each is not value]
        items = tuple(each.text.strip() for each in values)
        given = node.get("type", "")
        written = _POLICIES.get(given, given)
        if written in {policy.value for policy in Policy}:
            policy = Policy(written)
        elif any(each.name == "param" for each in node.children):
            policy = Policy.FIXED
        else:
            policy = Policy.USERDATA if items else Policy.EMPTY
        if given != policy.value:
            shown = next((f'{key}="{value}"' for key, value in node.attributes.items()), "none")
            self._repaired(node, f"the policy {shown} is read as `{policy.value}`")
        if bool(items) != (policy in (Policy.FIXED, Policy.USERDATA)):
            if items:
                what = ", ".join(f"`{item}`" for item in items)
                self._left_out(node, what, f"the policy is `{policy.value}`")
            elif name in ("goal", "request", "result", "response"):
                self._repaired(
                    node, f"the policy `{policy.value}` has no values: it is read as empty"
                )
                policy = Policy.EMPTY
            items = ()
        return policy, items

    def _mappings(self, holder: Node) -> Iterator[tuple[str, str]]:
        """Yield pairs of a field and the key that stores it."""
        for mappings in (each for each in holder.walk() if each.name == "mappings"):
            for pair in (each for each in mappings.children if each.name == "map"):
                yield _text(pair, "x"), _text(pair, "y")
            bare = [each for each in mappings.children if each.name in ("x", "y")]
            if bare:
                self._repaired(bare[0], f"`<{bare[0].name}>` is outside of `<map>`")
            keys = [each.text.strip() for each in bare if each.name == "y"]
            yield from zip((e.text.strip() for e in bare if e.name == "x"), keys, strict=False)

    def _repaired(self, node: Node, fault: str) -> None:
        self.report.report("repaired-dialect", self.document.at(node), fault=fault)

    def _left_out(self, node: Node, what: str, reason: str) -> None:
        self.report.report("left-out", self.document.at(node), what=what, reason=reason)

    def _renamed(self, node: Node, name: str, new: str) -> None:
        self.report.report("renamed", self.document.at(node), name=name, new=new)

    def _assumed(self, body: Node, what: str, assumed: str, tag: str = "topic") -> None:
        place = self.document.at(_child(body, tag) or body)
        self.report.report("assumed", place, what=what, assumed=assumed)


def _inside(node: Node, name: str) -> list[Node]:
    return [inner for each in node.children if each.name == name for inner in each.children]


def _child(node: Node, name: str) -> Node | None:
    return next((each for each in node.children if each.name == name), None)


def _text(node: Node, name: str) -> str:
    child = _child(node, name)
    return child.text.strip() if child is not None else ""
