"""The elements of SCXML: their attributes, and where they stand."""

from __future__ import annotations

from lxml import etree

from swarmdsl.diagnostics import Diagnostics, listed
from swarmdsl.scxml.document import SCXML, Document, Element
from swarmdsl.suggest import did_you_mean

OURS = "urn:swarmdsl:scxml"
"""Of what swarmdsl writes beside SCXML, for people and for reading models back."""

_CONTENT = {"raise", "if", "log", "assign", "send", "cancel", "foreach", "script"}
_STATES = {"state", "parallel", "final", "history"}
_INSIDE = {"onentry", "onexit", "transition", "datamodel", "invoke"}

# The attributes of each element, and the elements in it.
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
    "assign": ({"location", "expr", "attr"}, set()),
    "send": (
        {"event", "eventexpr", "target", "targetexpr", "type", "typeexpr"}
        | {"id", "idlocation", "delay", "delayexpr", "namelist"},
        {"param", "content"},
    ),
    "cancel": ({"sendid", "sendidexpr"}, set()),
}
# One of the attributes between `|` each.
_NEEDED = {
    "raise": ("event",),
    "if": ("cond",),
    "elseif": ("cond",),
    "assign": ("location",),
    "data": ("id",),
    "param": ("name",),
    "history": ("id",),
    "send": ("event|eventexpr",),
    "cancel": ("sendid|sendidexpr",),
}
_WITH_TEXT = ("data", "assign", "content")
_NOT_RUN = {
    "invoke": "activities outside of the machine are not started from SCXML",
    "script": "scripts are not run",
    "foreach": "lists are not gone through",
}


def check(document: Document, report: Diagnostics) -> None:
    """Report what is no SCXML, and what is but is not understood."""
    foreign: set[str] = set()
    waiting = [document.root]
    while waiting:
        element = waiting.pop()
        name = element.tag.rpartition("}")[2]
        attributes, inside = _ELEMENTS[name]
        _check_attributes(document, element, name, attributes, report)
        _check_text(document, element, name, report)
        for child in element:
            namespace, _, tag = child.tag.rpartition("}")
            if namespace[1:] != SCXML:
                if namespace[1:] not in {OURS, *foreign}:
                    foreign.add(namespace[1:])
                    report.report("foreign-element", document.at(child), name=tag)
            elif tag not in inside:
                _report_unknown(document, child, tag, name, inside, report)
            elif tag in _NOT_RUN:
                report.report("not-understood", document.at(child), name=tag, reason=_NOT_RUN[tag])
            else:
                waiting.append(child)


def _check_attributes(
    document: Document, element: Element, name: str, known: set[str], report: Diagnostics
) -> None:
    given = set()
    for qualified in element.attrib:
        attribute = etree.QName(qualified)
        if attribute.namespace not in (None, SCXML):
            continue
        given.add(attribute.localname)
        if attribute.localname == "event" and not element.attrib[qualified].strip():
            place = document.at(element, "event")
            report.report("bad-value", place, name="event", values="the name of an event")
        elif attribute.localname not in known:
            report.report(
                "unknown-attribute",
                document.at(element, attribute.localname),
                element=name,
                name=attribute.localname,
                help=did_you_mean(attribute.localname, sorted(known))
                or (f"it has {listed(sorted(known), 'and')}" if known else "it has none"),
            )
    for needed in _NEEDED.get(name, ()):
        either = needed.split("|")
        if given.isdisjoint(either):
            report.report("missing-attribute", document.at(element), element=name, name=either[0])


def _report_unknown(
    document: Document, child: Element, tag: str, parent: str, inside: set[str], report: Diagnostics
) -> None:
    around = sorted(name for name, (_, allowed) in _ELEMENTS.items() if tag in allowed)
    question = did_you_mean(tag, sorted(inside))
    if around:
        question = f"it stands in {listed([f'<{name}>' for name in around])}"
    report.report("unknown-element", document.at(child), name=tag, parent=parent, help=question)


def _check_text(document: Document, element: Element, name: str, report: Diagnostics) -> None:
    """Text between elements would be lost."""
    if name in _WITH_TEXT:
        return
    if any(text and text.strip() for text in (element.text, *(child.tail for child in element))):
        fault = f"there is no text in `<{name}>`"
        report.report("illegal-structure", document.at(element), fault=fault)
