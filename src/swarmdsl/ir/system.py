"""The whole model, as generators see it."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.architecture import Component, Environment, Member, Swarm
from swarmdsl.ir.derived import DERIVED
from swarmdsl.ir.interfaces import Action, Event, Field, Function, Interface, Message
from swarmdsl.ir.optimization import Fitness, Optimization
from swarmdsl.ir.statemachine import StateMachine
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.types import Named


@dataclass(frozen=True, slots=True)
class System:
    """All declarations, in the order of the files and of the text in them.

    `name` is the package of the first file, or its file name if it has none. `standard` are
    the interfaces of ROS that the model uses and does not describe, with those in their fields;
    `ros_packages` the packages of ROS among those that the model mentions.
    """

    name: str
    interfaces: tuple[Interface, ...] = ()
    events: tuple[Event, ...] = ()
    functions: tuple[Function, ...] = ()
    components: tuple[Component, ...] = ()
    members: tuple[Member, ...] = ()
    machines: tuple[StateMachine, ...] = ()
    environments: tuple[Environment, ...] = ()
    swarms: tuple[Swarm, ...] = ()
    fitness: tuple[Fitness, ...] = ()
    optimizations: tuple[Optimization, ...] = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    standard: tuple[Interface, ...] = field(default=(), compare=False, metadata=DERIVED)
    ros_packages: tuple[str, ...] = field(default=(), compare=False, metadata=DERIVED)

    def event(self, name: str) -> Event:
        """Return the event of that name."""
        return next(event for event in self.events if event.name == name)

    def function(self, name: str) -> Function:
        """Return the function of that name."""
        return next(function for function in self.functions if function.name == name)

    def interface(self, type_: object) -> Interface | None:
        """Return the interface as the model describes it, or None."""
        found = next((known for known in self.interfaces if known.type == type_), None)
        if found is None and isinstance(type_, Named):
            return _message_of_action(type_, self.interfaces)
        return found

    def known_interface(self, type_: object, kind: type[Interface] = Message) -> Interface | None:
        """Return the interface as the model describes it, else as ROS does.

        If ROS has several of one name (`nav_msgs/GetMap`), that of class `kind` is preferred.
        """
        described = self.interface(type_)
        if described is not None:
            return described
        found = [known for known in self.standard if known.type == type_]
        if not found and isinstance(type_, Named):
            return _message_of_action(type_, self.standard)
        found.sort(key=lambda known: not isinstance(known, kind))
        return found[0] if found else None


def _message_of_action(type_: Named, known: tuple[Interface, ...]) -> Message | None:
    """Return the message that ROS generates from one of the known actions."""
    for generated in generated_from(type_):
        for action in known:
            if isinstance(action, Action) and action.type == generated.action:
                parts = {"goal": action.goal, "result": action.result, "feedback": action.feedback}
                wrapped = tuple(Field(name, inside) for name, inside in generated.fields)
                return Message(type_, wrapped or parts[generated.part], action.external)
    return None
