"""Concurrences: states that run together until one of them decides."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from .module import PREEMPTED, Container, Entry, Module, fresh
from .python import Call, Source, layout
from .routes import Branch, Content, Route
from .statements import STEP


def concurrence(
    module: Module,
    slot: int,
    function: str,
    doc: str,
    members: Mapping[str, Content],
    places: Mapping[str, str],
    default: list[Branch] | None = None,
    keywords: Iterable[tuple[str, object]] = (),
) -> Content:
    """A Concurrence that ends with the first outcome that leads somewhere.

    When all members are complete otherwise, it ends with `done`, which leads to `default`.
    """
    routes: dict[str, Route] = {}
    deciding: dict[str, dict[str, str]] = {}
    entries = []
    for label, member in members.items():
        for outcome, route in member.routes.items():
            taken = {*routes, "done", PREEMPTED}
            name = fresh(outcome, taken)
            if name != outcome:
                name = fresh(f"{label}_{outcome}", taken)
            routes[name] = route
            deciding[name] = {label: outcome}
        add = Call("Concurrence.add", (label, member.call))
        comments = (places[label],) if places.get(label) else ()
        entries.append(Entry(label, layout(add, 2, STEP * 2), comments))
    keywords = [*keywords]
    if default is not None:
        routes["done"] = default
        keywords.append(("default_outcome", "done"))
    class_ = module.own("containers", "Concurrence")
    arguments = ([*routes, PREEMPTED], deciding, Source("userdata"))
    module.containers[slot] = Container(
        function=function,
        doc=doc,
        variable="concurrence",
        construction=layout(Call(class_, arguments, tuple(keywords)), 1, f"{STEP}concurrence = "),
        entries=tuple(entries),
    )
    return Content(built_by(function), routes)


def built_by(function: str) -> Call:
    """The container that a function of the module builds."""
    return Call(function, (Source("userdata"),))
