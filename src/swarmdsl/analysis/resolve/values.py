"""Resolve names of values in expressions.

A name means a value of the declaration itself, or a constant or an enum that the file sees.
Those are named like types: `Mode`, `sar.Mode`, or by an alias.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl.analysis.resolve.report_unresolved import resolve_or_report
from swarmdsl.analysis.resolve.report_unresolved_values import (
    dotted,
    report_type_as_value,
    report_value,
)
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import regions, variables_of, vertices
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Address,
    AliasType,
    Call,
    Constant,
    Construction,
    Container,
    Elapsed,
    Element,
    EnumType,
    Expression,
    ExpressionTree,
    Field,
    FieldUse,
    FitnessInput,
    IndexUse,
    InState,
    NameUse,
    OperatorUse,
    Parallel,
    Param,
    Query,
    Region,
    RoleUse,
    State,
    StateMachine,
    TopLevel,
    Variable,
    invalidate,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import Named

Values = Mapping[str, Variable | Param | FitnessInput | Element | Field]
# Unresolved names, each with the fields after it.
Missing = list[tuple[NameUse, list[FieldUse]]]

_DECLARED: tuple[type[Constant | EnumType | AliasType], ...] = (Constant, EnumType, AliasType)


@dataclass(frozen=True)
class ValueLinker:
    """Binds the names in expressions of one file; `enums` are those of all files."""

    scope: FileScope
    enums: Mapping[Named, EnumType]
    report: Diagnostics

    def link(self, owner: TopLevel, values: Values) -> None:
        """Bind the names in the expressions of a declaration with these values."""
        self.link_only(nodes_of(owner, Expression), owner, values)

    def link_only(
        self,
        nodes: Iterable[Expression],
        owner: TopLevel,
        values: Values,
        machines: Iterable[StateMachine] = (),
    ) -> None:
        """Bind the names in some expressions of a declaration with these values.

        `machines` are what the expressions are about, if they are in no machine.
        """
        unknown: list[tuple[NameUse, list[FieldUse], Expression]] = []
        inside: dict[Expression, Values] = {}
        if isinstance(owner, StateMachine):
            _add_values_inside(owner, values, inside)
        shared = _values_of_all(owner)
        stateless = _values_without_states(owner)
        addresses = {each.id: each for each in nodes_of(owner, Address)}
        for node in nodes:
            if shared is None or node in shared:
                self._check_no_self(node)
            if stateless is None or node in stateless:
                self._check_no_state(node)
            if node.tree is not None:
                missing: Missing = []
                seen = inside.get(node, values)
                node.tree = self._linked(node.tree, owner, seen, missing)
                # The name of a role is an address by itself; the swarm that has it checks it.
                role = addresses[node].role_use if node in addresses else None
                unknown += [(base, fields, node) for base, fields in missing if base is not role]
        machines = (owner,) if isinstance(owner, StateMachine) else machines
        # Hints for a name depend on the names beside it, which are bound now.
        for base, fields, node in unknown:
            seen = inside.get(node, values)
            report_value(
                base, fields, node, owner, seen, machines, _DECLARED, self.scope, self.report
            )

    def _check_no_self(self, expression: Expression) -> None:
        """Report `self` in a value that is the same for all robots."""
        for use in walk(expression) if expression.tree is not None else ():
            if isinstance(use, NameUse) and use.name == "self":
                self.report.report(
                    "no-self",
                    use.span,
                    help="use it in an expression of a state machine, such as a guard, an "
                    "argument, or the initial value of a variable",
                )

    def _check_no_state(self, expression: Expression) -> None:
        """Report a test or time of a state in a value that is computed without active states."""
        for test in walk(expression) if expression.tree is not None else ():
            if isinstance(test, (InState, Elapsed)):
                self.report.report(
                    "no-active-state",
                    test.span,
                    help="use it in a guard, an effect, a delay or an argument of a state machine",
                )

    def _linked(
        self, tree: ExpressionTree, owner: TopLevel, values: Values, missing: Missing
    ) -> ExpressionTree:
        """Return the tree with qualified names (`sar.Mode`) merged into one node."""
        match tree:
            case NameUse() | FieldUse():
                return self._path(tree, owner, values, missing)
            case OperatorUse(operands=operands):
                tree.operands = tuple(
                    [self._linked(each, owner, values, missing) for each in operands]
                )
            case Call(function="present", arguments=arguments):
                # What is no name of a role is reported as a whole.
                tree.arguments = tuple(
                    RoleUse(each.span, each.name)
                    if isinstance(each, NameUse)
                    else self._linked(each, owner, values, [])
                    for each in arguments
                )
                invalidate(owner)
            case Call(arguments=arguments):
                tree.arguments = tuple(
                    [self._linked(each, owner, values, missing) for each in arguments]
                )
            case IndexUse(base=array, index=index):
                tree.base = self._linked(array, owner, values, missing)
                tree.index = self._linked(index, owner, values, missing)
            case Query(element=element, condition=condition, key=key):
                element.array = self._linked(element.array, owner, values, missing)
                inside = {**values, str(element.name): element}
                if condition is not None:
                    tree.condition = self._linked(condition, owner, inside, missing)
                if key is not None:
                    tree.key = self._linked(key, owner, inside, missing)
            case Construction(values=given):
                for each in given:
                    each.value = self._linked(each.value, owner, values, missing)
        return tree

    def _path(
        self, tree: NameUse | FieldUse, owner: TopLevel, values: Values, missing: Missing
    ) -> ExpressionTree:
        fields: list[FieldUse] = []
        base: ExpressionTree = tree
        while isinstance(base, FieldUse):
            fields.insert(0, base)
            base = base.base
        if not isinstance(base, NameUse):
            fields[0].base = self._linked(base, owner, values, missing)
            return tree
        if base.name in values:
            base.target = values[base.name]
        elif not base.is_predefined:
            names = [base.name]
            names += [dotted(base.name, fields[: n + 1]) for n in range(len(fields))]
            length = next((n for n, name in enumerate(names) if self._means_value(name)), None)
            if length is None:
                missing.append((base, fields))
                return tree
            used = base
            if length:
                used = NameUse(fields[length - 1].span, names[length])
                invalidate(owner)
            used.target = self._declared(used.name, used.span)
            if length == len(fields):
                return used
            fields[length].base = used
        return tree

    def _means_value(self, name: str) -> bool:
        return any(isinstance(node, _DECLARED) for _, node in self.scope.find(name))

    def _declared(self, name: str, at: Span) -> Constant | EnumType | None:
        """Resolve a constant or an enum; report a failure and return None."""
        found = resolve_or_report(self.scope, name, at, _DECLARED, self.report)
        if not isinstance(found, AliasType):
            return found
        type_ = found.type.type
        enum = self.enums.get(type_) if isinstance(type_, Named) else None
        if enum is None and type_ is not None:
            report_type_as_value(name, at, type_, self.report)
        return enum


def _add_values_inside(
    container: Container, values: Values, inside: dict[Expression, Values]
) -> None:
    """Add the values that each expression sees in a container whose states have variables."""
    own = {str(each.name): each for each in reversed(variables_of(container))}
    if own and not isinstance(container, StateMachine):
        values = {**values, **own}
        for node in walk(container):
            if isinstance(node, Expression):
                inside[node] = values
    for each in (*vertices(container), *regions(container)):
        if isinstance(each, (State, Parallel, Region)):
            _add_values_inside(each, values, inside)


def _values_of_all(owner: TopLevel) -> set[Expression] | None:
    """Return the expressions of a machine without a robot: defaults of params; else None."""
    if not isinstance(owner, StateMachine):
        return None
    items = (item for item in owner.items if isinstance(item, Param))
    return {item.default for item in items if item.default is not None}


def _values_without_states(owner: TopLevel) -> set[Expression] | None:
    """Return the expressions about states where none is active; None if all would be."""
    if not nodes_of(owner, InState) and not nodes_of(owner, Elapsed):
        return set()
    if not isinstance(owner, StateMachine):
        return None
    values = [each.default for each in nodes_of(owner, Param)]
    values += [each.initial for each in nodes_of(owner, Variable)]
    values += [each.value for state in nodes_of(owner, State) for each in state.bindings]
    return {each for each in values if each is not None}
