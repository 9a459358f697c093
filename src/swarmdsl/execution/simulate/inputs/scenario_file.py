"""Read scenarios from TOML, and check their names and values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.driver.config.toml import Document
from swarmdsl.execution.simulate.inputs.choose_space import KINDS
from swarmdsl.execution.simulate.inputs.scenario_keys import (
    FAULT,
    FUNCTION,
    FUNCTION_OF_MEMBER,
    MESSAGE,
    NETWORK,
    SELF,
    SHARES,
    TABLES,
    WORLD,
)
from swarmdsl.execution.simulate.inputs.scenario_model import model_setting
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.inputs.values import Way, fitted, fitted_result
from swarmdsl.execution.simulate.machines.actors import params, words
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.scenario import (
    EVERY_FUNCTION,
    Fault,
    Message,
    Robot,
    Scenario,
)
from swarmdsl.ir import Communication, Type


def read_scenario(document: Document, subject: Subject, report: Diagnostics) -> Scenario:
    """Read the scenario in a document; incomplete if errors were reported."""
    return _Reader(document, subject, report).read()


class _Reader:
    def __init__(self, document: Document, subject: Subject, report: Diagnostics) -> None:
        self.top = Table(document, (), report)
        self.subject = subject
        self.report = report
        self.robots: list[Robot] = []
        self.members: list[str] = []
        """All words that select members."""

    def read(self) -> Scenario:
        top = self.top
        top.check_keys(TABLES, "a scenario")
        counts = self.counts()
        alone = self.robot_alone()
        self.robots = self.subject.create_robots(counts, alone)
        self.members = list(dict.fromkeys(w for robot in self.robots for w in robot.words))
        network = top.inside("network")
        network.check_keys(NETWORK, "`[network]`")
        world = top.inside("world")
        world.check_keys(WORLD, "`[world]`")
        found: dict[str, Any] = {
            "seed": top.whole("seed") if "seed" in top else None,
            "until": top.duration("until") if "until" in top else None,
            "latency": network.length("latency") if "latency" in network else None,
            "loss": network.share("loss") if "loss" in network else None,
            "world": world.name("kind", KINDS, "world") if "kind" in world else None,
            "step": self.step(world) if "step" in world else None,
        }
        return Scenario(
            counts=counts,
            alone=alone,
            params=self.params(),
            functions=self.functions(),
            messages=tuple(m for m in map(self.message, top.items("messages")) if m is not None),
            faults=tuple(f for f in map(self.fault, top.items("faults")) if f is not None),
            **{name: value for name, value in found.items() if value is not None},
        )

    def step(self, world: Table) -> int | None:
        """Read the time between two steps of a space."""
        step = world.duration("step")
        if step is not None and not MILLISECOND <= step <= 10 * SECOND:
            world.wrong(("step",), "a time from 1 ms to 10 s", world.values["step"])
            return None
        return step

    def counts(self) -> dict[str, int]:
        """Read the number of members by role, within its multiplicity."""
        if self.subject.swarm is None and "count" in self.top:
            help_ = "counts are for swarms: choose one with `--swarm`, or leave them out"
            place = self.top.key_place("count")
            owner = "a scenario of a machine alone"
            self.report.report("unknown-key", place, name="count", owner=owner, help=help_)
            return {}
        table = self.top.inside("count")
        roles = {r.name: r for r in self.subject.swarm.roles} if self.subject.swarm else {}
        found: dict[str, int] = {}
        for name in table.values:
            if name not in roles:
                table.unknown(table.key_place(name), name, roles, "role")
                continue
            allowed = roles[name].multiplicity
            count = table.whole(name, allowed.lower, allowed.upper)
            if count is not None:
                found[name] = count
        return found

    def robot_alone(self) -> Robot:
        """Read the robot that a machine alone runs on."""
        if "self" not in self.top:
            return Robot()
        table = self.top.inside("self")
        if self.subject.machine is None:
            help_ = "only a state machine of a model that runs alone, with `machine`, has it"
            place = self.top.key_place("self")
            self.report.report("unknown-key", place, name="self", owner="a scenario", help=help_)
            return Robot()
        table.check_keys(SELF, "`[self]`")
        name = table.text("id", "the id of a robot") if "id" in table else None
        robot = Robot.called(name) if name else Robot()
        count = table.whole("count", robot.index + 1) if "count" in table else None
        return robot if count is None else replace(robot, count=count)

    def params(self) -> dict[str, dict[str, Any]]:
        """Read param values by the word that selects members."""
        top = self.top.inside("params")
        known: dict[str, dict[str, Type]] = {}
        for robot in self.robots:
            for part, machine in self.subject.behaviours(robot):
                types = {
                    p.name: p.type for p in params(self.subject, robot, part, machine).values()
                }
                for word in words(robot, part):
                    known.setdefault(word, {}).update(types)
        if self.subject.swarm is None:
            return {"": self.param_values(top, known.get("", {}))}
        found: dict[str, dict[str, Any]] = {}
        for word in top.values:
            if word in known:
                found[word] = self.param_values(top.inside(word), known[word])
            else:
                top.unknown(top.key_place(word), word, known, "member")
        return found

    def param_values(self, table: Table, types: Mapping[str, Type]) -> dict[str, Any]:
        """Read the param values of a machine."""
        found: dict[str, Any] = {}
        for name in table.values:
            if name not in types:
                table.unknown(table.key_place(name), name, types, "param")
                continue
            value = self.fitted(table, types[name], name)
            if value is not None:
                found[name] = value
        return found

    def functions(self) -> dict[tuple[str, str], dict[str, Any]]:
        """Read the settings of each function, for all or for some members."""
        top = self.top.inside("functions")
        known = self.known_functions()
        found: dict[tuple[str, str], dict[str, Any]] = {}
        for name in top.values:
            if name not in known:
                top.unknown(top.key_place(name), name, known, "function")
                continue
            table = top.inside(name)
            found[name, ""] = self.behavior(table, known[name], FUNCTION)
            others = table.inside("of")
            for member in others.values:
                if member not in self.members:
                    others.unknown(others.key_place(member), member, self.members, "member")
                    continue
                inner = others.inside(member)
                found[name, member] = self.behavior(inner, known[name], FUNCTION_OF_MEMBER)
                self.check_shares(inner, {**found[name, ""], **found[name, member]})
            self.check_shares(table, found[name, ""])
        return found

    def behavior(
        self, table: Table, call: Communication | None, keys: Iterable[str]
    ) -> dict[str, Any]:
        """Read the valid settings of a function."""
        table.check_keys(keys, "a function")
        found: dict[str, Any] = {}
        for key in table.values:
            if key in ("duration", "stopping"):
                found[key] = table.length(key)
            elif key in SHARES:
                found[key] = table.share(key)
            elif key == "results":
                found[key] = self.results(table, call)
        found.update(model_setting(table, self.subject, call))
        return {key: value for key, value in found.items() if value is not None}

    def results(self, table: Table, call: Communication | None) -> tuple[Any, ...]:
        """Read the possible results of a function."""
        system = self.subject.system

        def fit(value: Any, way: Way) -> Any:
            if call is None or system is None:
                return value
            return fitted_result(call, value, system, "the result", way)

        numbers = [item.keys[-1] for item in table.items("results")]
        found = [table.fitted(fit, "results", number) for number in numbers]
        return tuple(each for each in found if each is not None)

    def check_shares(self, table: Table, said: Mapping[str, Any]) -> None:
        """Check that the probabilities of all outcomes but success are at most 1."""
        given = [share for share in SHARES if share in table]
        together = sum(said.get(share, 0.0) for share in SHARES)
        if given and together > 1 + 1e-9:
            expected = "at most the remaining probability"
            table.wrong((given[-1],), expected, table.values[given[-1]])

    def known_functions(self) -> dict[str, Communication | None]:
        """Return the functions of the subject, with their communication if known."""
        found: dict[str, Communication | None] = {EVERY_FUNCTION: None}
        document = self.subject.document
        if document is not None:
            activities = (state.activity for state in document.machine.states)
            found.update({each.name: None for each in activities if each is not None})
        system = self.subject.system
        if system is not None:
            found.update({each.name: each.communication for each in system.functions})
        return found

    def message(self, table: Table) -> Message | None:
        """Read an event from outside."""
        table.check_keys(MESSAGE, "a message")
        if not self.needs(table, "event", "at"):
            return None
        system = self.subject.system
        event = table.values["event"]
        data = table.values.get("data")
        if system is not None:
            types = {each.name: each.type for each in system.events}
            event = table.name("event", types, "event")
            if event is None:
                return None
            data = fitted(types[event], {}, system)
            if "data" in table:
                data = self.fitted(table, types[event], "data")
        elif not isinstance(event, str):
            table.wrong(("event",), "the name of an event", event)
            return None
        at = table.length("at")
        every = table.duration("every") if "every" in table else None
        if every is not None and every < MILLISECOND:
            table.wrong(("every",), "a time of 1 ms or more", table.values["every"])
        to = table.names("to", self.members, "member") if "to" in table else None
        sender = self.sender(table) if "sender" in table else ""
        return Message(event, at, every, to, data, sender or "") if at is not None else None

    def sender(self, table: Table) -> str | None:
        """Read the robot in whose name an event comes; alone, a machine can hear any."""
        if self.subject.swarm is None:
            return table.text("sender", "the id of a robot")
        return table.name("sender", [robot.name for robot in self.robots if robot.name], "robot")

    def fault(self, table: Table) -> Fault | None:
        """Read a fault."""
        table.check_keys(FAULT, "a fault")
        if not self.needs(table, "at"):
            return None
        at = table.length("at")
        lasts = table.duration("lasts") if "lasts" in table else None
        kinds = {"lost": "a lost member", "apart": "members apart"}
        for kind in kinds:
            if kind in table:
                for key in ("silent", "of", *(other for other in kinds if other != kind)):
                    if key in table:
                        table.wrong((key,), f"no such key for {kinds[kind]}", table.values[key])
        if "lost" in table:
            of = table.names("lost", self.members, "member")
            return Fault(at, of, lasts=lasts) if at is not None else None
        if "apart" in table:
            groups = self.groups(table)
            return Fault(at, lasts=lasts, apart=groups) if at is not None and groups else None
        if "silent" not in table:
            help_ = (
                "use `lost` to remove a member, `apart` for members that do not reach each other, "
                "`silent` for a function that does not answer"
            )
            self.report.report("missing-key", table.value_place(()), name="lost", help=help_)
            return None
        function = table.name("silent", self.known_functions(), "function")
        to = table.names("of", self.members, "member") if "of" in table else None
        return Fault(at, to, function, lasts) if at is not None and function else None

    def groups(self, table: Table) -> tuple[tuple[str, ...], ...]:
        """Read groups of members that do not reach one another."""
        given = table.values["apart"]
        if not isinstance(given, list) or len(given) < 2:
            table.wrong(("apart",), "two groups of members or more", given)
            return ()
        return tuple(
            table.names_at(("apart", i), self.members, "member") for i in range(len(given))
        )

    def needs(self, table: Table, *keys: str) -> bool:
        """Return True if a table has the keys; report a missing one."""
        for key in keys:
            if key not in table:
                self.report.report("missing-key", table.value_place(()), name=key)
        return all(key in table for key in keys)

    def fitted(self, table: Table, type_: Type, key: str) -> Any:
        system = self.subject.system
        assert system is not None

        def fit(value: Any, way: Way) -> Any:
            return fitted(type_, value, system, way)

        return table.fitted(fit, key)
