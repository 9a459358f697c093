"""Type inference and type checks of expressions.

An unknown type (a field of an unknown message, an unresolved name) is None and fits everywhere,
so that one mistake is reported once.
"""

from __future__ import annotations

from collections.abc import Collection

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.report_unresolved import report_missing
from swarmdsl.analysis.types.arrays import (
    is_unnamed_query,
    type_of_construction,
    type_of_item,
    type_of_query,
    type_of_unnamed_query,
)
from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.analysis.types.fitting import check_size, fits, range_of
from swarmdsl.analysis.types.operators import Application
from swarmdsl.analysis.types.positions import Position, position_of
from swarmdsl.analysis.types.unit_checks import check_value
from swarmdsl.analysis.types.unit_rules import (
    NUMBER_OF_SECONDS,
    has_dimension,
    literal_type,
    of_field,
)
from swarmdsl.analysis.types.unknown_fields import report_unknown_field
from swarmdsl.base.diagnostics.advice import Advice, only, write
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.ir.operations import SECOND
from swarmdsl.syntax.ast import (
    Call,
    Construction,
    Elapsed,
    Element,
    EnumType,
    ExpressionTree,
    Fact,
    Field,
    FieldUse,
    IndexUse,
    InState,
    NameUse,
    OperatorUse,
    Parameter,
    Query,
    RoleUse,
    Value,
    Word,
)
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    ENVELOPE_FIELDS,
    INT,
    MEMBER,
    SELF_FIELDS,
    Array,
    Named,
    Type,
    unit_of,
    with_unit,
    written,
)
from swarmdsl.syntax.units import UNITS


