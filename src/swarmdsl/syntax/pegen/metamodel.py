"""textX metamodel of the language."""

from __future__ import annotations

from typing import Any

from textx import metamodel_from_file

from swarmdsl.base.resources import grammar


def metamodel() -> Any:
    """Return the textX metamodel of the language; references stay unresolved."""
    made = metamodel_from_file(str(grammar() / "swarm.tx"), autokwd=True)
    made.register_scope_providers({"*.*": lambda _object, _attribute, reference: reference})
    return made
