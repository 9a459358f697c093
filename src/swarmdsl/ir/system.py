"""The whole model, ready for generators."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.architecture import Component, Environment, Member, Swarm
from swarmdsl.ir.interfaces import Action, Event, Field, Function, Interface, Message
from swarmdsl.ir.optimization import Fitness, Optimization
from swarmdsl.ir.statemachine import StateMachine
from swarmdsl.syntax.action_messages import ways_made
from swarmdsl.syntax.types import Named


@dataclass(frozen=True, slots=True)
class System:
    """Everything that was declared, in the order of the files and of the text in them.

    `name` is the package of the first file, or its file name where it has none.
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

    def event(self, name: str) -> Event:
        """The event of that name."""
        return next(event for event in self.events if event.name == name)

    def function(self, name: str) -> Function:
        """The function of that name."""
        return next(function for function in self.functions if function.name == name)

    def interface(self, type_: object) -> Interface | None:
        """What is known of an interface's fields; None for one the model does not describe."""
        found = next((known for known in self.interfaces if known.type == type_), None)
        if found is None and isinstance(type_, Named):
            return self._made_of_action(type_)
        return found

    def _made_of_action(self, type_: Named) -> Message | None:
        """The message of that name that ROS makes of an action."""
        for made in ways_made(type_):
            for action in self.interfaces:
                if isinstance(action, Action) and action.type == made.action:
                    parts = {
                        "goal": action.goal,
                        "result": action.result,
                        "feedback": action.feedback,
                    }
                    around = tuple(Field(name, inside) for name, inside in made.fields)
                    return Message(type_, around or parts[made.part], action.external)
        return None
