"""Catalogue of the shipped library as a page of Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from swarmdsl import ir
from swarmdsl.base import resources
from swarmdsl.driver import pipeline

PACKAGES = {
    "cpswarm": "the CPSwarm libraries as they are today",
    "cpswarm_uint32": "the same until 2020, when tasks and targets had numbers: those of D5.4",
    "nav2": "Nav2, the navigation of ROS 2: nav2_msgs 1.3.13 of Jazzy, of 2026-08-21",
    "turtlebot4": "the TurtleBot 4: irobot_create_msgs 2.1.0 of Humble, of 2022-09-15, for its "
    "Create 3 base, and turtlebot4_msgs 1.0.4 of Humble, of 2024-02-15",
    "crazyswarm2": "Crazyflies with Crazyswarm2: crazyflie_interfaces 1.0.5 of 2026-07-20, for "
    "Humble and Jazzy",
    "px4": "PX4 1.16 over XRCE-DDS: px4_msgs 2.0.1 of 2025-08-07; offboard control, commands and "
    "states",
    "mavros": "MAVROS for ROS 2: mavros_msgs 2.12.0 of 2025-09-14",
    "slam_toolbox": "slam_toolbox 2.6.8 of Humble, of 2024-01-23: services of its maps",
    "explore_lite": "explore_lite of ROS 2, of 2025-07-24: it hears a topic, and has no action",
    "sensors": "standard sensors of ROS: sensor_msgs, on the topics that most drivers use",
    "tf2": "frames and poses: tf2_msgs and geometry_msgs",
}


@cache
def systems() -> Mapping[str, ir.System]:
    """Compile all libraries."""
    found = {}
    for name in PACKAGES:
        system = pipeline.check([resources.library() / name]).system
        assert system is not None
        found[name] = system
    return found


def page() -> str:
    """Return the page: the manual introduction and the generated catalogue."""
    lines = [PLACE.read_text(encoding="utf-8").partition("\n## cpswarm\n")[0].rstrip(), ""]
    for name, system in systems().items():
        lines += [f"## {name}", "", f"{PACKAGES[name][:1].upper()}{PACKAGES[name][1:]}.", ""]
        for package in packages(name):
            lines += _section(package, system)
    return "\n".join(lines).rstrip("\n") + "\n"


def packages(name: str) -> list[str]:
    """Return the packages of a library in the order of its files."""
    order = ("functions", "behaviours", "events", "members", "nodes", "hardware", "costs")
    folder = resources.library() / name
    found = {path.stem for path in folder.iterdir()}
    known = [each for each in order if each in found]
    return [f"{name}.{each}" for each in (*known, *sorted(found - set(known)))]


def _section(package: str, system: ir.System) -> Iterator[str]:
    files = _files(package)
    yield from (f"### {package}", "")

    def here(items: tuple[object, ...]) -> list[object]:
        return [each for each in items if _file(each) in files]

    for items in _kinds(system):
        yield from _as_table(here(items))


def _kinds(system: ir.System) -> tuple[tuple[object, ...], ...]:
    return (
        *(system.functions, system.machines, system.events, system.members, system.components),
        *(system.fitness, system.environments, system.interfaces),
    )


def _files(package: str) -> set[str]:
    place = resources.library().joinpath(*package.split("."))
    return {str(path) for path in (*place.glob("*.swarm"), place.with_suffix(".swarm"))}


def _file(item: object) -> str:
    origin = getattr(item, "origin", None)
    return str(origin.source.name) if origin is not None else ""


def _as_table(items: list[object]) -> Iterator[str]:
    if not items:
        return
    rows = list(filter(None, map(_row, items)))
    if not rows:
        return
    heads = {ir.Function: ("function", "called as", "params", "model in space", "")}
    head = heads.get(type(items[0]), (_KINDS.get(type(items[0]), "interface"), "", ""))
    yield from (f"| {' | '.join(head)} |", f"|{'---|' * len(head)}")
    yield from (f"| {' | '.join(row)} |" for row in rows)
    yield ""


_KINDS: Mapping[type, str] = {
    ir.StateMachine: "machine",
    ir.Event: "event",
    ir.Member: "member",
    ir.Component: "component",
    ir.Fitness: "fitness",
    ir.Environment: "environment",
}


def _row(item: object) -> tuple[str, ...] | None:
    match item:
        case ir.Function(name=name, communication=call, params=params, model=model, doc=doc):
            called = f"{call.paradigm} `{call.name}`, `{call.type}`"
            in_space = f"`{model.name}`" if model is not None else ""
            return f"`{name}`", called, _params(params), in_space, _short(doc)
        case ir.StateMachine(name=name, params=params, doc=doc):
            return f"`{name}`", _params(params), _short(doc)
        case ir.Event(name=name, type=type_, doc=doc):
            return f"`{name}`", f"`{type_}`", _short(doc)
        case ir.Member(name=name, parts=parts, doc=doc):
            return f"`{name}`", ", ".join(f"`{part.name}`" for part in parts), _short(doc)
        case ir.Component(name=name, params=params, doc=doc):
            return f"`{name}`", _params(params), _short(doc)
        case ir.Fitness(name=name, doc=doc) | ir.Environment(name=name, doc=doc):
            return f"`{name}`", "", _short(doc)
        case ir.Message(type=type_, doc=doc):
            return f"`{type_}`", "message", _short(doc)
        case ir.Service(type=type_, doc=doc):
            # Those of operations belong to the components that have them.
            return (f"`{type_}`", "service", _short(doc)) if item.external else None
        case ir.Action(type=type_, doc=doc):
            return f"`{type_}`", "action", _short(doc)
    return None


def _params(params: tuple[ir.Param, ...]) -> str:
    return ", ".join(f"`{param.name}`" for param in params)


def _short(doc: str) -> str:
    return re.sub(r"\s+", " ", doc)


PLACE = Path(__file__).resolve().parents[2] / "docs" / "library.md"
