"""Params of machines as ROS parameters, and the values that members give them."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen import Diagnostics
from swarmdsl.codegen.python import Call, Source
from swarmdsl.codegen.ros import parameter_value, with_parameters
from swarmdsl.codegen.shared import BehaviorNode, Value, constant, doc_with_unit, params_by_name
from swarmdsl.ir import Array, Literal, Param, Primitive, StateMachine

from .imports import Imports
from .names import TARGET


def parameters(
    machine: StateMachine, imports: Imports, report: Diagnostics
) -> list[tuple[Param, Call]]:
    """Return the declaration of each param of a machine."""
    found = []
    known = params_by_name(machine.params)
    for param in machine.params:
        element = param.type.element if isinstance(param.type, Array) else param.type
        if not isinstance(element, Primitive) or element.name == "time":
            _unsupported(f"a param of type `{param.type}`", param, report)
            continue
        arguments: list[object] = [param.name, _type(param, element)]
        default = param.default if param.default is not None else param.declared
        if default is not None:
            value = constant(default, known)
            if value is None:
                _unsupported("a param whose default is not constant", param, report)
            else:
                value = parameter_value(value, param.type, 2, default.origin, TARGET, report)
            named = default.name if isinstance(default, Literal) and element.enum else ""
            arguments.append(Source(imports.constants.name(named, repr(value))) if named else value)
        doc = " ".join(doc_with_unit(param.doc, param.type).split())
        keywords = (("doc", doc),) if doc else ()
        found.append((param, Call("Parameter", tuple(arguments), keywords)))
    return found


def given(node: BehaviorNode, report: Diagnostics) -> Mapping[str, Value]:
    """Return the values of params that are not those of their declarations."""
    return {
        each.param.name: each.value
        for each in with_parameters(node, 2, TARGET, report).params
        if each.value is not None and each.expression is not each.param.declared
    }


def _type(param: Param, element: Primitive) -> str:
    return f"{element.name}[]" if isinstance(param.type, Array) else element.name


def _unsupported(construct: str, param: Param, report: Diagnostics) -> None:
    report.report("unsupported-construct", param.origin, target=TARGET, construct=construct)
