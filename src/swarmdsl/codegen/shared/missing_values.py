"""Params without a value in the model, which has to be given before a robot starts."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen.shared.nodes import behavior_nodes
from swarmdsl.ir import Role, Swarm, System

_HEAD = """\
## Values to give

These params have no value in the model: write it into the parameter file of the role or robot.

| swarm | role | node | param | type |
|---|---|---|---|---|
"""


def missing_values(system: System) -> str:
    """Return the section of a README about params without a value; empty if there is none."""
    rows = [
        row for swarm in system.swarms for role in swarm.roles for row in _rows(swarm, role, system)
    ]
    return _HEAD + "".join(rows) if rows else ""


def _rows(swarm: Swarm, role: Role, system: System) -> Iterator[str]:
    # A check holds that a param with a value for one robot has a value for all.
    own = {name for robot in role.robots for name, _ in robot.values}
    member = system.members_by_name[role.member]
    for node in behavior_nodes(role.configured(member), system):
        for given in node.params:
            param = given.param
            if given.expression is None and param.name not in own:
                cells = (swarm.name, role.name, node.name, f"`{param.name}`", f"`{param.type}`")
                yield f"| {' | '.join(cells)} |\n"
