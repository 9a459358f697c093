"""Output formats of diagrams."""

from __future__ import annotations

from swarmdsl.codegen.diagram.mermaid import mermaid
from swarmdsl.tools.diagram.dot import dot
from swarmdsl.tools.diagram.plantuml import plantuml
from swarmdsl.tools.diagram.svg import svg

FORMATS = {"svg": svg, "dot": dot, "mermaid": mermaid, "plantuml": plantuml}
"""Writer of each format by name."""
SUFFIXES = {"svg": ".svg", "dot": ".dot", "mermaid": ".mmd", "plantuml": ".puml"}
