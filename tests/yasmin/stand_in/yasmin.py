"""A stand-in for the core of YASMIN 6: what generated machines use of it, and what it refuses."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import Any


class Blackboard(dict[str, Any]):
    """Values by key."""


class State:
    """A state with outcomes."""

    def __init__(self, outcomes: Iterable[str]) -> None:
        self._outcomes = set(outcomes)
        if not self._outcomes:
            raise RuntimeError("a state must have an outcome")

    def __call__(self, blackboard: Blackboard | None = None) -> str:
        outcome = self.execute(Blackboard() if blackboard is None else blackboard)
        if outcome not in self._outcomes:
            raise RuntimeError(f"{outcome} is no outcome of {type(self).__name__}")
        return outcome

    def execute(self, blackboard: Blackboard) -> str:
        raise NotImplementedError

    def cancel_state(self) -> None:
        """Let it end."""

    def get_outcomes(self) -> set[str]:
        return self._outcomes

    def set_description(self, description: str) -> None:
        assert isinstance(description, str)

    def validate(self, strict_mode: bool = False) -> None:
        """Nothing can be wrong with a state that has no states in it."""


class StateMachine(State):
    """States that go on by their outcomes."""

    def __init__(self, outcomes: Iterable[str]) -> None:
        super().__init__(outcomes)
        self._states: dict[str, dict[str, Any]] = {}
        self._start = self._name = self._current = ""

    def add_state(self, name: str, state: State, transitions: dict[str, str] | None = None) -> None:
        if name in self._states or name in self._outcomes:
            raise RuntimeError(f"{name} is a state or an outcome already")
        for outcome in transitions or {}:
            if outcome not in state.get_outcomes():
                raise ValueError(f"{outcome} is no outcome of {name}")
        self._states[name] = {"state": state, "transitions": dict(transitions or {})}
        self._start = self._start or name

    def set_start_state(self, name: str) -> None:
        if name not in self._states:
            raise ValueError(f"there is no {name} to begin with")
        self._start = name

    def get_start_state(self) -> str:
        return self._start

    def set_name(self, name: str) -> None:
        self._name = name

    def get_name(self) -> str:
        return self._name

    def get_states(self) -> dict[str, dict[str, Any]]:
        return self._states

    def get_transitions(self) -> dict[str, dict[str, str]]:
        return {name: each["transitions"] for name, each in self._states.items()}

    def get_current_state(self) -> str:
        return self._current

    def validate(self, strict_mode: bool = False) -> None:
        if not self._start:
            raise RuntimeError("no initial state")
        ends = set()
        for name, each in self._states.items():
            each["state"].validate(strict_mode)
            for outcome in each["state"].get_outcomes():
                target = each["transitions"].get(outcome, outcome)
                if target not in self._states and target not in self._outcomes:
                    raise RuntimeError(f"{outcome} of {name} leads nowhere")
                ends.add(target)
        if strict_mode and self._outcomes - ends:
            raise RuntimeError(f"nothing ends with {self._outcomes - ends}")
        reached, waiting = {self._start}, [self._start]
        while waiting:
            targets = {*self._states[waiting.pop()]["transitions"].values()} - self._outcomes
            waiting += targets - reached
            reached |= targets
        if reached != {*self._states}:
            raise RuntimeError(f"nothing leads to { ({*self._states} - reached) }")

    def cancel_state(self) -> None:
        if self._current:
            self._states[self._current]["state"].cancel_state()

    def execute(self, blackboard: Blackboard) -> str:
        self.validate()
        self._current = self._start
        while True:
            each = self._states[self._current]
            outcome: str = each["state"](blackboard)
            outcome = each["transitions"].get(outcome, outcome)
            if outcome in self._outcomes:
                self._current = ""
                return outcome
            self._current = outcome


class Concurrence(State):
    """States that run together."""

    def __init__(
        self,
        states: dict[str, State],
        default_outcome: str,
        outcome_map: dict[str, dict[str, str]],
    ) -> None:
        super().__init__({*outcome_map, default_outcome})
        for needs in outcome_map.values():
            assert needs
            for name, outcome in needs.items():
                if outcome not in states[name].get_outcomes():
                    raise ValueError(f"{outcome} is no outcome of {name}")
        self._states = states
        self._default = default_outcome
        self._map = outcome_map

    def get_states(self) -> dict[str, State]:
        return self._states

    def get_outcome_map(self) -> dict[str, dict[str, str]]:
        return self._map

    def validate(self, strict_mode: bool = False) -> None:
        for state in self._states.values():
            state.validate(strict_mode)

    def cancel_state(self) -> None:
        for state in self._states.values():
            state.cancel_state()

    def execute(self, blackboard: Blackboard) -> str:
        ends: dict[str, str] = {}
        errors: list[Exception] = []

        def run(name: str, state: State) -> None:
            try:
                ends[name] = state(blackboard)
            except Exception as error:
                errors.append(error)

        threads = [threading.Thread(target=run, args=each) for each in self._states.items()]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if errors:
            raise errors[0]
        met = [
            outcome
            for outcome, needs in self._map.items()
            if all(ends[name] == end for name, end in needs.items())
        ]
        if len(met) > 1:
            raise RuntimeError(f"{met} at once")
        return met[0] if met else self._default
