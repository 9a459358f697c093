"""Import calls of the CPSwarm dialect as activities with functions and interfaces."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.calls import Call
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.expressions import UnsupportedError, path
from swarmdsl.importing.library import Library, literal
from swarmdsl.importing.names import NamePool
from swarmdsl.importing.portable import doc_of
from swarmdsl.ir import (
    Action,
    Activity,
    Expression,
    Interface,
    Literal,
    Policy,
    Primitive,
    ResultMapping,
    Type,
    VariableRef,
)
from swarmdsl.syntax.types import BOOL, FLOATS, INTEGERS, STRING

_ZEROS: dict[str, Literal] = {
    **{name: Literal(0, Primitive(name)) for name in INTEGERS},
    **{name: Literal(0.0, Primitive(name)) for name in FLOATS},
    "bool": Literal(False, BOOL),
    "string": Literal("", STRING),
}


class Activities:
    """Builds the activities of one document; `keys` are the variables that they need."""

    def __init__(self, document: Document, library: Library, report: Diagnostics) -> None:
        self.document = document
        self.library = library
        self.report = report
        self.keys: dict[str, Type] = {}

    def activity(self, call: Call, variables: NamePool) -> Activity:
        """Activity of a state that makes the call."""
        function = self.library.function(call)
        described = self._described(call)
        goal = _part(described, ("goal", "request"))
        result = _part(described, ("result", "response"))
        mapped = dict(call.mappings)
        arguments: dict[str, Expression] = {}
        callback = call.goal is Policy.CALLBACK
        if call.goal is Policy.FIXED:
            callback = not self._fixed(call, goal, arguments)
        elif call.goal is Policy.USERDATA:
            for name in call.goal_items:
                if goal is not None and name not in goal:
                    self._left_out(call, f"`{name}`", f"`{call.type}` has no such field")
                    continue
                key = mapped.get(name, name)
                type_ = self._key(call, key, goal.get(name) if goal is not None else None)
                arguments[name] = VariableRef(variables.of(key), type_)
        if not callback:
            self._complete(call, goal, arguments)
        results = []
        for name in call.result_items:
            if result is not None and name not in result:
                self._left_out(call, f"`{name}`", f"`{call.type}` has no such field")
                continue
            key = mapped.get(name, name)
            self._key(call, key, result.get(name) if result is not None else None)
            results.append(ResultMapping(name, variables.of(key), ()))
        words = ("goal", "result") if call.paradigm == "action" else ("request", "response")
        reads = call.result is Policy.CALLBACK
        return Activity(
            function.name,
            tuple(arguments.items()) if not callback else (),
            f"{function.name}_{words[0]}" if callback else None,
            tuple(results),
            f"{function.name}_{words[1]}" if reads else None,
        )

    def portable_activity(self, node: Node, data: MachineData) -> Activity | None:
        """Activity as described by the portable profile; None if it is incomplete."""
        name = node.get("function", "")
        function = self.library.function_named(name)
        if function is None:
            what, reason = f"the activity `{name}`", "no function has this name"
            self.report.report("left-out", self.document.at(node), what=what, reason=reason)
            return None
        known = self.library.interfaces.get(function.communication.type)
        goal = _part(known, ("goal", "request")) or {}
        parts = {each.name: each for each in node.children}
        arguments: list[tuple[str, Expression]] = []
        results: list[ResultMapping] = []
        for each in [inner for part in node.children for inner in part.children]:
            field = each.get("field", "")
            try:
                if each.name == "argument":
                    text = each.get("expr", "")
                    arguments.append((field, data.read(each, "expr", text, goal.get(field))))
                elif each.name == "mapping":
                    variable, *below = path(each.get("location", ""))
                    if variable not in data.types:
                        raise UnsupportedError(f"unknown variable `{variable}`")
                    results.append(ResultMapping(field, data.name(variable), tuple(below)))
            except UnsupportedError as fault:
                place = self.document.at(each)
                self.report.report("left-out", place, what=f"`{field}`", reason=fault.reason)
        callbacks = [
            parts[name].get("callback") if name in parts else None for name in ("goal", "result")
        ]
        doc = doc_of(node.children)
        return Activity(
            function.name, tuple(arguments), callbacks[0], tuple(results), callbacks[1], doc
        )

    def _described(self, call: Call) -> Interface | None:
        """Known interface of a call; None if it is known as another kind."""
        known = self.library.interface(call)
        if known is None or isinstance(known, Action) == (call.paradigm == "action"):
            return known
        self.library.interfaces.pop(call.type, None)
        reason = f"it is used as {'an action' if call.paradigm == 'action' else 'a service'} here"
        self._left_out(call, f"the description of `{call.type}`", reason)
        return None

    def _fixed(
        self, call: Call, goal: dict[str, Type] | None, arguments: dict[str, Expression]
    ) -> bool:
        """Assign values to fields in order; return False if a value is computed."""
        values = [literal(item) for item in call.goal_items]
        names = list(goal) if goal is not None else []
        if goal is None:
            names = [f"value{number}" for number in range(1, len(values) + 1)]
        if goal is None or any(name.startswith("value") for name in names):
            what = f"the field names of `{call.type}` are unknown"
            help_ = "give the ADF file of the function with `--adf`"
            self._assumed(call, what, ", ".join(f"`{name}`" for name in names), help_)
        if None in values:
            what = ", ".join(call.goal_items)
            self._left_out(call, f"`{what}`", "it is code; fill the goal in a callback")
            return False
        for name, value in zip(names, values, strict=False):
            assert value is not None
            arguments[name] = value
        for item in call.goal_items[len(names) :]:
            self._left_out(call, f"`{item}`", f"`{call.type}` has no field for it")
        return True

    def _complete(
        self, call: Call, goal: dict[str, Type] | None, arguments: dict[str, Expression]
    ) -> None:
        """Set missing fields to zero, the default of ROS."""
        missing = {name: type_ for name, type_ in (goal or {}).items() if name not in arguments}
        if not missing:
            return
        zeros = {name: _ZEROS.get(str(type_)) for name, type_ in missing.items()}
        if None in zeros.values():
            # A described interface requires all fields, so drop the description.
            self.library.interfaces.pop(call.type, None)
            reason = f"a call does not set {', '.join(f'`{name}`' for name in missing)}"
            self._left_out(call, f"the description of `{call.type}`", reason)
            return
        for name, zero in zeros.items():
            assert zero is not None
            arguments[name] = zero
            self._assumed(call, f"`{name}` has no value", "zero, the default of ROS,")

    def _key(self, call: Call, key: str, type_: Type | None) -> Type:
        known = self.keys.get(key)
        if known is None:
            if type_ is None:
                self._assumed(call, f"the type of `{key}` is unknown", "`string`")
            known = self.keys[key] = type_ or STRING
        return known

    def _left_out(self, call: Call, what: str, reason: str) -> None:
        self.report.report("left-out", self.document.at(call.node), what=what, reason=reason)

    def _assumed(self, call: Call, what: str, assumed: str, hint: str | None = None) -> None:
        place = self.document.at(call.node)
        self.report.report("assumed", place, what=what, assumed=assumed, help=hint)


def _part(described: Interface | None, names: tuple[str, str]) -> dict[str, Type] | None:
    """Fields of one part of an interface; None if it is unknown."""
    for name in names:
        fields = getattr(described, name, None)
        if fields is not None:
            return {field.name: field.type for field in fields}
    return None
