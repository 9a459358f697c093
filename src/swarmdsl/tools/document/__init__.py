"""Documentation of a model as one HTML page: `swarmc doc`.

`elements` gives each declared element an anchor, and `names` resolves the names in its text.
`architecture`, `behaviour`, `interfaces` and `overview` build the entries as plain data (`page`),
and `html` renders them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

from swarmdsl import ir
from swarmdsl.analysis.resolve.interfaces import is_secondary_description, own_interfaces
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.analysis.usage import used_declarations
from swarmdsl.lowering import lower
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import Declaration, Interface
from swarmdsl.tools.document import architecture, behaviour, interfaces, overview
from swarmdsl.tools.document.elements import Element, Elements, SourceLocations
from swarmdsl.tools.document.entry_builder import EntryBuilder
from swarmdsl.tools.document.html import html
from swarmdsl.tools.document.names import NameResolver
from swarmdsl.tools.document.page import Entry, Page, Section, Table
from swarmdsl.tools.document.pictures import pictures
from swarmdsl.tools.document.traffic import collect_traffic

_Kind = TypeVar("_Kind", ir.Function, ir.Event)
_EntryFunction = Callable[[Element, EntryBuilder], Entry]
_COMPONENTS = ("sensor", "actuator", "controller", "virtual component")
_SECTIONS: tuple[tuple[str, str, tuple[str, ...], _EntryFunction], ...] = (
    ("section-swarms", "Swarms", ("swarm",), architecture.swarm),
    ("section-members", "Members", ("member",), architecture.member),
    ("section-machines", "State machines", ("state machine",), behaviour.machine),
    ("section-components", "Components", _COMPONENTS, architecture.component),
    ("section-functions", "Functions", ("function",), interfaces.function),
    ("section-events", "Events", ("event", "swarm event", "operator event"), interfaces.event),
    ("section-messages", "Messages", ("message", "struct"), interfaces.interface),
    ("section-services", "Services", ("service",), interfaces.interface),
    ("section-actions", "Actions", ("action",), interfaces.interface),
    ("section-enums", "Enums", ("enum",), interfaces.enum),
    ("section-constants", "Constants", ("constant",), interfaces.constant),
    ("section-types", "Types", ("type",), interfaces.alias),
    ("section-environments", "Environments", ("environment",), architecture.environment),
    ("section-fitness", "Fitness", ("fitness",), architecture.fitness),
    ("section-properties", "Properties", ("property",), architecture.property_),
    ("section-optimizations", "Optimizations", ("optimization",), architecture.optimization),
)
_TABLES: dict[str, Callable[[EntryBuilder], Table]] = {
    "section-functions": interfaces.functions_table,
    "section-events": overview.events_table,
}


def document(
    project: Project, name: str | None = None, *, libraries: bool = False
) -> tuple[str, str]:
    """Return the name of a valid model and its page as HTML.

    The page contains the library elements that the model uses; with `libraries`, all of them.
    """
    pairs = _with_libraries(project) if libraries else used_declarations(project)
    system = lower(project, name, pairs)
    elements = Elements([*pairs, *project.optimizations()])
    builder = EntryBuilder(
        system,
        elements,
        NameResolver(project, elements),
        SourceLocations(project.files),
        collect_traffic(system, elements),
        pictures(system, elements),
        _by_element(system.functions, elements),
        _by_element(system.events, elements),
    )
    anchors = {element.path: anchor for anchor, element in reversed(elements.anchors.items())}
    return system.name, html(_page(builder), anchors)


def _by_element(found: Iterable[_Kind], elements: Elements) -> dict[Element, list[_Kind]]:
    """Group functions or events by declaration.

    An operation has one function for each part of the component's type.
    """
    by_element: dict[Element, list[_Kind]] = {}
    for each in found:
        element = elements.at(each.origin)
        if element is not None:
            by_element.setdefault(element, []).append(each)
    return by_element


def _with_libraries(project: Project) -> list[tuple[File, Declaration]]:
    """All declarations, except library copies of interfaces that the project declares."""
    own = own_interfaces(project)
    return [
        (file, node)
        for file, node in project.declarations()
        if not (
            isinstance(node, Interface)
            and is_secondary_description(file)
            and interface_name(file, node.name) in own
        )
    ]


def _page(builder: EntryBuilder) -> Page:
    sections = []
    for id_, title, kinds, make_entry in _SECTIONS:
        found = [each for each in builder.elements.tops if each.kind in kinds]
        table = _TABLES[id_](builder) if id_ in _TABLES else None
        if table is not None and not table.rows:
            table = None
        if found or table:
            kept = table.without_empty_columns() if table is not None else None
            sections.append(
                Section(id_, title, tuple(make_entry(each, builder) for each in found), kept)
            )
    system: ir.System = builder.system
    return Page(system.name, system.doc, (overview.packages_table(builder),), tuple(sections))
