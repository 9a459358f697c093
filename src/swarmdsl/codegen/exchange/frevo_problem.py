"""Problem description for FREVO: `IComponent.dtd` of FREVO 1."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.base.xml_writer import legal
from swarmdsl.codegen.exchange.search_space import number
from swarmdsl.codegen.xml_tree import document
from swarmdsl.ir import Environment, Optimization, Swarm, System

_DOCTYPE = '<!DOCTYPE icomponent SYSTEM "../IComponent.dtd">'


def problem(
    optimization: Optimization,
    swarm: Swarm,
    system: System,
    parameters: int,
    places: Mapping[str, str],
    report: Diagnostics,
) -> str:
    """Return the file; `parameters` counts those varied, `places` are properties."""
    package = swarm.name.lower()
    root = etree.Element("icomponent")
    config = etree.SubElement(root, "config")
    _add(config, "entry", "classdir", f"{swarm.name}/{package}")
    _add(config, "entry", "classname", f"{package}.{swarm.name}")
    _add(config, "entry", "name", swarm.name)
    _add(config, "entry", "description", swarm.doc)
    properties = etree.SubElement(root, "properties")
    environment = next((e for e in system.environments if e.name == swarm.environment), None)
    if environment is not None:
        _add_environment(properties, environment, report)
    steps = dict(optimization.settings).get("steps")
    if steps is not None:
        _add(properties, "propentry", "steps", int(number(steps)))
    _add(properties, "propentry", "swarmMembers", _members(swarm, optimization, report))
    for name, place in places.items():
        _add(properties, "propentry", name, place)
    requirements = etree.SubElement(root, "requirements")
    _add(requirements, "reqentry", "inputnumber", 0)
    _add(requirements, "reqentry", "outputnumber", parameters)
    _add(requirements, "reqentry", "minimumCandidates", 1)
    _add(requirements, "reqentry", "maximumCandidates", 1)
    declaration, rest = document(root).split("\n", 1)
    return f"{declaration}\n{_DOCTYPE}\n{rest}"


def _add_environment(
    properties: etree._Element, environment: Environment, report: Diagnostics
) -> None:
    if environment.world is not None:
        _add(properties, "propentry", "environment", environment.world)
    if environment.size is not None:
        note = "a problem names a world, which defines its own size"
        _report(f"the size of environment `{environment.name}`", environment.origin, report, note)


def _members(swarm: Swarm, optimization: Optimization, report: Diagnostics) -> int:
    """Return the number of members; the least, with a report, if it is open."""
    counted = {count.role for count in optimization.counts}
    total = 0
    for role in swarm.roles:
        least = max(role.multiplicity.lower, 1)
        total += least
        if role.multiplicity.upper != role.multiplicity.lower and role.name not in counted:
            note = f"a problem has one number of members: {least} are counted"
            _report(f"multiplicity `{role.multiplicity}`", role.origin, report, note)
    return total


def _add(parent: etree._Element, tag: str, key: str, value: str | int) -> None:
    kind = "INT" if isinstance(value, int) else "STRING"
    etree.SubElement(parent, tag, {"key": key, "type": kind, "value": legal(str(value))})


def _report(what: str, at: Span | None, report: Diagnostics, note: str) -> None:
    report.report("no-place", at, target="frevo", what=what, notes=(note,))
