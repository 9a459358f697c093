"""Names of robots and roles: in addresses, in `present`, and in strings.

A string is the name of a robot or role where an address, or a comparison with `self.id` and the
like, makes it one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.analysis.resolve.addresses import Crew, crews_of, named_roles, swarms_of
from swarmdsl.analysis.resolve.identity_tests import IdentityTest, identity_tests
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Address,
    ExpressionTree,
    Fitness,
    Property,
    Role,
    RoleUse,
    StateMachine,
    TopLevel,
    Value,
    nodes_of,
)

_ROBOT = re.compile(r"(.*)\[(0|[1-9]\d{0,17})\]", re.DOTALL)


@dataclass(frozen=True)
class Comparison(IdentityTest):
    """Test with a string."""

    value: Value


def robot_named(name: str) -> tuple[str, int | None]:
    """Return the role and the number in the id of a robot, `"uav[2]"`; the name of a role alone."""
    found = _ROBOT.fullmatch(name)
    return (found[1], int(found[2])) if found is not None else (name, None)


def is_about(owner: TopLevel, crew: Crew) -> bool:
    """Return True for a machine that a swarm runs, a property or a fitness about either."""
    subject = owner.about if isinstance(owner, (Property, Fitness)) else owner
    return subject is crew.swarm or subject in crew.machines


def comparisons(owner: TopLevel) -> Iterator[Comparison]:
    """Yield the comparisons of robots and roles with strings."""
    for test in identity_tests(owner):
        if isinstance(test.value, Value) and isinstance(test.value.value, str):
            yield Comparison(test.fact, test.value, test.of_role, test.triggers, test.around)


def role_uses(owner: TopLevel, project: Project) -> Iterator[tuple[Span, Role]]:
    """Yield the places in values that name a role, in each swarm that they are about."""
    strings = [(text, robot_named(str(text.value))[0]) for text in _strings(owner)]
    places = [(use.span, str(use.name)) for use in nodes_of(owner, RoleUse)]
    places += [(_inside(text.span, len(name)), name) for text, name in strings]
    if not places and not nodes_of(owner, Address):
        return
    crews = crews_of(swarms_of(project))
    for named in named_roles(owner, crews) if isinstance(owner, StateMachine) else ():
        if named.role is not None:
            yield named.span, named.role
    for crew in crews:
        for span, name in places if is_about(owner, crew) else ():
            # A string with escapes has another text.
            if name in crew.roles and span.text == name:
                yield span, crew.roles[name]


def _inside(quoted: Span, length: int) -> Span:
    """Return the place of the first characters of a string."""
    return Span(quoted.source, quoted.start + 1, quoted.start + 1 + length)


def _strings(owner: TopLevel) -> Iterator[Value]:
    ids: list[ExpressionTree | None] = [each.id.tree for each in nodes_of(owner, Address)]
    for tree in ids:
        if isinstance(tree, Value) and isinstance(tree.value, str):
            yield tree
    yield from (each.value for each in comparisons(owner))
