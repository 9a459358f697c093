"""Read test steps from TOML, and resolve their names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import replace
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.inputs.values import fitted, fitted_result
from swarmdsl.execution.simulate.machines.table import OUTCOMES
from swarmdsl.execution.testing.case import Action, Arrive, End, Lose, Pass, Send, Step
from swarmdsl.execution.testing.claims import ClaimReader
from swarmdsl.execution.testing.keys import ACTIONS
from swarmdsl.execution.testing.names import Names
from swarmdsl.execution.testing.step_keys import check_keys, listed_names, named_machines


class StepReader:
    """Reader of the steps of a test; an invalid step is None.

    With `skips`, it accepts actions that the model makes impossible.
    """

    def __init__(
        self, names: Names, claims: ClaimReader, report: Diagnostics, *, skips: bool = False
    ) -> None:
        self._names = names
        self._claims = claims
        self._report = report
        self._skips = skips

    def step(self, table: Table) -> Step | None:
        """Read a step: an action or an expectation."""
        verbs = [key for key in table.values if key in ACTIONS]
        if verbs:
            return self._action(table, verbs[0])
        expected = self._claims.expectation(table)
        if "meanwhile" not in table:
            return expected
        meanwhile = self._meanwhile(table)
        return replace(expected, meanwhile=meanwhile) if expected and meanwhile else None

    def _meanwhile(self, table: Table) -> tuple[Action, ...]:
        """Read what happens again and again while time passes."""
        found: list[Action] = []
        given = list(table.items("meanwhile"))
        for each in given:
            verb = next((key for key in each.values if key in ACTIONS), None)
            action = self._action(each, verb) if verb is not None else None
            if action is not None:
                found.append(action)
            elif verb is None and each.values:
                check_keys(each, ACTIONS, "what happens meanwhile", self._report)
            elif verb is None:
                each.wrong((), listed(list(ACTIONS)), {})
        if "within" not in table:
            self._report.report(
                "impossible-step",
                table.key_place("meanwhile"),
                reason="`meanwhile` requires `within`",
                help="say how long to wait",
            )
        elif len(found) == len(given) > 0 and not any(
            isinstance(a, Pass) and a.length for a in found
        ):
            self._report.report(
                "impossible-step",
                table.key_place("meanwhile"),
                reason="no time passes `meanwhile`",
                help='`{ pass = "1 s" }` in it lets a second pass each time',
            )
        return tuple(found)

    def _action(self, table: Table, verb: str) -> Action | None:
        """Read an action."""
        check_keys(table, ACTIONS[verb], f"a step with `{verb}`", self._report)
        read: dict[str, Callable[[Table], Action | None]] = {
            "send": self._send,
            "end": self._end,
            "pass": self._pass,
            "lose": self._lose,
            "hear": lambda table: self._arrive(table, "hear"),
            "drop": lambda table: self._arrive(table, "drop"),
        }
        return read[verb](table)

    def _send(self, table: Table) -> Send | None:
        place = table.value_place(("send",))
        event = table.text("send", "the name of an event")
        who = self._receivers(table) if "to" in table else self._names.all_machines()
        if event is None or not who or not self._names.is_known("event", event, place):
            return None
        sender = self._sender(table) if "sender" in table else ""
        if sender is None:
            return None
        if sender and "to" not in table:
            who = [n for n in who if self._names.cast[n].robot.name != sender]
        listening = [n for n in who if self._names.cast[n].listens(event)]
        if not listening:
            self._report.report("unheard-event", place, name=event)
        data = table.values.get("data")
        system = self._names.subject.system
        if system is not None:
            type_ = system.event(event).type
            data = fitted(type_, {}, system)
            if "data" in table:
                data = table.fitted(lambda value, way: fitted(type_, value, system, way), "data")
        return Send(place, event, data, tuple(listening), sender)

    def _sender(self, table: Table, key: str = "sender") -> str | None:
        """Read the robot in whose name an event comes; alone, a machine can hear any."""
        if self._names.subject.swarm is None:
            return table.text(key, "the id of a robot")
        robots = dict.fromkeys(actor.robot.name for actor in self._names.cast)
        return table.name(key, [name for name in robots if name], "robot")

    def _end(self, table: Table) -> End | None:
        place = table.value_place(("end",))
        function = table.text("end", "the name of a function")
        outcome = table.name("as", OUTCOMES, "outcome") if "as" in table else "succeeded"
        who = (
            named_machines(table, "of", self._names)
            if "of" in table
            else self._names.all_machines()
        )
        if function is None or outcome is None or not who:
            return None
        word = table.values.get("of", "")
        skips = self._skips
        able = self._names.machines_able(who, word, "starts", function, place, skips=skips)
        result = None
        if "result" in table and able:
            if outcome != "succeeded":
                table.wrong(("result",), "no result unless it succeeds", table.values["result"])
            result = self._result(table, function)
        known = able or (skips and self._names.is_known("function", function, place))
        return End(place, function, outcome, result, tuple(able)) if known else None

    def _result(self, table: Table, function: str) -> Any:
        system = self._names.subject.system
        if system is None:
            return table.values["result"]
        call = system.function(function).communication
        owner = f"the result of `{function}`"
        return table.fitted(
            lambda value, way: fitted_result(call, value, system, owner, way), "result"
        )

    def _pass(self, table: Table) -> Pass | None:
        length = table.duration("pass")
        return Pass(table.value_place(("pass",)), length) if length is not None else None

    def _lose(self, table: Table) -> Lose | None:
        who = named_machines(table, "lose", self._names)
        robots = dict.fromkeys(self._names.cast[n].robot.name for n in who)
        return Lose(table.value_place(("lose",)), tuple(robots)) if who else None

    def _arrive(self, table: Table, verb: str) -> Arrive | None:
        """Read the arrival or the loss of an event that is on its way."""
        place = table.value_place((verb,))
        event = table.text(verb, "the name of an event")
        if "by" not in table:
            help_ = 'name the robot to which it is on its way, such as `by = "robot[0]"`'
            self._report.report("missing-key", place, name="by", help=help_)
            return None
        who = named_machines(table, "by", self._names)
        sender = self._sender(table, "from") if "from" in table else ""
        if event is None or sender is None or not self._names.is_known("event", event, place):
            return None
        system = self._names.subject.system
        if not who or system is None:
            return None
        declared = system.event(event)
        if not declared.swarm:
            reason = f"`{event}` is not on its way between robots: it is no swarm event"
            help_ = "let it arrive from outside with `send`"
            self._report.report("impossible-step", place, reason=reason, help=help_)
            return None
        delivery = declared.delivery
        if verb == "drop" and delivery is not None and delivery.reliable and not delivery.keep:
            reason = f"`{event}` is reliable: it is not lost on its way"
            self._report.report("impossible-step", place, reason=reason)
            return None
        cast = self._names.cast
        robots = dict.fromkeys(cast[n].robot.name for n in who if cast[n].listens(event))
        if not robots and not self._skips:
            reason = f"`{table.values['by']}` never handles `{event}`"
            self._report.report("impossible-step", place, reason=reason)
            return None
        senders = [n for n, actor in enumerate(cast) if not sender or actor.robot.name == sender]
        skips = self._skips
        able = self._names.machines_able(senders, sender, "sends", event, place, skips=skips)
        if not able and not skips:
            return None
        return Arrive(place, event, tuple(robots), sender or None, verb == "drop")

    def _receivers(self, table: Table) -> list[int]:
        what = "the name of a member, of a role or of a type of member, or a list of them"
        each = [self._names.members(*given) for given in listed_names(table, "to", what)]
        return sorted({n for found in each for n in found}) if all(each) else []
