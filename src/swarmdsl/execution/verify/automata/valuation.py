"""Facts that hold for the machines of a robot at a line of its trace, as sets of bits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.execution import monitor
from swarmdsl.execution.simulate.evaluation.properties import claim_of, conditions
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.robot_kind import Kind
from swarmdsl.ir import Count, Fact


class Valuation:
    """Facts of a kind of robot that hold at a line, as the bits of their numbers."""

    def __init__(self, kind: Kind) -> None:
        self._has = conditions(self._data)
        self._facts = monitor.Facts()
        self._bits = [self._facts.bit(_plain(fact), None) for fact in kind.facts]
        self._momentary = sum(
            1 << number for number, bit in enumerate(self._bits) if bit & self._facts.momentary
        )
        self.gone = 1 << len(self._bits)
        """Fact of lost robots, behind the others."""
        self._kinds = {actor: self._facts.kind_of(actor) for actor in kind.cast}
        self._body: Body | None = None

    def at(self, line: Line, body: Body) -> tuple[int, int]:
        """Return the facts that hold for the machine of a line: lasting and momentary ones."""
        self._body = body
        holding = self._kinds[line.actor].holding(line, self._has)
        found = sum(1 << number for number, bit in enumerate(self._bits) if holding & bit)
        return found & ~self._momentary, found & self._momentary

    def _data(self, actor: Actor) -> Mapping[str, Any]:
        assert self._body is not None
        found: Mapping[str, Any] = self._body.instances[list(self._body.cast).index(actor)].data
        return found


def _plain(fact: Fact | Count) -> monitor.Fact | monitor.Count:
    claim = claim_of(fact)
    assert not isinstance(claim, monitor.Junction)
    return claim
