"""Read the claims of test steps from TOML, and resolve their names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import replace
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.testing.case import ALL, ANY, NONE, ActionKind, Claim, Expect, Quantity
from swarmdsl.execution.testing.data import describe_fields
from swarmdsl.execution.testing.expected_data import event_data, variables
from swarmdsl.execution.testing.keys import ACTIONS, CLAIM, COUNT, TIMES, VERBS, WAIT
from swarmdsl.execution.testing.names import Names
from swarmdsl.execution.testing.step_keys import check_keys, listed_names, named_machines

_SUBJECTS: Mapping[str, Quantity] = {"who": ALL, "all": ALL, "any": ANY, "no": NONE}
_ACTIONS: Mapping[str, tuple[ActionKind, str]] = {
    "sends": ("sends", "to send"),
    "starts": ("starts", "to start"),
    "cancels": ("cancels", "to cancel"),
}


class ClaimReader:
    """Reader of what a step expects; an invalid claim is None."""

    def __init__(self, names: Names, report: Diagnostics) -> None:
        self._names = names
        self._report = report

    def always(self, table: Table) -> Claim | None:
        """Read a claim that must hold all the time."""
        check_keys(table, CLAIM, "what is always so", self._report)
        return self._claim(table)

    def expectation(self, table: Table) -> Expect | None:
        """Read a claim that must hold at once, within a time or during one."""
        check_keys(table, (*ACTIONS, *CLAIM, *TIMES, *WAIT), "a step", self._report)
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
        who = (
            named_machines(table, key, self._names)
            if key is not None
            else self._names.all_machines()
        )
        if verb is None or quantity is None or not who:
            return None
        unsent = next((key for key in ("data", "to") if key in table), None)
        if unsent is not None and verb != "sends":
            reason, place = f"`{unsent}` requires `sends`", table.key_place(unsent)
            hint = "use `has` for the values of variables" if unsent == "data" else None
            self._report.report("impossible-step", place, reason=reason, help=hint)
            return None
        word = table.values[key] if key is not None else ""
        others = {"in": self._in, "has": self._has, "satisfies": self._satisfies}
        read = others.get(verb, self._does)
        claim = read(table, verb, quantity, who, word)
        if claim is None or not claim.who:
            return None
        claim = replace(claim, text=f"{_words(table, key)}{claim.text}")
        return claim if self._is_possible(table, claim) else None

    def _in(
        self, table: Table, verb: str, quantity: Quantity, who: list[int], word: str
    ) -> Claim | None:
        """Read the states in which machines are to be."""
        states = listed_names(table, verb, "the name of a state, or a list of them")
        meant = self._names.in_state(who, word, states) if states else {}
        text = f"in {listed([name for name, _ in states], 'and')}"
        return Claim(table.value_place((verb,)), text, quantity, tuple(meant), states=meant)

    def _has(
        self, table: Table, verb: str, quantity: Quantity, who: list[int], word: str
    ) -> Claim | None:
        """Read the values that variables are to have."""
        values, written = variables(table, self._names, who, word)
        if not values:
            return None
        text = f"to have `{describe_fields(table.values[verb], table.values[verb])}`"
        place = table.value_place((verb,))
        return Claim(place, text, quantity, tuple(values), values=values, written=written)

    def _satisfies(
        self, table: Table, verb: str, quantity: Quantity, who: list[int], word: str
    ) -> Claim | None:
        """Read the property that must be true, of robots or of all together."""
        known = {each.name: each for each in watchable(self._names.subject)}
        name = table.name(verb, known, "property")
        if name is None:
            return None
        role, place = known[name].each, table.value_place((verb,))
        first: dict[str | None, int] = {}
        for number in who:
            robot = self._names.cast[number].robot
            if role in (None, robot.role):
                first.setdefault(robot.name if role is not None else None, number)
        if role is None and (word or quantity != ALL):
            reason, help_ = f"`{name}` is not about each robot", "leave out the robots"
        elif not first:
            reason, help_ = f"`{name}` is about each `{role}`", f"name a `{role}`"
        else:
            text = f"{'' if word else 'the model '}to satisfy `{name}`"
            return Claim(place, text, quantity, tuple(first.values()), property=known[name])
        self._report.report("impossible-step", place, reason=reason, help=help_)
        return None

    def _does(
        self, table: Table, verb: str, quantity: Quantity, who: list[int], word: str
    ) -> Claim | None:
        """Read what machines are to send, start or cancel."""
        name = table.text(verb, f"the name of {'an event' if verb == 'sends' else 'a function'}")
        place = table.value_place((verb,))
        action, said = _ACTIONS[verb]
        able = self._names.machines_able(who, word, action, name, place) if name else []
        text = f"{said} `{name}`"
        data = address = None
        if name and able and "data" in table:
            data = event_data(table, self._names, name)
            if data is None:
                return None
            text += f" with `{describe_fields(data, data)}`"
        if "to" in table:
            address = self._address(table)
            if address is None:
                return None
            text += f" to `{address}`"
        if not name:
            return None
        return Claim(
            place, text, quantity, tuple(able), action=action, name=name, data=data, to=address
        )

    def _address(self, table: Table) -> str | None:
        """Read the robot or the role to which an event is sent."""
        address = table.text("to", "the id of a robot, or a role")
        if address is None or self._names.subject.swarm is None:
            return address
        return address if self._names.members(address, table.value_place(("to",))) else None

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

    def _only(self, table: Table, keys: Iterable[str], what: str) -> str | None:
        given = [key for key in keys if key in table]
        if len(given) == 1:
            return given[0]
        if given:
            self._one_of(table, given)
        elif not any(key not in (*ACTIONS, *CLAIM, *TIMES, *WAIT) for key in table.values):
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
