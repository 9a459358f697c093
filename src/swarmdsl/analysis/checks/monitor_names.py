"""Check the names that monitored topics are given."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.names import RESERVED_EVENTS
from swarmdsl.analysis.event_topics import received_topic
from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Event, MonitorTrigger, StateMachine, Word, nodes_of


def check_monitor_names(project: Project, context: Context) -> None:
    """Check that a topic has one name, and that nothing else is called so."""
    declared = {str(node.name): node for _, node in context.used}
    events = {received_topic(node): node for _, node in context.used if isinstance(node, Event)}
    by_topic: dict[str, Word] = {}
    by_name: dict[str, MonitorTrigger] = {}
    for _, machine in context.used:
        if not isinstance(machine, StateMachine):
            continue
        for monitor in nodes_of(machine, MonitorTrigger):
            name, topic = monitor.name, received_topic(monitor)
            if name is None:
                continue
            event, first = events.get(topic), by_topic.setdefault(topic, name)
            other = by_name.setdefault(str(name), monitor)
            if event is not None:
                if str(event.name) != name:
                    label = Label(event.name.span, "an event on this topic")
                    _report(
                        monitor,
                        name,
                        label,
                        Advice(
                            f"leave it out, or write `{event.name}`", "propose", str(event.name)
                        ),
                        context,
                    )
            elif first != name:
                label = Label(first.span, "another monitor of the topic names it here")
                _report(
                    monitor,
                    name,
                    label,
                    Advice(f"leave it out, or write `{first}`", "propose", str(first)),
                    context,
                )
            elif str(name) in declared:
                node = declared[str(name)]
                label = Label(node.name.span, f"this is the name of {kind_of(node)}")
                _report(monitor, name, label, "choose a name that nothing else has", context)
            elif received_topic(other) != topic:
                label = Label(other.span, f"topic `{other.topic}` is called so")
                _report(monitor, name, label, "choose a name that nothing else has", context)
            elif name in RESERVED_EVENTS:
                context.report.report(
                    "reserved-event-name",
                    name.span,
                    name=name,
                    help="SCXML reserves it for its own errors",
                )


def _report(
    monitor: MonitorTrigger, name: Word, label: Label, help_: str, context: Context
) -> None:
    context.report.report(
        "monitor-name",
        name.span,
        topic=monitor.topic,
        name=name,
        related=(label,),
        help=help_,
    )
