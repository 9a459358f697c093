"""Known deviations of third-party engines from SCXML 1.0, with their causes.

Each cause is shown by a document of its own. It is no fault of the model or of the document
made of it: SCXML 1.0 says what ours does.
"""

from __future__ import annotations

from dataclasses import dataclass

from swarmdsl import ir
from swarmdsl.ir import Assignment, EventTrigger, StateKind

PSM, QT = "python-statemachine", "QtScxml"


@dataclass(frozen=True)
class Cause:
    """Reason that an engine differs: the clause it departs from, and a document that shows it."""

    engine: str
    name: str
    reason: str
    document: str
    events: tuple[str, ...]


DEEPER_FIRST = Cause(
    QT,
    "deeper source first",
    "of two regions that disagree about an event, the one with the deeper source decides, "
    "and not the first in document order (3.13, Appendix D removeConflictingTransitions)",
    """<parallel id="p">
      <state id="l"><state id="a"><transition event="e" target="one"/></state></state>
      <state id="r"><state id="b"><state id="c">
        <transition event="e" target="two"/></state></state></state>
    </parallel>
    <state id="one"/><state id="two"/>""",
    ("e",),
)
FUNCTIONS = Cause(
    PSM,
    "no data in functions",
    "its expressions are those of Python, which evaluates them so that functions in them do not "
    "see the data of the machine (B.2.1)",
    """<datamodel><data id="xs" expr="[1]"/><data id="n" expr="0"/></datamodel>
    <state id="a">
      <transition event="e" cond="xs.some(function (x) { return x &gt; n; })" target="b"/>
    </state>
    <state id="b"/>""",
    ("e",),
)
FIELDS = Cause(
    QT,
    "no assignment to fields",
    "<assign> has a name of a <data> as its location, and no field of one (5.4, B.2.3)",
    """<datamodel><data id="m" expr='({"n": 0})'/></datamodel>
    <state id="a"><transition event="e"><assign location="m.n" expr="1"/></transition>
      <transition event="f" cond="m.n == 1" target="b"/></state>
    <state id="b"/>""",
    ("e", "f"),
)
PARALLEL_LAST = Cause(
    PSM,
    "parallel states last",
    "children are read as all <state>, then <final>, then <parallel>: of two regions that "
    "disagree, a parallel one loses though it is first in the document (3.13)",
    """<parallel id="p">
      <parallel id="l"><state id="a"><transition event="e" target="one"/></state><state id="x"/>
      </parallel>
      <state id="r"><state id="b"><transition event="e" target="two"/></state></state>
    </parallel>
    <state id="one"/><state id="two"/>""",
    ("e",),
)
FIRST_STATE = Cause(
    PSM,
    "initial parallel state",
    "of the states in a state, a <parallel> that comes first is not initial where there is a "
    "<state> (3.3.1); documents that swarmdsl writes say which state is initial",
    """<state id="s">
      <parallel id="p"><state id="l"/><state id="r"/></parallel>
      <state id="a"/>
    </state>""",
    (),
)
DONE_IS_THE_END = Cause(
    PSM,
    "the end with the last region",
    "the machine ends when each region of a parallel state at its top is done; SCXML ends it in a "
    "<final> at its top only (3.7, 3.4)",
    """<parallel id="p">
      <state id="l"><state id="a"><transition event="e" target="f"/></state><final id="f"/></state>
      <transition event="e" target="b"/>
    </parallel>
    <state id="b"/>""",
    ("e", "e"),
)
CAUSES = (DEEPER_FIRST, FUNCTIONS, FIELDS, PARALLEL_LAST, FIRST_STATE, DONE_IS_THE_END)

NOTHING_DEFERRED = "SCXML has no deferred events: `<sw:defer>` is a word of swarmdsl"
DEFERRED = {
    engine: Cause(
        engine,
        "deferred events",
        NOTHING_DEFERRED,
        """<state id="a">
          <sw:defer xmlns:sw="urn:swarmdsl:scxml" event="e"/>
          <transition event="f" target="b"/>
        </state>
        <state id="b"><transition event="e" target="c"/></state>
        <state id="c"/>""",
        ("e", "f"),
    )
    for engine in (PSM, QT)
}
MODELS = {
    **{
        (machine, engine): cause
        for machine in ("Keeps", "Farm", "Scouting", "Spraying")
        for engine, cause in DEFERRED.items()
    },
    ("Arrays", PSM): FUNCTIONS,
    ("Market", PSM): FUNCTIONS,
    ("Disagreement", QT): DEEPER_FIRST,
    ("Fields", QT): FIELDS,
}
"""The machines of models that show one."""


def expected(machine: ir.StateMachine, engine: str) -> Cause | None:
    """A cause that may make a difference to a machine that was made by chance."""
    if engine == QT and _stores_in_fields(machine):
        return FIELDS
    if engine == PSM and any(_is_done(state) for state in machine.states):
        return DONE_IS_THE_END
    if engine in (PSM, QT) and any(map(_disagrees, machine.walk())):
        return DEEPER_FIRST if engine == QT else PARALLEL_LAST
    return None


def _stores_in_fields(machine: ir.StateMachine) -> bool:
    for state in machine.walk():
        effects = [e for each in state.transitions for e in each.effects]
        effects += [*state.entry, *state.exit]
        if any(isinstance(effect, Assignment) and effect.path for effect in effects):
            return True
        if state.activity is not None and any(each.path for each in state.activity.results):
            return True
    return False


def _is_done(state: ir.State) -> bool:
    """Return True if every region of a parallel state can be done."""
    return state.kind is StateKind.PARALLEL and all(
        any(inner.kind is StateKind.FINAL for inner in region.states) for region in state.states
    )


def _disagrees(state: ir.State) -> bool:
    """Return True if regions may take conflicting transitions on one event."""
    heard: list[set[str]] = []
    leads_out = False
    for region in state.states if state.kind is StateKind.PARALLEL else ():
        heard.append(set())
        for inner in region.walk():
            for transition in inner.transitions:
                heard[-1] |= {t.event for t in transition.triggers if isinstance(t, EventTrigger)}
                target = transition.target
                leads_out |= target is not None and not target.startswith(f"{state.id}.")
    events = [event for each in heard for event in each]
    return leads_out and len(events) > len(set(events))
