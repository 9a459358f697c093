"""Bare outcomes of the CPSwarm dialect: whose activity it is that has ended so.

There, `succeeded` on a container means that something inside has succeeded and says no more
itself, as SMACH hands an outcome from a state to the container around it.
"""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.execution.scxml.document import Document
from swarmdsl.importing.calls import Call
from swarmdsl.importing.partial_states import OUTCOMES, Draft, Edge
from swarmdsl.ir import StateKind


def settle(top: Draft, document: Document, report: Diagnostics) -> None:
    """Give each activity a way on for its outcomes, and take them from all other states.

    What nothing reacts to ends the machine, in a final state of the name of the outcome.
    """
    finals: dict[str, Draft] = {}
    used: set[Edge] = set()
    passed: list[tuple[Draft, list[Edge]]] = []
    for draft in top.walk():
        if not isinstance(draft.call, Call):
            continue
        added: list[Edge] = []
        open_: list[str] = []
        for outcome in OUTCOMES:
            handled = False
            for level in (draft, *draft.around()):
                edges = [edge for edge in level.edges if edge.event == outcome]
                if level is not draft:
                    used.update(edges)
                    added += edges
                if any(not edge.node.get("cond") for edge in edges):
                    handled = True
                    break
            if not handled and outcome != "preempted":
                open_.append(outcome)
                if outcome not in finals:
                    finals[outcome] = Draft(
                        document.root, outcome.capitalize(), StateKind.FINAL, top
                    )
                added.append(Edge(draft.call.node, outcome, finals[outcome]))
        passed.append((draft, added))
        if open_:
            report.report(
                "open-outcome",
                document.at(draft.node, "id"),
                outcomes=listed(open_, "and"),
                state=draft.id,
                help="let it lead elsewhere in the model if the robot should go on",
            )
    for draft, added in passed:
        draft.edges += added
    for draft in top.walk():
        if not isinstance(draft.call, Call):
            draft.edges = [
                edge for edge in draft.edges if _stays(edge, draft, used, document, report)
            ]
    top.children += finals.values()


def _stays(
    edge: Edge, draft: Draft, used: set[Edge], document: Document, report: Diagnostics
) -> bool:
    """Whether a state keeps a transition: one on an outcome that never comes has no use."""
    if edge.event not in OUTCOMES:
        return True
    if edge in used:
        return False
    place = document.at(edge.node, "event", edge.event or "")
    if edge.event == "succeeded" and draft.kind is StateKind.SIMPLE and not draft.monitors:
        fault = f"`{draft.id}` does nothing that could succeed: it is left at once"
        report.report("repaired-dialect", place, fault=fault)
        return True
    reason = f"nothing in `{draft.id}` can end so" if draft.children else "there is no activity"
    report.report("left-out", place, what="this transition", reason=reason)
    return False
