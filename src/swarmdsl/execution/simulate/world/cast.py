"""Cast of a world: the running machines, by robot, by event and by instance."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from swarmdsl.execution.engine import Instance, InstanceLike, Servers
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.scenario import Robot


class Cast:
    """Actors with the instances of their machines; `make` makes the first one of each."""

    def __init__(self, actors: Iterable[Actor], make: Callable[[Actor, Servers], Instance]) -> None:
        self.instances: dict[Actor, Instance] = {}
        self.actors: dict[InstanceLike, Actor] = {}
        """Actor of each instance, also of those that have been replaced."""
        self._of_robots: dict[str | None, list[Actor]] = {}
        self._listeners: dict[tuple[str, str | None], list[Actor]] = {}
        self._one: Instance | None = None
        """An instance that was running when somebody asked."""
        servers: dict[Robot, Servers] = {}
        for actor in actors:
            self._of_robots.setdefault(actor.robot.name, []).append(actor)
            instance = make(actor, servers.setdefault(actor.robot, Servers()))
            self.instances[actor] = instance
            self.actors[instance] = actor
        self.robots = list(servers)

    def of(self, robot: Robot) -> list[Actor]:
        """Return the machines of a robot."""
        return self._of_robots.get(robot.name, [])

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that react to an event."""
        found = self._listeners.get((event, robot.name))
        if found is None:
            found = [actor for actor in self.of(robot) if actor.listens(event)]
            self._listeners[event, robot.name] = found
        return found

    def replace(self, actor: Actor, instance: Instance) -> None:
        """Let another instance be that of an actor."""
        self.instances[actor] = instance
        self.actors[instance] = actor

    @property
    def is_running(self) -> bool:
        """True if any machine is running."""
        if self._one is None or not self._one.running:
            running = (instance for instance in self.instances.values() if instance.running)
            self._one = next(running, None)
        return self._one is not None

    def waits(self, actor: Actor, event: str) -> bool:
        """Return True if an active state of a machine reacts to an event, or keeps it."""
        instance, machine = self.instances[actor], actor.machine
        if not instance.running or not actor.listens(event):
            return False
        numbers = [machine.numbers[state] for state in instance.configuration.innermost]
        around = {each for number in numbers for each in (number, *machine.ancestors(number))}
        return any(
            any(edge.matches(event) for edge in machine.edges[number])
            or event in machine.states[number].deferred
            for number in around
        )
