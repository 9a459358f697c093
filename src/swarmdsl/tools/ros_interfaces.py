"""Compare the ROS interfaces of a model with what is installed and with what runs."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import exists
from swarmdsl.base.records import dataclass
from swarmdsl.importing.ros import import_ros
from swarmdsl.importing.ros_graph import PARTS, Graph
from swarmdsl.ir import Interface, Named, System
from swarmdsl.project.rosidl.installed import PREFIXES, installed_package


@dataclass(frozen=True)
class Compared:
    """An interface or a server of the model; `fault` is empty if it is as in the model."""

    name: str
    place: str
    fault: str = ""


def compare_installed(system: System) -> Iterator[Compared]:
    """Compare each interface of functions and events with the installed package."""
    types = [each.communication.type for each in system.functions]
    types += [each.type for each in system.events if isinstance(each.type, Named)]
    packages: dict[str, dict[Named, Interface]] = {}
    for type_ in sorted(dict.fromkeys(types), key=str):
        folder = installed_package(type_.package)
        if folder is None:
            fault = f"package {type_.package} is not installed"
            if PREFIXES not in os.environ:
                fault = f"ROS 2 is not sourced: {PREFIXES} is not set"
            yield Compared(str(type_), "", fault)
            continue
        if type_.package not in packages:
            read, _ = import_ros([folder], "", {}, Diagnostics())
            packages[type_.package] = {each.type: each for each in read.interfaces}
        installed = packages[type_.package].get(type_)
        ours = system.interface(type_)
        # Interfaces of ROS itself are the same in all distributions, and are not compared.
        if installed is not None and ours is not None:
            yield Compared(str(type_), str(folder), "; ".join(_differences(ours, installed)))
        elif ours is None and _has(folder, type_.name):
            yield Compared(str(type_), str(folder))
        else:
            yield Compared(str(type_), str(folder), f"{folder} does not have it")


def _has(folder: Path, name: str) -> bool:
    """Return True if a folder of a package has an interface of a name."""
    return any(exists(folder / kind / f"{name}.{kind}") for kind in ("msg", "srv", "action"))


def _differences(ours: Interface, installed: Interface) -> Iterator[str]:
    if type(ours) is not type(installed):
        yield f"it is {_kind(installed)}, but {_kind(ours)} in the model"
        return
    for part in PARTS:
        own = {each.name: str(each.type) for each in getattr(ours, part, ())}
        there = {each.name: str(each.type) for each in getattr(installed, part, ())}
        where = "" if part == "fields" else f" of its {part}"
        for name in sorted(own.keys() - there.keys()):
            yield f"it has no field `{name}`{where}"
        for name in sorted(there.keys() - own.keys()):
            yield f"field `{name}`{where} is missing in the model"
        for name in sorted(own.keys() & there.keys()):
            if own[name] != there[name]:
                yield f"field `{name}`{where} is {there[name]}, but {own[name]} in the model"


def _kind(interface: Interface) -> str:
    name = type(interface).__name__.lower()
    return f"an {name}" if name[0] in "aeiou" else f"a {name}"


def compare_running(system: System, graph: Graph) -> Iterator[Compared]:
    """Compare the servers of functions, and the topics of events, with those that run.

    Those of each robot are in its namespace. A topic that no node has is no fault.
    """
    for function in system.functions:
        call = function.communication
        servers = graph.actions if call.paradigm == "action" else graph.services
        found = list(_called(call.name, servers))
        if not found:
            yield Compared(call.name, "", f"no {call.paradigm} server runs")
        yield from (_typed(call.name, place, call.type, type_) for place, type_ in found)
    for event in system.events:
        if isinstance(event.type, Named) and not event.predefined:
            for place, type_ in _called(event.topic, graph.every_topic):
                yield _typed(event.topic, place, event.type, type_)


def _called(name: str, running: tuple[tuple[str, Named], ...]) -> Iterator[tuple[str, Named]]:
    end = f"/{name.lstrip('/')}"
    for full, type_ in running:
        if full == end or (not name.startswith("/") and full.endswith(end)):
            yield full, type_


def _typed(name: str, place: str, ours: Named, running: Named) -> Compared:
    same = str(ours).lower() == str(running).lower()
    return Compared(name, place, "" if same else f"{place} is {running}, but {ours} in the model")


def as_text(title: str, compared: list[Compared]) -> Iterator[str]:
    """Yield a line for each interface, server or topic, below a title; one if there are none."""
    width = max((len(each.name) for each in compared), default=0)
    yield title
    if not compared:
        yield "  nothing is compared: none of those that the model names were found"
    for each in compared:
        yield f"  {'--' if each.fault else 'ok'}  {each.name:<{width}}  {each.fault or each.place}"
