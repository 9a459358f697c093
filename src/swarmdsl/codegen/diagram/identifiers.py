"""Identifiers that every notation allows: letters, digits and `_`."""

from __future__ import annotations

import re

from swarmdsl.codegen.diagram.graph import Diagram

# Keywords at the start of a line of DOT, Mermaid or PlantUML.
_RESERVED = """
abstract accdescr acctitle actor agent artifact as boundary call card choice circle class
classdef click cloud collections component control database default digraph direction edge else
end entity enum file flowchart folder footer fork frame graph header hexagon hide href interface
interpolate join legend linkstyle mainframe namespace newpage node note object package page
participant port portin portout queue rectangle remove scale set show skinparam stack start
state storage strict style subgraph title together usecase
"""


def identifiers(diagram: Diagram) -> dict[str, str]:
    """Return a distinct identifier for each id of a node or port."""
    ids = [
        each
        for node in diagram.frame.walk()
        for each in (node.id, *(port.id for port in node.ports))
    ]
    names: dict[str, str] = {}
    taken = set(_RESERVED.split())
    # The last number of each name that had to be numbered.
    numbers: dict[str, int] = {}
    for each in ids:
        name = wanted = re.sub(r"[^A-Za-z0-9]+", "_", each).strip("_") or diagram.kind
        while name.lower() in taken:
            numbers[wanted.lower()] = number = numbers.get(wanted.lower(), 1) + 1
            name = f"{wanted}_{number}"
        taken.add(name.lower())
        names[each] = name
    return names
