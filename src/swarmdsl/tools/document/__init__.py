"""`swarmc doc`: all about a model on one page.

The declarations of a model become `elements` with anchors; `names` says what their text names.
`architecture`, `behaviour`, `interfaces` and `overview` say what there is to say of them as
plain data (`page`), which `html` writes.
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
from swarmdsl.tools.document.book import Book
from swarmdsl.tools.document.elements import Element, Elements, Places
from swarmdsl.tools.document.html import html
from swarmdsl.tools.document.names import Names
from swarmdsl.tools.document.page import Entry, Page, Section, Table
from swarmdsl.tools.document.pictures import pictures
from swarmdsl.tools.document.traffic import traffic

_Kind = TypeVar("_Kind", ir.Function, ir.Event)
_Maker = Callable[[Element, Book], Entry]
_COMPONENTS = ("sensor", "actuator", "controller", "virtual component")
_SECTIONS: tuple[tuple[str, str, tuple[str, ...], _Maker], ...] = (
    ("section-swarms", "Swarms", ("swarm",), architecture.swarm),
    ("section-members", "Members", ("member",), architecture.member),
    ("section-machines", "State machines", ("state machine",), behaviour.machine),
    ("section-components", "Components", _COMPONENTS, architecture.component),
    ("section-functions", "Functions", ("function",), interfaces.function),
    ("section-events", "Events", ("event", "swarm event"), interfaces.event),
    ("section-messages", "Messages", ("message", "struct"), interfaces.interface),
    ("section-services", "Services", ("service",), interfaces.interface),
    ("section-actions", "Actions", ("action",), interfaces.interface),
    ("section-enums", "Enums", ("enum",), interfaces.enum),
    ("section-constants", "Constants", ("constant",), interfaces.constant),
    ("section-types", "Types", ("type",), interfaces.alias),
    ("section-environments", "Environments", ("environment",), architecture.environment),
    ("section-fitness", "Fitness", ("fitness",), architecture.fitness),
    ("section-optimizations", "Optimizations", ("optimization",), architecture.optimization),
)
_TABLES: dict[str, Callable[[Book], Table]] = {
    "section-functions": interfaces.functions_table,
    "section-events": overview.events_matrix,
}


def document(
    project: Project, name: str | None = None, *, libraries: bool = False
) -> tuple[str, str]:
    """The name of a valid model and the page about it, as HTML.

    Of libraries it has what the model uses, or with `libraries` all that they declare.
    """
    pairs = _of_libraries_too(project) if libraries else used_declarations(project)
    system = lower(project, name, pairs)
    elements = Elements([*pairs, *project.optimizations()])
    book = Book(
        system,
        elements,
        Names(project, elements),
        Places(project.files),
        traffic(system, elements),
        pictures(system, elements),
        _by_element(system.functions, elements),
        _by_element(system.events, elements),
    )
    anchors = {element.path: anchor for anchor, element in reversed(elements.anchors.items())}
    return system.name, html(_page(book), anchors)


def _by_element(found: Iterable[_Kind], elements: Elements) -> dict[Element, list[_Kind]]:
    """Functions or events by what they are declared as; an operation is a function of each part."""
    by_element: dict[Element, list[_Kind]] = {}
    for each in found:
        element = elements.at(each.origin)
        if element is not None:
            by_element.setdefault(element, []).append(each)
    return by_element


def _of_libraries_too(project: Project) -> list[tuple[File, Declaration]]:
    """All declarations, but for what a library retells of interfaces that the project has."""
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


def _page(book: Book) -> Page:
    sections = []
    for id_, title, kinds, make in _SECTIONS:
        found = [each for each in book.elements.tops if each.kind in kinds]
        table = _TABLES[id_](book) if id_ in _TABLES else None
        if table is not None and not table.rows:
            table = None
        if found or table:
            kept = table.without_empty_columns() if table is not None else None
            sections.append(Section(id_, title, tuple(make(each, book) for each in found), kept))
    system: ir.System = book.system
    return Page(system.name, system.doc, (overview.packages(book),), tuple(sections))
