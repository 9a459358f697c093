"""What lowering needs everywhere: names in the system, types of expressions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, cast

from swarmdsl import ir
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.inference import Typing
from swarmdsl.link_types import interface_name
from swarmdsl.load import Project
from swarmdsl.syntax import (
    BehaviorUse,
    Declaration,
    Member,
    MessageType,
    Param,
    Ref,
    StateMachine,
    StructType,
    TypeRef,
    Variable,
)


@dataclass(frozen=True)
class Context:
    """Passed through lowering.

    `names` gives each declaration its name in the system: its own, with the package
    before it where two packages use the same. `behaving` are the members by machine.
    In a machine that another one reuses, `variables` and `values` say what its variables
    are called there and which values its params have.
    """

    names: Mapping[Declaration, str]
    typing: Typing
    behaving: Mapping[StateMachine, list[Member]]
    variables: Mapping[Variable, str] = field(default_factory=dict)
    values: Mapping[Param, ir.Expression] = field(default_factory=dict)

    def name(self, ref: Ref[Any]) -> str:
        """The name of what a resolved reference means."""
        return self.names[cast("Declaration", ref.target)]

    def reusing(
        self, variables: Mapping[Variable, str], values: Mapping[Param, ir.Expression]
    ) -> Context:
        """The same inside a reused machine."""
        return replace(self, variables=variables, values=values)

    def with_event(self, type_: ir.Type) -> Context:
        """The same, where `event` is a message of that type."""
        return replace(self, typing=replace(self.typing, has_event=True, event=type_))


def make_context(project: Project) -> Context:
    """Name everything and gather what the project says about types and behaviours."""
    pairs = list(project.declarations())
    count = Counter(str(declaration.name) for _, declaration in pairs)
    names: dict[Declaration, str] = {}
    behaving: dict[StateMachine, list[Member]] = {}
    fields = {}
    for file, declaration in pairs:
        name = str(declaration.name)
        if count[name] > 1:
            name = f"{file.package.replace('.', '_')}_{name}"
            while name in count:
                name += "_"
            count[name] += 1
        names[declaration] = name
        if isinstance(declaration, (StructType, MessageType)):
            fields[interface_name(file, declaration.name)] = declaration.fields
        if isinstance(declaration, Member):
            for item in declaration.items:
                if isinstance(item, BehaviorUse) and item.machine.target is not None:
                    behaving.setdefault(item.machine.target, []).append(declaration)
    return Context(names, Typing(fields, Diagnostics()), behaving)


def type_of(ref: TypeRef) -> ir.Type:
    """The type a resolved type reference means."""
    assert ref.type is not None
    return ref.type
