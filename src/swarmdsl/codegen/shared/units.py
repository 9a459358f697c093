"""Units of values in the documentation of generated code."""

from __future__ import annotations

from swarmdsl.syntax.types import Type, declared_unit
from swarmdsl.syntax.units import described_unit


def doc_with_unit(doc: str, type_: Type) -> str:
    """Return documentation of a value with the unit that ROS has it in: `Rise so far. In m.`."""
    unit = declared_unit(type_)
    if unit is None:
        return doc
    sentence = described_unit(unit)
    text = doc.rstrip()
    if not text:
        return sentence
    return f"{text} {sentence}" if text[-1] in ".!?:" else f"{text}. {sentence}"
