"""Calls of the dialect as activities, with the functions and interfaces that they need."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.calls import Call
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.expressions import UnsayableError, path
from swarmdsl.importing.library import Library, literal
from swarmdsl.importing.names import Names
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
    """Makes the activities of one document; `keys` are the variables that they need."""

    def __init__(self, document: Document, library: Library, report: Diagnostics) -> None:
        self.document = document
        self.library = library
        self.report = report
        self.keys: dict[str, Type] = {}

    def activity(self, call: Call, variables: Names) -> Activity:
        """What a state does that makes this call."""
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

    def said(self, node: Node, data: MachineData) -> Activity | None:
        """What a state does as the portable profile says it; None where that is incomplete."""
        name = node.get("function", "")
        function = self.library.called(name)
        if function is None:
            what, reason = f"the activity `{name}`", "no function is called so"
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
                        raise UnsayableError(f"no variable is called `{variable}`")
                    results.append(ResultMapping(field, data.name(variable), tuple(below)))
            except UnsayableError as fault:
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
        """What is known of the interface of a call; nothing, where it is known as another kind."""
        known = self.library.interface(call)
        if known is None or isinstance(known, Action) == (call.paradigm == "action"):
            return known
        self.library.interfaces.pop(call.type, None)
        reason = f"here it is that of {'an action' if call.paradigm == 'action' else 'a service'}"
        self._left_out(call, f"what is known of `{call.type}`", reason)
        return None

    def _fixed(
        self, call: Call, goal: dict[str, Type] | None, arguments: dict[str, Expression]
    ) -> bool:
        """Fill in values in the order of the fields; False where they are no plain values."""
        values = [literal(item) for item in call.goal_items]
        names = list(goal) if goal is not None else []
        if goal is None:
            names = [f"value{number}" for number in range(1, len(values) + 1)]
        if goal is None or any(name.startswith("value") for name in names):
            what = f"the names of the fields of `{call.type}` are not known"
            help_ = "a description of the function says them: name its ADF file with `--adf`"
            self._assumed(call, what, ", ".join(f"`{name}`" for name in names), help_)
        if None in values:
            what = ", ".join(call.goal_items)
            self._left_out(call, f"`{what}`", "it is code; a callback has to fill the goal")
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
        """Say what ROS does: a field that is not given is zero."""
        missing = {name: type_ for name, type_ in (goal or {}).items() if name not in arguments}
        if not missing:
            return
        zeros = {name: _ZEROS.get(str(type_)) for name, type_ in missing.items()}
        if None in zeros.values():
            # Its fields would have to be given: then it is better not described at all.
            self.library.interfaces.pop(call.type, None)
            reason = f"a call of it leaves {', '.join(f'`{name}`' for name in missing)} open"
            self._left_out(call, f"what is known of `{call.type}`", reason)
            return
        for name, zero in zeros.items():
            assert zero is not None
            arguments[name] = zero
            self._assumed(call, f"`{name}` has no value", "zero, as ROS has it,")

    def _key(self, call: Call, key: str, type_: Type | None) -> Type:
        known = self.keys.get(key)
        if known is None:
            if type_ is None:
                self._assumed(call, f"the type of `{key}` is not known", "`string`")
            known = self.keys[key] = type_ or STRING
        return known

    def _left_out(self, call: Call, what: str, reason: str) -> None:
        self.report.report("left-out", self.document.at(call.node), what=what, reason=reason)

    def _assumed(self, call: Call, what: str, assumed: str, way: str | None = None) -> None:
        place = self.document.at(call.node)
        self.report.report("assumed", place, what=what, assumed=assumed, help=way)


def _part(described: Interface | None, names: tuple[str, str]) -> dict[str, Type] | None:
    """The fields of one part of an interface; None where nothing is known."""
    for name in names:
        fields = getattr(described, name, None)
        if fields is not None:
            return {field.name: field.type for field in fields}
    return None
