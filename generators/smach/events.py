"""Events as constants of the module `events`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl.codegen import Diagnostics, dataclass
from swarmdsl.codegen.python import Call, Source, comments, layout
from swarmdsl.ir import Event, Message, Named, StateMachine, System

from . import package
from .imports import Imports
from .module import TARGET


@dataclass(frozen=True)
class EventView:
    """An event as a constant of the module `events`."""

    statement: str
    comments: tuple[str, ...]


def checked_events(
    system: System, machines: list[StateMachine], report: Diagnostics
) -> list[Event]:
    """Return the events that the machines use."""
    events = [system.event(name) for name in package.used_events(machines)]
    for event in events:
        if not isinstance(event.type, Named):
            report.report(
                "unsupported-construct",
                event.origin,
                target=TARGET,
                construct=f"an event with data of type `{event.type}`, which is not a message",
            )
        _check_delivery(event, report)
    return events


def _check_delivery(event: Event, report: Diagnostics) -> None:
    """Report the settings that topics of ROS 1 do not have."""
    for setting in ("lifespan", "deadline"):
        if event.delivery is not None and getattr(event.delivery, setting) is not None:
            report.report(
                "unsupported-construct",
                event.delivery.origin,
                target=TARGET,
                construct=f"the {setting} of event `{event.name}`",
                help="leave it out, or build for ROS 2: `--option smach.ros=2`",
            )


def event_views(
    events: Iterable[Event],
    around: Mapping[str, Message],
    constants: dict[str, str],
    imports: Imports,
) -> tuple[EventView, ...]:
    """Return the constants of events; those in `around` have an envelope."""
    found = []
    for event in events:
        assert isinstance(event.type, Named)
        message = Source(imports.interface(event.type, "msg"))
        keywords: list[tuple[str, object]] = []
        if event.name in around:
            interface = imports.interface(around[event.name].type, "msg")
            keywords.append(("envelope", Source(interface)))
        if event.delivery is not None and event.delivery.latest:
            keywords.append(("latch", True))
        if event.delivery is not None and event.delivery.keep is not None:
            keywords.append(("queue_size", event.delivery.keep))
        call = Call(
            imports.name(f"{imports.types.package}.topics", "Event"),
            (event.name, message, event.incoming_topic, event.topic),
            tuple(keywords),
        )
        statement = layout(call, 0, f"{constants[event.name]} = ")
        found.append(EventView(statement, comments(event.origin, event.doc)))
    return tuple(found)
