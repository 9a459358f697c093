"""Checks of the structure of state machines: initial states, regions, histories, choices."""

from __future__ import annotations

from swarmdsl.analysis.checks.conjunctions import negate, satisfiable
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import condition_of
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.resolve.states import all_resolved, content, regions
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import (
    Activity,
    Choice,
    Container,
    FinalState,
    History,
    NameUse,
    Parallel,
    Param,
    Ref,
    Region,
    State,
    StateMachine,
    nodes_of,
)


def check_structure(machine: StateMachine, context: Context) -> None:
    """Check a machine and all its states."""
    if not machine.endless and not completes(machine, context):
        context.report.report(
            "missing-final",
            machine.name.span,
            owner=f"state machine `{machine.name}`",
            help=Advice(
                "add `final Done`, or write `endless statemachine` if it never ends",
                "end machine",
                "final Done",
            ),
        )
    hierarchy = context.hierarchy(machine)
    _check_initial(machine, f"state machine `{machine.name}`", hierarchy, context)
    for region in nodes_of(machine, Region):
        _check_initial(region, f"region `{region.name}`", hierarchy, context)
    for parallel in nodes_of(machine, Parallel):
        if not regions(parallel):
            context.report.report(
                "too-few-regions",
                parallel.name.span,
                name=parallel.name,
                help=Advice(
                    "add `region Name { ... }`; a state without regions is a plain `state`",
                    "make plain",
                ),
            )
    for state in nodes_of(machine, State):
        _check_state(state, hierarchy, context)
    for choice in nodes_of(machine, Choice):
        _check_choice(choice, context)
    _check_levels(hierarchy, context)


def _check_state(state: State, hierarchy: StateHierarchy, context: Context) -> None:
    activities = [item for item in state.items if isinstance(item, Activity)]
    context.check_single([item.span for item in activities], "the activity")
    contents = []
    if state.machine is not None:
        contents.append("the content of another machine")
    if hierarchy.children[state]:
        contents.append("states of its own")
        if state.machine is None:
            _check_initial(state, f"composite state `{state.name}`", hierarchy, context)
    else:
        for initial in hierarchy.initials[state]:
            context.report.report(
                "mixed-content",
                initial.span,
                state=state.name,
                content="an initial state and no states",
                help=Advice("add the states, or remove this line", "remove initial"),
            )
    if activities:
        contents.append("an activity")
    if len(contents) > 1:
        context.report.report(
            "mixed-content",
            state.name.span,
            state=state.name,
            content=" and ".join(contents),
            help="keep one of them; put the rest into a state of its own",
        )
    if state.machine is not None and state.machine.target is not None:
        _check_reuse(state, state.machine.target, context)


def _check_levels(hierarchy: StateHierarchy, context: Context) -> None:
    """Check that internal transitions lead inwards and histories have states to restore."""
    for history in nodes_of(hierarchy.machine, History):
        if hierarchy.parent[history] is hierarchy.machine:
            context.report.report(
                "misplaced-history",
                history.name.span,
                name=history.name,
                fault="is outside of any composite state",
                help="put it into the state that it leads back into",
            )
    for state, transitions in hierarchy.transitions.items():
        for item in transitions:
            target = item.target.target if item.target is not None else None
            if item.target is None or target is None or not item.internal:
                continue
            if state not in hierarchy.ancestors(target):
                context.report.report(
                    "misplaced-internal",
                    item.target.span,
                    state=state.name,
                    target=target.name,
                    help=Advice(
                        "its target is inside its source, or it has no target", "make external"
                    ),
                )


def _check_reuse(state: State, machine: StateMachine, context: Context) -> None:
    """Check that the params of a submachine are given or have a default."""
    assert state.machine is not None
    params = {str(item.name): item for item in machine.items if isinstance(item, Param)}
    context.check_repeated((binding.name for binding in state.bindings), "param")
    given = {str(binding.name) for binding in state.bindings}
    for binding in state.bindings:
        param = params.get(str(binding.name))
        if param is None:
            owner = f"state machine `{machine.name}`"
            context.report_unknown_param(binding.name, owner, params)
        else:
            context.expect(binding.value, param.type.type, context.typing)
    _check_foreign_params(state.machine, machine, context)
    for param in params.values():
        if param.default is None and str(param.name) not in given:
            context.report.report(
                "missing-value",
                state.machine.span,
                name=param.name,
                machine=machine.name,
                related=(Label(param.name.span, "declared here, without a default"),),
                help=Advice(
                    f"bind it: `{state.machine.name}({param.name} = ...)`", "bind", param.name.span
                ),
            )


def _check_foreign_params(ref: Ref[StateMachine], machine: StateMachine, context: Context) -> None:
    """Check that a submachine reads no param of a member, which it cannot see."""
    own = {item for item in machine.items if isinstance(item, Param)}
    for use in nodes_of(machine, NameUse):
        if isinstance(use.target, Param) and use.target not in own:
            context.report.report(
                "missing-value",
                ref.span,
                name=use.name,
                machine=machine.name,
                related=(Label(use.span, "this is a param of a member"),),
                help=f"declare `param {use.name}` in `{machine.name}` and bind it here",
            )
            return


def _check_initial(
    container: Container, owner: str, hierarchy: StateHierarchy, context: Context
) -> None:
    found = hierarchy.initials[container]
    if not found:
        # Prefer a state over a pseudostate; a history has nothing to restore at first.
        states = [
            state for state in hierarchy.children[container] if not isinstance(state, History)
        ]
        inside = sorted(states, key=lambda state: not isinstance(state, (State, Parallel)))
        context.report.report(
            "missing-initial",
            container.name.span,
            owner=owner,
            help=Advice(
                f"add `initial {inside[0].name}`, for instance",
                "add initial",
                f"initial {inside[0].name}",
            )
            if inside
            else Advice(
                "add a state, and `initial` with its name",
                "add initial",
                "initial First",
                "state First",
            ),
        )
    context.check_single([item.span for item in found], "the initial state")


def _check_choice(choice: Choice, context: Context) -> None:
    """Check that a choice has `else` or guards of which one always holds."""
    conditions = [condition_of(branch, context) for branch in choice.branches]
    otherwise = any(branch.otherwise for branch in choice.branches)
    if not otherwise and satisfiable(*map(negate, conditions)):
        context.report.report(
            "choice-without-else",
            choice.name.span,
            name=choice.name,
            help=Advice("add `else -> ...`", "add else"),
        )


def completes(state: Container, context: Context) -> bool:
    """Return True if a state can complete: it, or each of its regions, has a final state.

    Also return True for unresolved targets and unparsed text, which may be final states.
    """
    return context.analysis(_completes, state)


def _completes(state: Container, context: Context) -> bool:
    if isinstance(state, Parallel):
        return all(completes(region, context) for region in regions(state))
    inside = content(state)
    if inside is None or inside in context.incomplete:
        return True
    final = any(isinstance(item, FinalState) for item in inside.items)
    return final or not all_resolved(inside)
