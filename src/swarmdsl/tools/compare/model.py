"""A model as an element."""

from __future__ import annotations

from swarmdsl.ir import System
from swarmdsl.tools.compare.architecture import component_elements, member_elements
from swarmdsl.tools.compare.behaviour import declared_names, machine_element
from swarmdsl.tools.compare.composition import (
    environment_element,
    fitness_element,
    optimization_element,
    swarm_element,
)
from swarmdsl.tools.compare.elements import Element, with_doc, with_names
from swarmdsl.tools.compare.interfaces import event_element, function_element, interface_element
from swarmdsl.tools.compare.sentences import property_element


def model_element(system: System) -> Element:
    """Tree of all declarations of a model, without library elements."""
    children = (
        *(interface_element(each) for each in system.interfaces),
        *(event_element(each) for each in system.events if not each.predefined),
        *(function_element(each) for each in system.functions if not each.in_library),
        *component_elements(system),
        *member_elements(system),
        *(machine_element(each, system) for each in system.machines),
        *(environment_element(each) for each in system.environments),
        *(fitness_element(each, system) for each in system.fitness),
        *(swarm_element(each) for each in system.swarms),
        *(optimization_element(each) for each in system.optimizations),
        *(property_element(each, system) for each in system.properties),
    )
    root = Element("model", (system.name,), (), children, origin=system.origin)
    return with_doc(with_names(root, declared_names(system.machines)), system.doc)
