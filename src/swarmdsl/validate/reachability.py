"""Which states a machine can ever be in."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.diagnostics import Label
from swarmdsl.link_machines import all_resolved, regions, vertices
from swarmdsl.scopes import bare, kind_of
from swarmdsl.syntax import (
    Choice,
    Container,
    DoneTrigger,
    FinalState,
    History,
    Initial,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
    walk,
)
from swarmdsl.validate.context import Context


def check_reachability(machine: StateMachine, context: Context) -> None:
    """Report states that no way from the initial state leads to.

    Guards and triggers are taken to be possible. Of states inside each other that are not
    reached only the outermost is reported. What is wrong already is not reported again: in a
    container without initial state any may be the first, of two states with one name only one
    can be meant, and where a name was not resolved it may have meant any state.
    """
    if not all_resolved(machine):
        return
    around: dict[Vertex | Region, Container] = {}
    _collect(machine, around)
    reached: set[Vertex | Region] = set()
    work = _initials(machine)
    while work:
        state = work.pop()
        if state in reached:
            continue
        reached.add(state)
        work += _successors(state)
        outer = around[state]
        if not isinstance(outer, StateMachine):
            work.append(outer)  # to be in a state is to be in those around it
    _report(machine, reached, machine, context)


def _collect(container: Container, around: dict[Vertex | Region, Container]) -> None:
    for inside in (*vertices(container), *regions(container)):
        around[inside] = container
        if isinstance(inside, (State, Parallel, Region)):
            _collect(inside, around)


def _initials(container: Container) -> list[Vertex | Region]:
    initials = [item for item in container.items if isinstance(item, Initial)]
    if not initials:
        return list(vertices(container))
    return [item.target.target for item in initials if item.target.target is not None]


def _successors(state: Vertex | Region) -> list[Vertex | Region]:
    """What a state leads to: its regions, its initial state, its transitions' targets."""
    found: list[Vertex | Region] = [*regions(state)]
    if isinstance(state, (State, Region)):
        found += _initials(state)
    arrows = [
        *(state.branches if isinstance(state, Choice) else ()),
        *([state] if isinstance(state, History) else ()),
        *(
            item
            for item in (state.items if isinstance(state, (State, Parallel)) else ())
            if isinstance(item, Transition)
        ),
    ]
    targets = [arrow.target.target for arrow in arrows if arrow.target is not None]
    return found + [target for target in targets if target is not None]


def _waiting(
    final: Vertex, container: Container, reached: set[Vertex | Region], machine: StateMachine
) -> Iterator[DoneTrigger]:
    """The triggers that wait for a final state, which is not reached, in vain.

    A parallel state waits for each of its regions, each for any of its final states.
    """
    if not isinstance(final, FinalState):
        return
    ends = [state for state in vertices(container) if isinstance(state, FinalState)]
    for owner in walk(machine):
        if not isinstance(owner, (State, Parallel)) or owner not in reached:
            continue
        for transition in owner.items:
            for trigger in transition.triggers if isinstance(transition, Transition) else ():
                if not isinstance(trigger, DoneTrigger):
                    continue
                of = trigger.region.target if trigger.region is not None else owner
                if trigger.final is not None:
                    if trigger.final.target is final:
                        yield trigger
                elif (of is container or (container in regions(owner) and of is owner)) and not any(
                    end in reached for end in ends
                ):
                    yield trigger


def _report(
    container: Container, reached: set[Vertex | Region], machine: StateMachine, context: Context
) -> None:
    for region in regions(container):
        _report(region, reached, machine, context)
    names = set()
    for state in vertices(container):
        if state in reached:
            if isinstance(state, (State, Parallel)):
                _report(state, reached, machine, context)
        elif state.name not in names:
            waiting = _waiting(state, container, reached, machine)
            context.report.report(
                "unreachable-state",
                state.name.span,
                kind=bare(kind_of(state)),
                name=state.name,
                related=tuple(Label(trigger.span, "so this never happens") for trigger in waiting),
            )
        names.add(state.name)
