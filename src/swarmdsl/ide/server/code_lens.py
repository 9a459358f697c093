"""Code lenses above declarations: references, preview, and commands that run or build them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owners
from swarmdsl.execution.testing.discovery import SUFFIX
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Component,
    Member,
    Optimization,
    Property,
    StateMachine,
    Swarm,
    TopLevel,
    name_of,
)

Kind = Literal["machine", "member", "swarm", "component", "property"]

_KINDS: dict[type[TopLevel], Kind] = {
    StateMachine: "machine",
    Member: "member",
    Swarm: "swarm",
    Component: "component",
    Property: "property",
}
_PREVIEWED: tuple[Kind, ...] = ("machine", "member", "swarm")
_SIMULATED: tuple[Kind, ...] = ("machine", "swarm", "property")
_DEBUGGED: tuple[Kind, ...] = ("machine", "swarm")
_VERIFIED: tuple[Kind, ...] = ("swarm", "property")
# A build is of all that a swarm has, and its tests are beside it.
_BUILT: tuple[Kind, ...] = ("swarm",)


@dataclass(frozen=True)
class CodeLens:
    """Lens at the name of a declaration; `kind` is None if it cannot be previewed."""

    offer: Literal["references", "preview", "simulate", "debug", "verify", "build", "test"]
    name: Span
    kind: Kind | None = None


def code_lenses(file: File) -> Iterator[CodeLens]:
    """Yield the code lenses of a file."""
    for owner in owners(file):
        if isinstance(owner, Optimization):
            continue
        name = name_of(owner).span.absolute
        kind = _KINDS.get(type(owner))
        if kind != "property":  # only tests name properties
            yield CodeLens("references", name)
        if kind in _PREVIEWED:
            yield CodeLens("preview", name, kind)
        if kind in _SIMULATED:
            yield CodeLens("simulate", name, kind)
        if kind in _DEBUGGED:
            yield CodeLens("debug", name, kind)
        if kind in _VERIFIED:
            yield CodeLens("verify", name, kind)
        if kind in _BUILT:
            yield CodeLens("build", name, kind)
            if _has_tests(file):
                yield CodeLens("test", name, kind)


def _has_tests(file: File) -> bool:
    """Return True if there are behaviour tests beside a file."""
    path = file.source.path
    return path is not None and any(path.parent.glob(f"*{SUFFIX}"))
