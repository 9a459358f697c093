"""SCXML elements: their attributes and allowed children."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.suggest import did_you_mean
from swarmdsl.execution.scxml.document import SCXML, Document, Node

OURS = "urn:swarmdsl:scxml"
"""Namespace of swarmdsl's additions to SCXML, for people and for import."""

SWARM_EVENT = "urn:swarmdsl:swarm"
"""Type of the events that portable documents send to the environment."""

_CONTENT = {"raise", "if", "log", "assign", "send", "cancel", "foreach", "script"}
_STATES = {"state", "parallel", "final", "history"}
_INSIDE = {"onentry", "onexit", "transition", "datamodel", "invoke"}

# The attributes and child elements of each element.
_ELEMENTS: dict[str, tuple[set[str], set[str]]] = {
    "scxml": (
        {"initial", "name", "version", "datamodel", "binding", "exmode"},
        {"state", "parallel", "final", "datamodel", "script", "initial"},
    ),
    "state": ({"id", "initial"}, {*_INSIDE, *_STATES, "initial"}),
    "parallel": ({"id"}, {*_INSIDE, *_STATES} - {"final"}),
    "final": ({"id"}, {"onentry", "onexit", "donedata"}),
    "history": ({"id", "type"}, {"transition"}),
    "initial": (set(), {"transition"}),
    "transition": ({"event", "cond", "target", "type"}, _CONTENT),
    "onentry": (set(), _CONTENT),
    "onexit": (set(), _CONTENT),
    "datamodel": (set(), {"data"}),
    "data": ({"id", "expr", "src"}, set()),
    "donedata": (set(), {"param", "content"}),
    "param": ({"name", "expr", "location"}, set()),
    "content": ({"expr"}, set()),
    "raise": ({"event"}, set()),
    "if": ({"cond"}, {*_CONTENT, "elseif", "else"}),
    "elseif": ({"cond"}, set()),
    "else": (set(), set()),
    "log": ({"label", "expr"}, set()),
    "assign": ({"location", "expr"}, set()),
    "foreach": ({"array", "item", "index"}, _CONTENT),
    "script": ({"src"}, set()),
    "send": (
        {"event", "eventexpr", "target", "targetexpr", "type", "typeexpr"}
        | {"id", "idlocation", "delay", "delayexpr", "namelist"},
        {"param", "content"},
    ),
    "cancel": ({"sendid", "sendidexpr"}, set()),
}
# Required attributes; one of the alternatives separated by `|`.
_NEEDED = {
    "raise": ("event",),
    "if": ("cond",),
    "elseif": ("cond",),
    "assign": ("location",),
    "foreach": ("array", "item"),
    "data": ("id",),
    "param": ("name",),
    "history": ("id",),
    "send": ("event|eventexpr",),
    "cancel": ("sendid|sendidexpr",),
}
_VALUES = ("data", "assign", "content")
_WITH_TEXT = (*_VALUES, "script")
_NOT_RUN = {"invoke": "activities outside of the machine are not started from SCXML"}


def check(document: Document, report: Diagnostics) -> None:
    """Report and remove invalid and unsupported content."""
    foreign: set[str] = set()
    waiting = [document.root]
    while waiting:
        node = waiting.pop()
        attributes, inside = _ELEMENTS[node.name]
        if not attributes.issuperset(node.attributes):
            _report_attributes(document, node, attributes, report)
        for needed in _NEEDED.get(node.name, ()):
            either = needed.split("|")
            if not any(name in node.attributes for name in either):
                place = document.at(node)
                report.report("missing-attribute", place, element=node.name, name=either[0])
        if not node.get("event", "-").strip():
            place = document.at(node, "event")
            report.report("bad-value", place, name="event", values="the name of an event")
        if "src" in node.attributes and "src" in attributes:
            place = document.at(node, "src")
            report.report("not-understood", place, name="src", reason="other files are not read")
        if node.text and node.name not in _WITH_TEXT:
            fault = f"`<{node.name}>` must not contain text"
            report.report("illegal-structure", document.at(node), fault=fault)
        if not node.children:
            continue
        kept = []
        for child in node.children:
            if child.namespace != SCXML or child.name not in inside or child.name in _NOT_RUN:
                _leave_out(document, child, node, inside, foreign, report)
            else:
                kept.append(child)
        node.children = kept
        waiting += reversed(kept)


def _leave_out(
    document: Document,
    child: Node,
    node: Node,
    inside: set[str],
    foreign: set[str],
    report: Diagnostics,
) -> None:
    """Report why an element is ignored; once for each foreign namespace."""
    name = child.name
    if child.namespace == OURS:
        node.ours += (child,)
    elif node.name in _VALUES:
        reason = "XML cannot be a value"
        report.report("not-understood", document.at(child), name=name, reason=reason)
    elif child.namespace != SCXML:
        if child.namespace not in foreign:
            foreign.add(child.namespace)
            report.report("foreign-element", document.at(child), name=name)
    elif name not in inside:
        _report_unknown(document, child, node.name, inside, report)
    else:
        report.report("not-understood", document.at(child), name=name, reason=_NOT_RUN[name])


def _report_attributes(
    document: Document, node: Node, known: set[str], report: Diagnostics
) -> None:
    for name in sorted(set(node.attributes) - known):
        report.report(
            "unknown-attribute",
            document.at(node, name),
            element=node.name,
            name=name,
            help=did_you_mean(name, sorted(known))
            or (f"it has {listed(sorted(known), 'and')}" if known else "it has none"),
        )


def _report_unknown(
    document: Document, node: Node, parent: str, inside: set[str], report: Diagnostics
) -> None:
    around = sorted(name for name, (_, allowed) in _ELEMENTS.items() if node.name in allowed)
    question = did_you_mean(node.name, sorted(inside))
    if around:
        question = f"it is allowed in {listed([f'<{name}>' for name in around])}"
    report.report(
        "unknown-element", document.at(node), name=node.name, parent=parent, help=question
    )
