"""Types of operands and results of operators and built-in functions."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.analysis.resolve.report_unresolved import report_missing
from swarmdsl.analysis.types.built_ins import BUILT_INS
from swarmdsl.analysis.types.fitting import fits, is_float, is_number, is_text
from swarmdsl.analysis.types.positions import Position
from swarmdsl.analysis.types.unit_checks import check_operands
from swarmdsl.analysis.types.unit_rules import in_seconds, result_unit, taken_unit
from swarmdsl.base.diagnostics.advice import Advice, edits
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import dataclass, replace
from swarmdsl.syntax.ast import Call, EnumType, OperatorUse, RoleUse, Value
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    FLOAT,
    INT,
    STRING,
    Array,
    Named,
    Type,
    unit_of,
    with_unit,
)
from swarmdsl.syntax.units import ANY, Unit


@dataclass(frozen=True)
class Application:
    """Operator or function on operands of these types; None is an unknown type."""

    tree: Call | OperatorUse
    types: list[Type | None]
    enum_of: Callable[[Named], EnumType | None]
    position: Callable[[Type | None], Position | None]
    report: Diagnostics

    def result(self) -> Type | None:
        """Return the type of the result; report operands of wrong types and units."""
        word = str(self.tree.function if isinstance(self.tree, Call) else self.tree.operator)
        types = in_seconds(word, self.types)
        if types is not self.types:
            return replace(self, types=types).result()
        before = len(self.report)
        found = self._plain_result(word)
        measured = taken_unit(word) is not None or any(unit_of(each) is not None for each in types)
        if measured and len(self.report) == before:
            check_operands(self.tree, types, self.report)
        if not is_number(found) or found is None:
            return found
        if word == "distance":
            return with_unit(found, self._unit_of_distance())
        return with_unit(found, result_unit(word, types))

    def _plain_result(self, word: str) -> Type | None:
        """Return the type of the result without its unit."""
        if isinstance(self.tree, Call):
            return self._call(self.tree)
        if len(self.types) == 1:
            return self._sign(word, self.types[0])
        return self._binary(word, *self.types)

    def _unit_of_distance(self) -> Unit | None:
        """Return the unit of the coordinates of two positions."""
        units = [place.unit for place in map(self.position, self.types) if place is not None]
        return next((unit for unit in units if unit is not None and not unit.is_any), ANY)

    def _call(self, call: Call) -> Type | None:
        function, types = str(call.function), self.types
        known = BUILT_INS.get(function)
        if known is None:
            report_missing(
                "built-in function", function, call.function.span, BUILT_INS, self.report
            )
            return None
        count = len(known.parameters)
        least = count - known.optional
        enough = len(types) >= count if known.more else least <= len(types) <= count
        if not enough:
            self._report(
                f"{len(types)} value{'s' * (len(types) != 1)}: it takes {count}"
                + (" at most" if known.optional else "")
                + (" or more" if known.more else "")
            )
            return None
        if function == "len":
            self._require(lambda t: is_text(t) or isinstance(t, Array))
        elif function == "contains":
            self._check_items(*types)
        elif function == "div":
            self._require(lambda t: is_number(t) and not is_float(t), self._division_hint)
        elif function == "distance":
            self._check_positions()
        elif function == "present":
            if not all(isinstance(each, RoleUse) for each in call.arguments):
                from swarmdsl.analysis.types.hints import role_hint

                self._report_operands(role_hint(call.arguments))
        elif function == "elapsed":
            # With the path of a state, the parser makes another node of it.
            self._report_operands("name a state around it, `elapsed(Work)`, or none")
        elif function == "seconds":
            self._require(lambda t: t == DURATION)
        elif known.result is not None:
            self._require(is_number, self._duration_hint)
        if known.result is not None:
            return known.result
        if self._are_durations():
            return DURATION
        return self._widest() if self._require(is_number, self._unit_hint) else None

    def _check_items(self, array: Type | None, value: Type | None) -> None:
        """Report what is no array, and a value that no item of it can equal."""
        if array is not None and not isinstance(array, Array):
            self._report_operands("it takes an array and a value")
        elif isinstance(array, Array) and not self._comparable(array.element, value):
            is_message = isinstance(array.element, Named) and not self._is_enum(array.element)
            hint = "compare a field: `any(x in array where x.id == ...)`"
            self._report_operands(hint if is_message else None)

    def _check_positions(self) -> None:
        """Report what is not a position, and two of which one has no `z`."""
        found = [self.position(known) for known in self.types if known is not None]
        if None in found:
            self._report_operands("a position is a message with the numbers `x` and `y`")
        elif len({place.coordinates for place in found if place and place.coordinates}) > 1:
            self._report_operands(self._without_height(found))

    def _without_height(self, found: list[Position | None]) -> str:
        """Return the help for the distance of positions of which one has no height."""
        text = "one has no `z`: `hypot(a.x - b.x, a.y - b.y)` leaves it out"
        operands = self.tree.arguments if isinstance(self.tree, Call) else ()
        if len(operands) != 2 or len(found) != 2:
            return text
        names = [
            ".".join((each.span.text, *place.path)) if place is not None else ""
            for each, place in zip(operands, found, strict=True)
        ]
        differences = ", ".join(f"{names[0]}.{each} - {names[1]}.{each}" for each in "xy")
        new = f"hypot({differences})"
        return edits(text, f"Write `{new}`", (self.tree.span, new))

    def _sign(self, operator: str, operand: Type | None) -> Type | None:
        if operator == "not":
            self._require(lambda t: t == BOOL)
            return BOOL
        return operand if self._require(lambda t: is_number(t) or t == DURATION) else None

    def _binary(self, operator: str, left: Type | None, right: Type | None) -> Type | None:
        if operator in ("and", "or"):
            self._require(lambda t: t == BOOL)
            return BOOL
        if operator in ("==", "!="):
            if not self._comparable(left, right):
                from swarmdsl.analysis.types.hints import enum_value_hint, number_of_robot_hint

                hint = "compare their fields" if self._are_messages() else self._unit_hint()
                enums = [self.enum_of(each) for each in self.types if isinstance(each, Named)]
                hint = hint or enum_value_hint(self.tree, enums)
                self._report_operands(hint or number_of_robot_hint(self.tree))
            return BOOL
        numbers = is_number(left) and is_number(right)
        if operator in ("<", "<=", ">", ">="):
            if not numbers and not self._are_durations():
                self._require(is_number, self._order_hint)
            return BOOL
        if left is None or right is None:
            return None
        if numbers:
            return FLOAT if operator == "/" else self._widest()
        if operator in ("+", "-") and self._are_durations():
            return DURATION
        if operator == "+" and is_text(left) and is_text(right):
            return STRING
        if operator in ("*", "/") and left == DURATION and is_number(right):
            return DURATION
        if operator == "*" and is_number(left) and right == DURATION:
            return DURATION
        if operator == "/" and self._are_durations():
            return FLOAT
        self._require(is_number, self._unit_hint if operator in ("+", "-") else None)
        return None

    def _comparable(self, left: Type | None, right: Type | None) -> bool:
        """Return True if all targets can compare two types: not messages and arrays."""
        if left is None or right is None:
            return True
        if isinstance(left, Named) or isinstance(right, Named):
            return left == right and isinstance(left, Named) and self._is_enum(left)
        if isinstance(left, Array) or isinstance(right, Array):
            return False
        return fits(left, right) or fits(right, left)

    def _is_enum(self, type_: Named) -> bool:
        return self.enum_of(type_) is not None

    def _are_messages(self) -> bool:
        """Return True if all operands are messages or structs of one type."""
        left = self.types[0]
        return isinstance(left, Named) and not self._is_enum(left) and self.types == [left, left]

    def _are_durations(self) -> bool:
        return DURATION in self.types and all(known in (DURATION, None) for known in self.types)

    def _widest(self) -> Type | None:
        if None in self.types:
            return None
        return FLOAT if any(map(is_float, self.types)) else INT

    def _order_hint(self) -> str | None:
        """Hint for a comparison of unordered values."""
        enums = any(isinstance(known, Named) and self._is_enum(known) for known in self.types)
        text = "values of enums have no order: use `==` or `!=`"
        return Advice(text, "compare") if enums else self._unit_hint()

    def _unit_hint(self) -> str | None:
        """Hint for a number beside a duration."""
        if DURATION not in self.types:
            return None
        operands = self.tree.arguments if isinstance(self.tree, Call) else self.tree.operands
        numbers = [
            tree.span.text
            for tree, known in zip(operands, self.types, strict=True)
            if isinstance(tree, Value) and is_number(known)
        ]
        return (
            Advice(f"give it a unit: `{numbers[0]} s`", "add unit", f"{numbers[0]} s")
            if numbers
            else None
        )

    def _duration_hint(self) -> str | None:
        """Hint for a function of numbers of which an argument is a duration."""
        text = "`seconds(d)` is a number"
        if not isinstance(self.tree, Call) or self.tree.function == "div":
            return text if DURATION in self.types else None
        durations = [
            each.span
            for each, known in zip(self.tree.arguments, self.types, strict=True)
            if known == DURATION
        ]
        changes = [(span, f"seconds({span.text})") for span in durations]
        return edits(text, "Write `seconds(...)`", *changes) if changes else None

    def _division_hint(self) -> str | None:
        """Hint for a division of integers with other numbers."""
        if not all(known is None or is_number(known) for known in self.types):
            return self._duration_hint()
        operands = self.tree.arguments if isinstance(self.tree, Call) else self.tree.operands
        quotient = " / ".join(each.span.text for each in operands)
        return Advice(
            "it divides integers: `floor(a / b)` divides real numbers and rounds down",
            "propose",
            f"floor({quotient})",
        )

    def _require(
        self, test: Callable[[Type], bool], hint: Callable[[], str | None] | None = None
    ) -> bool:
        """Report operands of a wrong type; return True if there is none."""
        fine = all(known is None or test(known) for known in self.types)
        if not fine:
            self._report_operands(hint() if hint is not None else None)
        return fine

    def _report_operands(self, hint: str | None = None) -> None:
        operands = self.tree.arguments if isinstance(self.tree, Call) else self.tree.operands
        names = [str(known) for known in self.types if known is not None]
        self._report(listed(names or [each.span.text for each in operands], "and"), hint)

    def _report(self, operands: str, hint: str | None = None) -> None:
        word = self.tree.function if isinstance(self.tree, Call) else self.tree.operator
        self.report.report(
            "bad-operand", self.tree.span, operator=word, operands=operands, help=hint
        )
