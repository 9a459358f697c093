"""A crowd of robots in Mesa: agents that call each other at each step."""

from __future__ import annotations

from typing import Any


def heard(talkers: int, listeners: int, seconds: int) -> int:
    """Let the talkers broadcast each second; return the number of events that were heard."""
    import mesa

    class Listener(mesa.Agent):  # type: ignore[misc]
        def __init__(self, model: Any) -> None:
            super().__init__(model)
            self.heard = 0

        def hear(self) -> None:
            self.heard += 1

    class Talker(Listener):
        def talk(self) -> None:
            for other in self.model.agents:
                if other is not self:
                    other.hear()

    model = mesa.Model(seed=0)
    Talker.create_agents(model, talkers)
    Listener.create_agents(model, listeners)
    for _ in range(seconds):
        model.agents_by_type[Talker].do("talk")
    return sum(each.heard for each in model.agents)
