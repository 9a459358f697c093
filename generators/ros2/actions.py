"""Messages of actions, which models name as in ROS 1.

In ROS 2 they are inside the class of the action, and their topics are hidden: topic `fly/feedback`
of `uav_msgs/FlyActionFeedback` is `fly/_action/feedback`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.codegen import Diagnostics, Span
from swarmdsl.codegen.shared import expressions_of
from swarmdsl.ir import (
    Action,
    Assignment,
    Event,
    FieldAccess,
    Message,
    Named,
    State,
    StateMachine,
    System,
    subexpressions,
)

from .names import TARGET, type_name

_PARTS = {
    "Goal": "Goal",
    "Result": "Result",
    "Feedback": "Feedback",
    "ActionFeedback": "Impl.FeedbackMessage",
    # Services in ROS 2, to which no other node can subscribe.
    "ActionGoal": "Impl.SendGoalService",
    "ActionResult": "Impl.GetResultService",
}
_FEEDBACK = "ActionFeedback"
_IN_BOTH = "feedback"
_TOPIC = "/feedback"
_HIDDEN = "/_action/feedback"


def messages_of_actions(system: System) -> Mapping[Named, str]:
    """Return the messages of actions in Python, by their names in the model."""
    calls = (function.communication for function in system.functions)
    actions = {call.type for call in calls if call.paradigm == "action"}
    actions |= {each.type for each in system.interfaces if isinstance(each, Action)}
    described = {each.type for each in system.interfaces if isinstance(each, Message)}
    return {
        made: f"{action.package}.action.{type_name(action.name)}.{part}"
        for action in sorted(actions, key=str)
        for end, part in _PARTS.items()
        if (made := Named(action.package, action.name + end)) not in described
    }


def feedback_topic(event: Event, is_sent: bool, report: Diagnostics) -> str:
    """Return the topic of an event with a message of an action; only feedback is supported."""
    assert isinstance(event.type, Named)
    if is_sent or not event.type.name.endswith(_FEEDBACK):
        way = "sent" if is_sent else "heard"
        _unsupported(f"an event of `{event.type}` that is {way}", event, report)
    elif not event.topic.endswith(_TOPIC):
        _unsupported(
            f"`{event.type}` on a topic other than `<action>{_TOPIC}`, `{event.topic}`",
            event,
            report,
        )
    return f"{event.topic.removesuffix(_TOPIC)}{_HIDDEN}"


def check_feedback(machine: StateMachine, made: Mapping[Named, str], report: Diagnostics) -> None:
    """Report uses of the fields of feedback that only ROS 1 has: header and goal status."""
    kept = {each.name: each.type for each in machine.variables}
    for state in machine.walk():
        read = ((use.base.type, use.field, use.origin) for use in _fields_read(state))
        stored = ((kept.get(name), path[0], at) for name, path, at in _stored(state) if path)
        for owner, field, origin in (*read, *stored):
            if owner in made and str(owner).endswith(_FEEDBACK) and field != _IN_BOTH:
                report.report(
                    "unsupported-construct",
                    origin or state.origin,
                    target=TARGET,
                    construct=f"field `{field}` of `{owner}`",
                    help="in ROS 2, only field `feedback` of that message can be used",
                )


def _stored(state: State) -> Iterator[tuple[str, tuple[str, ...], Span | None]]:
    """Yield each assigned variable with the path of the field and its place in the model."""
    effects = [*state.entry, *state.exit, *(e for each in state.transitions for e in each.effects)]
    for effect in effects:
        if isinstance(effect, Assignment):
            yield effect.variable, effect.path, effect.origin
    if state.activity is not None:
        for result in state.activity.results:
            yield result.variable, result.path, result.origin


def _fields_read(state: State) -> Iterator[FieldAccess]:
    for value in expressions_of(state):
        yield from (part for part in subexpressions(value) if isinstance(part, FieldAccess))


def _unsupported(construct: str, event: Event, report: Diagnostics) -> None:
    report.report("unsupported-construct", event.origin, target=TARGET, construct=construct)
