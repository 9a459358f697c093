"""Read test steps from TOML, and resolve their names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.durations import format_duration
from swarmdsl.execution.simulate.scenario_table import Table
from swarmdsl.execution.simulate.table import OUTCOMES
from swarmdsl.execution.simulate.values import fitted, fitted_result
from swarmdsl.execution.testing.case import (
    ALL,
    ANY,
    NONE,
    ActionKind,
    Arrive,
    Claim,
    End,
    Expect,
    Lose,
    Pass,
    Quantity,
    Send,
    Step,
)
from swarmdsl.execution.testing.data import describe_fields
from swarmdsl.execution.testing.expected_data import event_data, variables
from swarmdsl.execution.testing.keys import ACTIONS, CLAIM, COUNT, TIMES, VERBS
from swarmdsl.execution.testing.names import Names

_SUBJECTS: Mapping[str, Quantity] = {"who": ALL, "all": ALL, "any": ANY, "no": NONE}
_ACTION_KINDS: Mapping[str, ActionKind] = {
    "sends": "sends",
    "starts": "starts",
    "cancels": "cancels",
}
# Words of other tools and languages.
_OTHER_WORDS = {
    **dict.fromkeys(("wait", "sleep", "delay", "after", "advance", "elapse"), "pass"),
    **dict.fromkeys(("event", "raise", "emit", "publish", "trigger"), "send"),
    **dict.fromkeys(("finish", "complete", "outcome", "succeed", "abort"), "end"),
    **dict.fromkeys(("kill", "lost", "crash", "fail"), "lose"),
    **dict.fromkeys(("arrive", "receive", "hears", "deliver"), "hear"),
    **dict.fromkeys(("drops", "loss", "discard"), "drop"),
    **dict.fromkeys(("expect", "state", "active", "assert", "is"), "in"),
    **dict.fromkeys(("variable", "variables", "var", "values", "where"), "has"),
    **dict.fromkeys(("every", "each"), "all"),
    **dict.fromkeys(("none", "not", "never"), "no"),
    **dict.fromkeys(("timeout", "before", "eventually"), "within"),
    **dict.fromkeys(("during", "always", "lasting"), "for"),
    **dict.fromkeys(("member", "by", "robot"), "who"),
}


class StepReader:
    """Reader of the steps of a test; an invalid step is None.

    With `skips`, it accepts actions that the model makes impossible.
    """

    def __init__(self, names: Names, report: Diagnostics, *, skips: bool = False) -> None:
        self._names = names
        self._report = report
        self._skips = skips

    def step(self, table: Table) -> Step | None:
        """Read a step: an action or an expectation."""
        verbs = [key for key in table.values if key in ACTIONS]
        if not verbs:
            return self._expect(table)
        verb = verbs[0]
        self._check_keys(table, ACTIONS[verb], f"a step with `{verb}`")
        read: dict[str, Callable[[Table], Step | None]] = {
            "send": self._send,
            "end": self._end,
            "pass": self._pass,
            "lose": self._lose,
            "hear": lambda table: self._arrive(table, "hear"),
            "drop": lambda table: self._arrive(table, "drop"),
        }
        return read[verb](table)

    def claim(self, table: Table) -> Claim | None:
        """Read a claim that must hold all the time."""
        self._check_keys(table, CLAIM, "what is always so")
        return self._claim(table)

    def _check_keys(self, table: Table, known: Iterable[str], owner: str) -> None:
        """Report unknown keys, some with a hint."""
        known = list(known)
        for key in table.values:
            if key not in known:
                word = _OTHER_WORDS.get(key)
                help_ = f"write `{word}`" if word in known else suggest(key, known, "keys")
                place = table.key_place(key)
                self._report.report("unknown-key", place, name=key, owner=owner, help=help_)

    # ---- actions

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
        who = self._members(table, "of") if "of" in table else self._names.all_machines()
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
        who = self._members(table, "lose")
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
        who = self._members(table, "by")
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

    # ---- expectations

    def _expect(self, table: Table) -> Expect | None:
        self._check_keys(table, (*ACTIONS, *CLAIM, *TIMES), "a step")
        claim = self._claim(table)
        times = [key for key in TIMES if key in table]
        lengths = {key: table.duration(key) for key in times}
        if len(times) > 1:
            self._one_of(table, times)
            return None
        if claim is None or None in lengths.values():
            return None
        within, lasting = (lengths.get(key) for key in TIMES)
        text = claim.text
        if within is not None:
            text += f" within {format_duration(within)}"
        if lasting is not None:
            text += f" for {format_duration(lasting)}"
        if within is not None and claim.action is not None and not claim.quantity.waits:
            reason = "`within` has no effect: the claim holds without any action"
            help_ = "use `for` to check it during a time"
            self._report.report(
                "impossible-step", table.key_place("within"), reason=reason, help=help_
            )
            return None
        return Expect(claim.place, replace(claim, text=text), within, lasting)

    def _claim(self, table: Table) -> Claim | None:
        verb = self._only(table, VERBS, "what is expected")
        subjects = [key for key in (*_SUBJECTS, "count") if key in table]
        if len(subjects) > 1:
            self._one_of(table, subjects)
            return None
        quantity = self._quantity(table)
        key = "of" if "of" in table else next((k for k in _SUBJECTS if k in table), None)
        if key == "of" and "count" not in table:
            reason, place = "`of` requires a `count`", table.key_place("of")
            help_ = "write `all`, `any` or `no` instead"
            self._report.report("impossible-step", place, reason=reason, help=help_)
            return None
        who = self._members(table, key) if key is not None else self._names.all_machines()
        if verb is None or quantity is None or not who:
            return None
        unsent = next((key for key in ("data", "to") if key in table), None)
        if unsent is not None and verb != "sends":
            reason, place = f"`{unsent}` requires `sends`", table.key_place(unsent)
            hint = "use `has` for the values of variables" if unsent == "data" else None
            self._report.report("impossible-step", place, reason=reason, help=hint)
            return None
        words = _words(table, key)
        word = table.values[key] if key is not None else ""
        if verb == "in":
            states = self._states(table)
            meant = self._names.in_state(who, word, states) if states else {}
            claim = Claim(
                table.value_place(("in",)),
                f"{words}in {listed([name for name, _ in states], 'and')}",
                quantity,
                tuple(meant),
                states=meant,
            )
        elif verb == "has":
            values, written = variables(table, self._names, who, word)
            text = (
                f"{words}to have `{describe_fields(table.values['has'], table.values['has'])}`"
                if values
                else ""
            )
            place = table.value_place(("has",))
            claim = Claim(place, text, quantity, tuple(values), values=values, written=written)
        else:
            what = "the name of an event" if verb == "sends" else "the name of a function"
            name = table.text(verb, what)
            place = table.value_place((verb,))
            action = _ACTION_KINDS[verb]
            able = self._names.machines_able(who, word, action, name, place) if name else []
            said = {"sends": "to send", "starts": "to start", "cancels": "to cancel"}[verb]
            text = f"{words}{said} `{name}`"
            data = None
            if name and able and "data" in table:
                data = event_data(table, self._names, name)
                if data is None:
                    return None
                text += f" with `{describe_fields(data, data)}`"
            address = None
            if "to" in table:
                address = table.text("to", "the id of a robot, or a role")
                if address is None:
                    return None
                in_swarm = self._names.subject.swarm is not None
                if in_swarm and not self._names.members(address, table.value_place(("to",))):
                    return None
                text += f" to `{address}`"
            claim = Claim(
                place,
                text,
                quantity,
                tuple(able),
                action=action,
                name=name or "",
                data=data,
                to=address,
            )
        return claim if claim.who and self._is_possible(table, claim) else None

    def _is_possible(self, table: Table, claim: Claim) -> bool:
        """Return True if enough machines exist."""
        least, there = claim.quantity.least or 0, len(claim.who)
        if least <= there:
            return True
        reason = f"there {'is' if there == 1 else 'are'} only {there}, not {least}"
        self._report.report("impossible-step", table.value_place(("count",)), reason=reason)
        return False

    def _quantity(self, table: Table) -> Quantity | None:
        if "count" not in table:
            return next((q for key, q in _SUBJECTS.items() if key in table), ALL)
        given = table.values["count"]
        found = None
        if isinstance(given, (int, str)) and not isinstance(given, bool):
            found = COUNT.fullmatch(str(given))
        if found is None or (found[2] not in (None, "*") and int(found[1]) > int(found[2])):
            table.wrong(("count",), 'a number, or a range like "1..3" or "2..*"', given)
            return None
        least = int(found[1])
        return Quantity(least, None if found[2] == "*" else int(found[2] or least))

    def _states(self, table: Table) -> list[tuple[str, Span]]:
        return self._listed(table, "in", "the name of a state, or a list of them")

    def _receivers(self, table: Table) -> list[int]:
        what = "the name of a member, of a role or of a type of member, or a list of them"
        each = [self._names.members(*given) for given in self._listed(table, "to", what)]
        return sorted({n for found in each for n in found}) if all(each) else []

    def _listed(self, table: Table, key: str, what: str) -> list[tuple[str, Span]]:
        """Read a name or a list of names, each with its place."""
        given = table.values[key]
        each = given if isinstance(given, list) else [given]
        ways: list[tuple[str | int, ...]]
        ways = [(key, i) for i in range(len(each))] if isinstance(given, list) else [(key,)]
        if not each or not all(isinstance(name, str) for name in each):
            table.wrong((key,), what, given)
            return []
        return [(name, table.value_place(way)) for name, way in zip(each, ways, strict=True)]

    def _members(self, table: Table, key: str) -> list[int]:
        word = table.text(key, "the name of a member, of a role or of a type of member")
        return self._names.members(word, table.value_place((key,))) if word is not None else []

    def _only(self, table: Table, keys: Iterable[str], what: str) -> str | None:
        given = [key for key in keys if key in table]
        if len(given) == 1:
            return given[0]
        if given:
            self._one_of(table, given)
        elif not any(key not in (*ACTIONS, *CLAIM, *TIMES) for key in table.values):
            place = table.value_place(())
            self._report.report(
                "missing-key",
                place,
                name="in",
                help=f"say {what} with {listed(list(keys))}, or what is done with "
                f"{listed(list(ACTIONS))}",
            )
        return None

    def _one_of(self, table: Table, keys: list[str]) -> None:
        reason = f"{listed(keys, 'and')} cannot be combined"
        self._report.report("impossible-step", table.key_place(keys[1]), reason=reason)


def _words(table: Table, key: str | None) -> str:
    """Describe the machines of a claim."""
    name = f"`{table.values[key]}` " if key is not None else ""
    if "count" in table:
        return f"{table.values['count']} {f'of {name}' if name else ''}"
    if key in (None, "who"):
        return name
    return f"{key} {name}"