@dataclass(frozen=True)
class Typing:
    """Infers and checks types. `interfaces` give the fields of messages.

    `event` is the message type of the triggering event: None if it is unknown. `has_event` is
    False outside of transitions on events, `of_swarm` also if an event of the robot itself can
    trigger the transition. `folding` computes constant values. `event_help` says where `event` has
    a message, `sender_help` where it has a sender.
    """

    interfaces: Interfaces
    report: Diagnostics = field(default_factory=Diagnostics)
    has_event: bool = False
    event: Type | None = None
    folding: Folding = field(default_factory=Folding)
    of_swarm: bool = False
    event_help: str = "use it in a guard or effect of a transition on one event"
    sender_help: str = Advice(
        "declare the event with `swarm event` if other robots send it", "declare swarm events"
    )

    def on_event(self, type_: Type | None, *, known: bool = True, of_swarm: bool) -> Typing:
        """Return a typing with an event of this message type, if all events have the same one."""
        return Typing(self.interfaces, self.report, known, type_, self.folding, of_swarm)

    def in_fact(self, fact: Fact) -> Typing:
        """Return a typing for the condition of a fact; if an event happens, it has a message.

        Only the robot that hears it can ask who sent it, and when.
        """
        if fact.event is None:
            return replace(self, event_help="write it after an event: `hears Found [event.x > 3]`")
        event = fact.event.target
        of_swarm = event is None or event.swarm
        typing = self.on_event(
            event.type.type if event is not None else None,
            of_swarm=of_swarm and fact.act == "hears",
        )
        if not of_swarm or fact.act == "hears":
            return typing
        help_ = "write `hears`: an event from outside comes from no robot"
        if fact.act == "sends":
            help_ = "leave it out: the fact names the robot that sends the event"
        return replace(typing, sender_help=help_)

    def infer(self, tree: ExpressionTree) -> Type | None:
        """Return the type of an expression and report its errors."""
        match tree:
            case NameUse():
                return self._name(tree)
            case RoleUse():
                return None  # the swarm that runs the machine has it
            case Value(value=value, unit=unit):
                return literal_type(value, unit)
            case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
                return self._enum_value(enum, name)
            case FieldUse(base=NameUse(name="self"), name=name):
                return self._own(name)
            case FieldUse(base=NameUse(name="event"), name=name) if (
                self.has_event or self.of_swarm
            ) and name in ENVELOPE_FIELDS:
                return self._fact(name)
            case FieldUse(base=base, name=name):
                return self.field(self.infer(base), name, name.span, base)
            case IndexUse():
                return type_of_item(tree, self)
            case Query():
                return type_of_query(tree, self)
            case InState():
                return BOOL
            case Elapsed():
                return DURATION
            case Construction():
                return type_of_construction(tree, self)
            case Call() if is_unnamed_query(tree, self):
                return type_of_unnamed_query(tree, self)
            case OperatorUse(operands=operands) | Call(arguments=operands):
                return self._checked_result(tree, [self.infer(operand) for operand in operands])
        raise AssertionError(tree)

    def _name(self, use: NameUse) -> Type | None:
        """Type of a name."""
        if use.name == "event":
            if not self.has_event:
                self.report.report(
                    "no-event-data",
                    use.span,
                    help=self.event_help,
                )
                return None
            return self.event
        if use.name == "self":
            self.report.report(
                "bad-operand",
                use.span,
                operator="self",
                operands="its own: name one of its fields",
                help=write("self.id"),
            )
            return None
        target = use.target
        if isinstance(target, EnumType):
            self.report.report(
                "bad-operand",
                use.span,
                operator=use.span.text,
                operands="its own: name one of its values",
                help=write(f"{use.span.text}.{target.values[0].name}") if target.values else None,
            )
            return None
        if isinstance(target, Element):
            return self.element_type(target)
        if isinstance(target, Field):  # of a goal, in an argument of a model
            return of_field(target.type.type)
        return target.type.type if target is not None else None

    def quietly(self, tree: ExpressionTree) -> Type | None:
        """Return the type of an expression; report nothing."""
        return replace(self, report=Diagnostics()).infer(tree)

    def element_type(self, element: Element) -> Type | None:
        """Return the type of the items that a query goes through; report nothing."""
        array = self.quietly(element.array)
        return array.element if isinstance(array, Array) else None

    def result(self, tree: Call | OperatorUse, types: list[Type | None]) -> Type | None:
        """Return the type of an operation on operands of these types."""
        return Application(tree, types, self._enum_of, self.position, self.report).result()

    def position(self, type_: Type | None) -> Position | None:
        """Return the position in a message; None if there is none."""
        return position_of(type_, self.interfaces)

    def expect(self, tree: ExpressionTree | None, expected: Type | None) -> bool:
        """Report an expression that does not fit type `expected`; return True for a correct one.

        A duration fits a number in `s`: lowering converts it.
        """
        if tree is None:
            return True
        before = len(self.report)
        found = self.infer(tree)
        is_converted = False
        if found == DURATION and has_dimension(unit_of(expected)):
            found, is_converted = self._number_of_seconds(tree, expected), True
        if fits(found, expected):
            check_value(tree, found, expected, self.report)
            value = self.folding.value(tree)
            if value is not None and len(self.report) == before and not is_converted:
                check_size(tree, value, expected, self.report)
        else:
            from swarmdsl.analysis.types.hints import mismatch_hint

            self.report.report(
                "type-mismatch",
                tree.span,
                expected=f"`{written(expected)}`",
                found=f"`{written(found)}`",
                help=mismatch_hint(tree, found, expected, self.interfaces, self.infer),
            )
        return len(self.report) == before

    def _number_of_seconds(self, tree: ExpressionTree, expected: Type | None) -> Type:
        """Return the type of a duration as a number: an integer only if it is known and whole."""
        value = self.folding.value(tree)
        whole = range_of(expected) is not None and isinstance(value, int) and value % SECOND == 0
        return with_unit(INT, UNITS["s"]) if whole else NUMBER_OF_SECONDS

    def _checked_result(self, tree: Call | OperatorUse, types: list[Type | None]) -> Type | None:
        """Return the type of an operation; report one that never has a result."""
        before = len(self.report)
        type_ = self.result(tree, types)
        if len(self.report) > before:
            return type_
        fault = self.folding.undefined(tree, duration=type_ == DURATION)
        if fault is not None:
            operator = tree.function if isinstance(tree, Call) else tree.operator
            self.report.report("no-result", tree.span, operator=operator, fault=fault)
        return type_

    def field(
        self, owner: Type | None, name: str, at: Span, base: ExpressionTree | None = None
    ) -> Type | None:
        """Return the type of a field of a message, `base`; report a missing field."""
        if isinstance(owner, Named):
            facts = self.of_swarm and isinstance(base, NameUse) and base.name == "event"
            found = self._field(owner, name, at, ENVELOPE_FIELDS if facts else ())
            return of_field(found.type.type) if found is not None else None
        if owner is not None:
            help_ = None
            if isinstance(owner, Array) and base is not None:
                from swarmdsl.analysis.types.hints import field_of_array_hint

                help_ = field_of_array_hint(owner, name, base.span.text, self.interfaces)
            of_type = f"a value of type `{owner}`"
            self.report.report("unknown-field", at, owner=of_type, name=name, help=help_)
        return None

    def field_of(self, owner: Named, name: Word) -> Field | Parameter | None:
        """Return a field of a message; report a missing one."""
        return self._field(owner, name, name.span)

    def _field(
        self, owner: Named, name: str, at: Span, facts: Collection[str] = ()
    ) -> Field | Parameter | None:
        fields = self.interfaces.fields(owner)
        if fields is None:
            return None
        found = next((known for known in fields if known.name == name), None)
        if found is None:
            names = [str(each.name) for each in fields]
            report_unknown_field(f"`{owner}`", name, at, names, self.report, facts)
        return found

    def _own(self, name: Word) -> Type | None:
        """Return the type of a field of `self`."""
        if name in SELF_FIELDS:
            return SELF_FIELDS[name]
        report_unknown_field("`self`", name, name.span, SELF_FIELDS, self.report)
        return None

    def is_envelope(self, name: str) -> bool:
        """Return True for a field of `event` that is a fact about the event, not its message.

        A field of the message hides it. Several swarm events with different messages have no
        message in common, but such facts.
        """
        if name not in ENVELOPE_FIELDS:
            return False
        if not self.has_event:
            return self.of_swarm
        fields = self.interfaces.fields(self.event) if isinstance(self.event, Named) else None
        return self.of_swarm if fields is None else all(each.name != name for each in fields)

    def _fact(self, name: Word) -> Type | None:
        """Return the type of a fact about the event, or of the field that hides it."""
        if not self.is_envelope(name):
            if self.of_swarm and isinstance(self.event, Named):
                self.report.report(
                    "hidden-sender",
                    name.span,
                    name=name,
                    type=self.event,
                    help="give the field another name if you mean the robot that sent the event, "
                    "or the time",
                )
            return self.field(self.event, name, name.span)
        if not self.of_swarm:
            self.report.report(
                "no-sender",
                name.span,
                name=name,
                help="the robot that joined or was lost is `event.id`"
                if self.event == MEMBER
                else self.sender_help,
            )
        return ENVELOPE_FIELDS[name]

    def _enum_of(self, type_: Named) -> EnumType | None:
        found = self.interfaces.get(type_)
        return found if isinstance(found, EnumType) else None

    def _enum_value(self, enum: EnumType, name: Word) -> Type | None:
        known = self.folding.numbers(enum)
        if str(name) not in known:
            report_missing(
                f"value of enum `{enum.name}`",
                name,
                name.span,
                known,
                self.report,
                hint=lambda: only(f"it has {listed([*known], 'and')}", [*known]) if known else None,
            )
            return None
        return enum.type
