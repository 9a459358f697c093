"""Expressions of the language that are read while a machine runs: watches, conditions, values."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cached_property
from typing import Any

from swarmdsl import ir
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.linker import Linker
from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.analysis.types import Typing
from swarmdsl.analysis.usage import used_declarations
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.engine.world import FAILURES
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import ACTIVE, ELAPSED, Value, function_of
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.ide.debugger.messages import RequestError
from swarmdsl.lowering.context import Context, make_context
from swarmdsl.lowering.expressions import lower_expression
from swarmdsl.lowering.machines import inside
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import Container, Parallel, Region, State, StateMachine
from swarmdsl.syntax.ast import Event as EventDeclaration
from swarmdsl.syntax.parser.expressions import parse_alone
from swarmdsl.syntax.parser.generated import LANGUAGE

_Compiled = tuple[Value, "ir.Type | None"]


@dataclass(frozen=True)
class Result:
    """Value of an expression, with its type if that is known."""

    value: Any
    type: ir.Type | None


class Expressions:
    """Compiles expressions for the machines of a subject, each once for a set of active states."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
        self._known: dict[tuple[str, str, str, str], _Compiled] = {}

    def value(
        self, text: str, actor: Actor, instance: Instance, event: Event | None, state: str
    ) -> Result:
        """Return the value of an expression in a state of a machine.

        The machine has processed an event last. Raises RequestError if it is none, or has no value.
        """
        name = actor.machine.name
        data: Mapping[str, Any] = instance.data if isinstance(instance.data, Mapping) else {}
        if text in data and text.isidentifier():
            return Result(data[text], self._types(name).get(text))
        last = event.name if event is not None else ""
        function, type_ = self._compiled(text, name, state, last)
        values = {
            **actor.params,
            **data,
            ACTIVE: instance.active,
            ELAPSED: instance.elapsed,
        }
        try:
            return Result(function(values, event), type_)
        except FAILURES as error:
            raise RequestError(f"it has no value: {error}") from error
        except KeyError as error:
            raise RequestError(f"it has no value in this run: {error}") from error

    def check(self, text: str, machine: str, state: str) -> ir.Type | None:
        """Return the type of an expression in a state of a machine, if it is known.

        It may use the data of any event. Raises RequestError for a text that is no expression.
        """
        try:
            return self._compiled(text, machine, state, "")[1]
        except RequestError as error:
            fault = error
        if self._scope is not None and re.search(r"\bevent\b", text):
            for event in self._scope.events:
                with suppress(RequestError):
                    return self._compiled(text, machine, state, event)[1]
        raise fault

    def _types(self, machine: str) -> Mapping[str, ir.Type]:
        lowered = self._lowered.get(machine)
        if lowered is None:
            return {}
        types = {each.name: each.type for each in lowered.params}
        return {**types, **{each.name: each.type for each in lowered.variables}}

    @cached_property
    def _lowered(self) -> Mapping[str, ir.StateMachine]:
        system = self._subject.system
        return system.machines_by_name if system is not None else {}

    def _compiled(self, text: str, machine: str, state: str, event: str) -> _Compiled:
        key = (text, machine, state, event)
        if key not in self._known:
            self._known[key] = self._compile(*key)
        return self._known[key]

    def _compile(self, text: str, machine: str, state: str, event: str) -> _Compiled:
        found = self._scope.machines.get(machine) if self._scope is not None else None
        if found is None or self._scope is None:
            raise RequestError("expressions need a model: this machine is an SCXML document")
        file, node = found
        report = Diagnostics()
        around = _around(node, state)
        expression = parse_alone(LANGUAGE, Source("expression", text), report)
        if expression is not None:
            self._scope.linker.link_expression(expression, around, file, report)
        typing = Typing(self._scope.interfaces, report)
        declared = self._scope.events.get(event)
        if declared is not None:
            typing = typing.on_event(declared.type.type, of_swarm=declared.swarm)
        if expression is None or expression.tree is None or report.has_errors:
            hint = "; `==` compares" if re.search(r"[^=!<>]=[^=]", text) else ""
            raise RequestError(f"{_first(report)}{hint}")
        typing.infer(expression.tree)
        if report.has_errors:
            raise RequestError(_first(report))
        context = inside(node, self._lowered[machine], self._scope.context)
        lowered = lower_expression(expression, replace(context, typing=typing))
        return function_of(lowered), getattr(lowered, "type", None)

    @cached_property
    def _scope(self) -> _Scope | None:
        project = self._subject.project
        return _Scope(project) if project is not None else None


class _Scope:
    """Names of a project, made when the first expression is read."""

    def __init__(self, project: Project) -> None:
        declared = list(project.declarations())
        self.linker = Linker(project, Scopes(project))
        self.linker.gather(node for _, node in declared)
        self.interfaces = Interfaces(declared)
        self.context: Context = make_context(project, used_declarations(project))
        names = self.context.names
        self.machines: dict[str, tuple[File, StateMachine]] = {
            names[node]: (file, node)
            for file, node in declared
            if isinstance(node, StateMachine) and node in names
        }
        self.events: dict[str, EventDeclaration] = {
            names[node]: node
            for _, node in declared
            if isinstance(node, EventDeclaration) and node in names
        }


def _around(machine: StateMachine, state: str) -> list[Container]:
    """Return the containers of a state, with itself, from the machine on.

    They end where a state reuses another machine.
    """
    around: list[Container] = [machine]
    for name in state.split(".") if state else ():
        inner = around[-1]
        places = [*vertices(inner), *(each for each in inner.items if isinstance(each, Region))]
        found = next((each for each in places if str(each.name) == name), None)
        if not isinstance(found, (State, Parallel, Region)):
            break
        around.append(found)
    return around


def _first(report: Diagnostics) -> str:
    found = next(iter(report))
    label = found.primary.message if found.primary is not None else ""
    parts = (found.message, label, found.help)
    return "; ".join(part for part in parts if part)


Evaluate = Callable[[str, int], Result]
"""Evaluates an expression for a member of the cast; raises RequestError."""
