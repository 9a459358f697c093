"""Values of machines as an editor shows them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.ir import Literal, System
from swarmdsl.syntax.types import DURATION

_LONGEST = 200


@dataclass(frozen=True)
class Shown:
    """Variable of a scope; `settable` if the user may give it another value."""

    name: str
    value: Any
    type: ir.Type | None = None
    text: str = ""
    expression: str = ""
    settable: bool = False


class References:
    """Numbers of scopes and structures that a client can open, while the run stands still."""

    def __init__(self) -> None:
        self._held: list[tuple[int, list[Shown]]] = []

    def clear(self) -> None:
        """Forget them all: the run goes on."""
        self._held.clear()

    def add(self, member: int, variables: Iterable[Shown]) -> int:
        """Return a new number for variables of a member."""
        self._held.append((member, list(variables)))
        return len(self._held)

    def of(self, number: int) -> tuple[int, list[Shown]] | None:
        """Return the member and the variables of a number."""
        return self._held[number - 1] if 0 < number <= len(self._held) else None

    def inside(self, member: int, shown: Shown) -> int:
        """Return a number for the parts of a value; 0 if it has none."""
        value = shown.value
        if isinstance(value, dict) and value:
            prefix = f"{shown.expression}." if shown.expression else ""
            return self.add(
                member,
                (
                    Shown(str(name), part, expression=f"{prefix}{name}" if prefix else "")
                    for name, part in value.items()
                ),
            )
        if isinstance(value, (list, tuple)) and value:
            prefix = shown.expression
            return self.add(
                member,
                (
                    Shown(f"[{at}]", part, expression=f"{prefix}[{at}]" if prefix else "")
                    for at, part in enumerate(value)
                ),
            )
        return 0


def text_of(value: Any, type_: ir.Type | None = None, system: System | None = None) -> str:
    """Return a value as the language writes it, as far as it has words for it."""
    if type_ == DURATION and isinstance(value, (int, float)):
        return format_duration(int(value))
    name = _name_in_enum(value, type_, system)
    if name is not None:
        return name
    text = json.dumps(named_numbers(value), ensure_ascii=False, default=str)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."


def _name_in_enum(value: Any, type_: ir.Type | None, system: System | None) -> str | None:
    enum = type_.enum if isinstance(type_, ir.Primitive) else None
    described = system.known_interface(enum) if system is not None and enum is not None else None
    if enum is None or not isinstance(described, ir.Message):
        return None
    for each in described.constants:
        if isinstance(each.value, Literal) and each.value.value == value:
            return f"{enum.name}.{each.name}"
    return None


def type_text(type_: ir.Type | None) -> str:
    """Return the name of a type; empty if it is not known."""
    if isinstance(type_, ir.Primitive) and type_.enum is not None:
        return type_.enum.name
    return str(type_) if type_ is not None else ""
