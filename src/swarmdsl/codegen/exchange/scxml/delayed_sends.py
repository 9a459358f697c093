"""Ids of delayed sends, and the elements that cancel them.

A `<cancel>` names one id; the model cancels all delayed sends of an event. So each `<send>` gets an
id of its own, `send.<event>.<n>`, and one `cancel` of the model becomes an element for each id.
"""

from __future__ import annotations

from lxml import etree

from swarmdsl.codegen.exchange.scxml.xml import add


class DelayedSends:
    """The delayed sends of a document by event, and the places where they are cancelled."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._cancels: list[tuple[etree._Element, str]] = []

    def send(self, element: etree._Element, event: str) -> None:
        """Give an id to a `<send>` with a delay."""
        number = self._numbers[event] = self._numbers.get(event, 0) + 1
        element.set("id", _id(event, number))

    def cancel(self, parent: etree._Element, event: str) -> None:
        """Add a `<cancel>` for the first send; `finish` adds those for the others."""
        self._cancels.append((add(parent, "cancel", sendid=_id(event, 1)), event))

    def finish(self) -> None:
        """Complete the cancels; all sends of the document are known."""
        for first, event in self._cancels:
            last = first
            for number in range(2, self._numbers.get(event, 1) + 1):
                other = etree.Element(first.tag, {"sendid": _id(event, number)})
                last.addnext(other)
                last = other


def _id(event: str, number: int) -> str:
    return f"send.{event}.{number}"
