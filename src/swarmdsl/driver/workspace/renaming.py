"""Rename declarations and all references to them.

A new name is tried first, and refused if it causes an error.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from swarmdsl.analysis.node_kinds import KINDS
from swarmdsl.analysis.resolve.identities import role_uses
from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.base.source import Span
from swarmdsl.base.text_edits import Edits
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.bound_params import bound_together
from swarmdsl.driver.workspace.references import (
    Occurrence,
    occurrence_at,
    occurrences_of,
    owners,
)
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Fitness,
    Node,
    Port,
    Property,
    Role,
    StateMachine,
)
from swarmdsl.syntax.parser.keywords import RESERVED

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


class RefusedError(Exception):
    """A rename that is not possible; the message is the reason."""


def renamable(workspace: Workspace, file: File, offset: int) -> Occurrence:
    """Return the name at an offset; raise RefusedError if it cannot be renamed."""
    found = occurrence_at(workspace, file, offset)
    if found is None or type(found.node) not in KINDS:
        raise RefusedError("there is no name declared in the model")
    home = _home(workspace, found.node)
    if home is None or not home.source.name.endswith(SUFFIX):
        raise RefusedError(f"`{found.span.text}` is declared in an interface of ROS")
    if home.library:
        raise RefusedError(f"`{found.span.text}` is declared in a library")
    return found


def rename(workspace: Workspace, file: File, offset: int, name: str) -> list[Span]:
    """Return the spans to replace by `name`; raise RefusedError if not possible."""
    found = renamable(workspace, file, offset)
    if not _NAME.fullmatch(name):
        raise RefusedError(f"`{name}` is not a valid name: use letters, digits and `_`")
    if name in RESERVED and not isinstance(found.node, Port):
        raise RefusedError(f"`{name}` is a keyword")
    together = bound_together(found.node, workspace)
    homes = [_home(workspace, each) for each in together]
    if any(home is None or home.library for home in homes):
        raise RefusedError(f"`{found.span.text}` is bound to a param of a library by its name")
    spans = _spans(found.node, workspace)
    if any(span.text != found.span.text for span in spans):
        raise RefusedError(f"`{found.span.text}` has a different name where it is used")
    objection = None
    if name != found.span.text:
        objection = _shared(workspace, found, spans) or _conflict(workspace, found, spans, name)
    if objection is not None:
        raise RefusedError(objection)
    return spans


def _home(workspace: Workspace, node: Node) -> File | None:
    path = node.span.absolute.source.path
    return workspace.file(path) if path is not None else None


def _conflict(workspace: Workspace, found: Occurrence, spans: list[Span], name: str) -> str | None:
    """Return the error that a name would cause; None if all references stay the same."""
    other = f"`{name}` would resolve to a different declaration, or shadow one"
    before = _errors(workspace)
    with workspace.overriding(replaced(spans, name)):
        new = _errors(workspace) - before
        if new:
            known = {each.code: each.message for each in reversed(list(workspace.report))}
            return f"with `{name}` there would be an error: {known[next(iter(new))]}"
        path = found.span.source.path
        file = workspace.file(path) if path is not None else None
        earlier = sum(span.source.path == path and span.start < found.span.start for span in spans)
        start = found.span.start + earlier * (len(name) - len(found.span.text))
        again = occurrence_at(workspace, file, start) if file is not None else None
        if again is None:
            return other
        return None if len(_spans(again.node, workspace)) == len(spans) else other


def _shared(workspace: Workspace, found: Occurrence, spans: list[Span]) -> str | None:
    """Return the objection to a role whose name in a machine is one of another swarm, too."""
    if not isinstance(found.node, Role):
        return None
    for file in workspace.project.files:
        for owner in owners(file):
            if not isinstance(owner, (StateMachine, Property, Fitness)):
                continue
            for span, role in role_uses(owner, workspace.project):
                if role is not found.node and span.absolute in spans:
                    return f"it is also a role of another swarm that runs `{owner.name}`"
    return None


def _spans(node: Node, workspace: Workspace) -> list[Span]:
    """Return the places of a name, and of those that are bound to it."""
    nodes = bound_together(node, workspace)
    found = (each.span for one in nodes for each in occurrences_of(one, workspace))
    return list(dict.fromkeys(found))


def _errors(workspace: Workspace) -> Counter[str]:
    report = workspace.report
    return Counter(each.code for each in report if each.severity is Severity.ERROR)


def replaced(spans: list[Span], name: str) -> dict[Path, str]:
    """Return the contents of files with spans replaced by `name`."""
    edits: dict[Path, Edits] = {}
    for span in spans:
        if span.source.path is not None:
            edits.setdefault(span.source.path, Edits(span.source)).replace(span, name)
    return {path: made.text() for path, made in edits.items()}
