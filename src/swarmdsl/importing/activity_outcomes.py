"""Assign outcomes of the CPSwarm dialect to activities.

In the dialect, `succeeded` on a container handles that outcome of any activity inside, as SMACH
passes an outcome to the enclosing container.
"""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.execution.scxml.document import Document
from swarmdsl.importing.calls import Call
from swarmdsl.importing.partial_states import OUTCOMES, Edge, PartialState
from swarmdsl.ir import StateKind


def resolve_outcomes(top: PartialState, document: Document, report: Diagnostics) -> None:
    """Move transitions for outcomes to the states whose activities have them.

    An unhandled outcome ends the machine in a final state with the name of the outcome.
    """
    finals: dict[str, PartialState] = {}
    used: set[Edge] = set()
    passed: list[tuple[PartialState, list[Edge]]] = []
    for draft in top.walk():
        if not isinstance(draft.call, Call):
            continue
        added: list[Edge] = []
        open_: list[str] = []
        for outcome in OUTCOMES:
            handled = False
            for level in (draft, *draft.ancestors()):
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
                    finals[outcome] = PartialState(
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
                help="add a transition to another state if the robot should continue",
            )
    for draft, added in passed:
        draft.edges += added
    for draft in top.walk():
        if not isinstance(draft.call, Call):
            draft.edges = [
                edge for edge in draft.edges if _is_kept(edge, draft, used, document, report)
            ]
    top.children += finals.values()


def _is_kept(
    edge: Edge, draft: PartialState, used: set[Edge], document: Document, report: Diagnostics
) -> bool:
    """Return False for a transition that was moved or whose outcome cannot occur."""
    if edge.event not in OUTCOMES:
        return True
    if edge in used:
        return False
    place = document.at(edge.node, "event", edge.event or "")
    if edge.event == "succeeded" and draft.kind is StateKind.SIMPLE and not draft.monitors:
        fault = f"`{draft.id}` has no activity that could succeed: it is left immediately"
        report.report("repaired-dialect", place, fault=fault)
        return True
    reason = (
        f"no activity in `{draft.id}` has this outcome" if draft.children else "it has no activity"
    )
    report.report("left-out", place, what="this transition", reason=reason)
    return False
