"""Checks of activities: arguments for goals and requests, stored results."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.called_interface import called_interface
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import guard_value
from swarmdsl.analysis.types import Typing, assignable, of_field, report_unknown_field
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    Argument,
    Communication,
    Field,
    Operation,
    OutcomeTrigger,
    Parameter,
    ResultMapping,
    ServiceType,
    State,
    StateMachine,
    Transition,
    Word,
    nodes_of,
)


def check_activities(machine: StateMachine, context: Context) -> None:
    """Check each activity against the interface of its action, service or operation."""
    users: dict[str, Activity] = {}
    for activity in nodes_of(machine, Activity):
        _check_activity(activity, context)
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None:
                _check_callback(callback, activity, users, context)
    if context.report.wants("endless-retry"):
        for state in nodes_of(machine, State):
            _check_retry(state, context)


def _check_activity(activity: Activity, context: Context) -> None:
    context.check_repeated((argument.name for argument in activity.arguments), "field")
    context.check_repeated((result.field for result in activity.results), "field")
    function = activity.function.target
    if isinstance(function, Operation):
        _check_operation(activity, function, context)
        return
    call = (
        next((item for item in function.items if isinstance(item, Communication)), None)
        if function is not None
        else None
    )
    known = called_interface(function, context.interfaces)
    sent: list[Field] | None = None
    received: list[Field] | None = None
    words = ("", "")
    if known in context.incomplete:
        known = None
    match known:
        case ActionType():
            sent, received, words = known.goal, known.result, ("goal", "result")
        case ServiceType():
            sent, received, words = known.request, known.response, ("request", "response")
    name = f"`{call.type.span.text}`" if call else ""
    if activity.goal_callback is None:
        owner = f"the {words[0]} of {name}"
        if check_arguments(activity.arguments, sent, owner, context.typing):
            _check_missing(activity, sent, owner, context)
    for result in activity.results:
        _check_result(result, received, f"the {words[1]} of {name}", context)


def _check_operation(activity: Activity, operation: Operation, context: Context) -> None:
    """Check arguments against the `in` and results against the `out` parameters."""
    owner = f"operation `{operation.name}`"
    taken = [p for p in operation.parameters if p.direction != "out"]
    given = [p for p in operation.parameters if p.direction == "out"]
    if activity.goal_callback is None and check_arguments(
        activity.arguments, taken, owner, context.typing
    ):
        _check_missing(activity, taken, owner, context)
    for result in activity.results:
        _check_result(result, given, owner, context)


def check_arguments(
    arguments: list[Argument],
    fields: Sequence[Field | Parameter] | None,
    owner: str,
    typing: Typing,
) -> bool:
    """Check arguments against fields; return True if all the fields exist.

    `fields` is None if they are unknown.
    """
    exist = True
    for argument in arguments:
        expected = None
        if fields is not None:
            field = next((known for known in fields if known.name == argument.name), None)
            if field is None:
                exist = False
                names = [str(known.name) for known in fields]
                report_unknown_field(owner, argument.name, argument.name.span, names, typing.report)
            else:
                expected = of_field(field.type.type)
        typing.expect(argument.value.tree, expected)
    return exist


def _check_missing(
    activity: Activity,
    fields: Sequence[Field | Parameter] | None,
    owner: str,
    context: Context,
) -> None:
    given = {str(argument.name) for argument in activity.arguments}
    missing = [field for field in fields or () if field.name not in given]
    if missing:
        names = [str(field.name) for field in missing]
        values = ", ".join(f"{name} = ..." for name in names)
        context.report.report(
            "missing-field",
            activity.function.span,
            owner=owner,
            fields=listed(names, "and"),
            related=tuple(Label(field.name.span, "declared here") for field in missing),
            help=Advice(
                f"add `{values}`", "add arguments", *(field.name.span for field in missing)
            ),
        )


def _check_result(
    result: ResultMapping, fields: Sequence[Field | Parameter] | None, owner: str, context: Context
) -> None:
    tree = result.target.tree
    if tree is not None and not assignable(tree):
        context.report.report(
            "not-assignable",
            result.target.span,
            text=result.target.span.text,
            help="a result is stored in a variable, or in a field of one",
        )
        return
    found = next((field for field in fields or () if field.name == result.field), None)
    if found is None and fields is not None:
        names = [str(field.name) for field in fields]
        report_unknown_field(owner, result.field, result.field.span, names, context.report)
    if tree is None or found is None:
        return
    expected = context.typing.infer(tree)
    context.check_fits(of_field(found.type.type), expected, result.span)


def _check_callback(
    callback: Word, activity: Activity, users: dict[str, Activity], context: Context
) -> None:
    """Check that all functions of one callback have the same type of goal."""
    first = users.setdefault(str(callback), activity)
    if first.function.target is not activity.function.target:
        context.report.report(
            "shared-callback",
            callback.span,
            name=callback,
            related=(Label(first.function.span, "already used for this function"),),
            help="each function needs a callback of its own: goals and results differ in type",
        )


def _check_retry(state: State, context: Context) -> None:
    """Report a state that is entered again whenever its activity is aborted."""
    activity = next((item for item in state.items if isinstance(item, Activity)), None)
    if activity is None:
        return
    for transition in state.items:
        if not isinstance(transition, Transition) or transition.target is None:
            continue
        for trigger in transition.triggers:
            if (
                isinstance(trigger, OutcomeTrigger)
                and trigger.outcome == "aborted"
                and transition.target.target is state
                and guard_value(transition, context) is True
            ):
                context.report.report(
                    "endless-retry",
                    trigger.span,
                    state=state.name,
                    function=activity.function.span.text,
                    related=(Label(transition.target.span, "back to the same state"),),
                    help="lead through a state with a delay, or limit the attempts with a guard",
                )
