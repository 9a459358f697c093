"""Values of parts that depend on params which a role or a robot sets."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.shared.nodes import has_node
from swarmdsl.ir import Member, ParamRef, Role, System, subexpressions


def check_part_values(
    role: Role, member: Member, system: System, target: str, report: Diagnostics
) -> None:
    """Report params of components' nodes that a role or a robot changes.

    Such nodes are started by the type of member.
    """
    components = {component.name: component for component in system.components}
    for values in (role.values, *(robot.values for robot in role.robots)):
        given = dict(values)
        for part in member.parts:
            if not has_node(components[part.component]):
                continue
            for name, value in part.values:
                used = {e.name for e in subexpressions(value) if isinstance(e, ParamRef)}
                for param in sorted(used & given.keys()):
                    report.report(
                        "no-place",
                        given[param].origin,
                        target=target,
                        what=f"param `{name}` of part `{part.name}` for this value of `{param}`",
                        notes=("the nodes of components have the values of their member",),
                        help="give it in the file with the parameters of the robot",
                    )
