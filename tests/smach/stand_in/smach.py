"""A stand-in for smach 2.5: its rules of construction, and running without its logging.

Written from its documented behaviour, for tests where the real one is not installed;
test_stand_in.py holds it against the real one. What that one does otherwise than documented it does
as well where DEFECTS has the name of it: `lost-preempt`, a Concurrence that is preempted before it
waits for its children waits for ever; `fall-through`, an outcome that is not bound ends the
container by that name.
"""

from __future__ import annotations

import os
import threading

DEFECTS = set(filter(None, os.environ.get("SMACH_STAND_IN_DEFECTS", "").split(",")))


class InvalidStateError(Exception):
    pass


class InvalidTransitionError(Exception):
    pass


class InvalidUserCodeError(Exception):
    pass


def is_shutdown():
    return _is_shutdown()


def _is_shutdown():
    return False


def set_shutdown_check(check):
    global _is_shutdown
    _is_shutdown = check


class UserData:
    def __init__(self):
        object.__setattr__(self, "_data", {})

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self._data[name]

    def __setattr__(self, name, value):
        self._data[name] = value

    def __getitem__(self, name):
        return self._data[name]

    def __setitem__(self, name, value):
        self._data[name] = value

    def __contains__(self, name):
        return name in self._data

    def keys(self):
        return list(self._data)


class Remapper:
    """Lets a state reach the keys it declared; the real one only logs a forbidden write."""

    def __init__(self, userdata, input_keys=(), output_keys=(), remapping=None):
        state = (userdata, set(input_keys), set(output_keys), dict(remapping or {}))
        object.__setattr__(self, "_state", state)

    def __getattr__(self, name):
        userdata, inputs, _, remapping = self._state
        if name not in inputs:
            raise InvalidUserCodeError(f"{name} is read but not declared")
        return userdata[remapping.get(name, name)]

    def __setattr__(self, name, value):
        userdata, _, outputs, remapping = self._state
        if name not in outputs:
            raise InvalidUserCodeError(f"{name} is written but not declared")
        userdata[remapping.get(name, name)] = value

    __getitem__ = __getattr__
    __setitem__ = __setattr__

    def __contains__(self, name):
        userdata, inputs, _, remapping = self._state
        return name in inputs and remapping.get(name, name) in userdata


class State:
    def __init__(self, outcomes=(), input_keys=(), output_keys=(), io_keys=()):
        self._outcomes = set(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}
        self._preempt_requested = False

    def get_registered_outcomes(self):
        return tuple(self._outcomes)

    def get_registered_input_keys(self):
        return tuple(self._input_keys)

    def get_registered_output_keys(self):
        return tuple(self._output_keys)

    def register_output_keys(self, keys):
        self._output_keys |= {*keys}

    def request_preempt(self):
        self._preempt_requested = True

    def service_preempt(self):
        self._preempt_requested = False

    def recall_preempt(self):
        self._preempt_requested = False

    def preempt_requested(self):
        return self._preempt_requested


class _Container(State):
    _open: list = []

    def __init__(self, outcomes, input_keys=(), output_keys=()):
        super().__init__(outcomes, input_keys, output_keys)
        self.userdata = UserData()
        self._states = {}
        self._remappings = {}

    def __enter__(self):
        _Container._open.append(self)
        return self

    def __exit__(self, kind, error, trace):
        assert _Container._open.pop() is self
        if kind is None:
            self.check_consistency()

    @classmethod
    def _opened(cls, label):
        container = _Container._open[-1]
        assert isinstance(container, cls), f"add to {container} as if it were a {cls}"
        if label in container._states:
            raise InvalidStateError(f"label {label} is taken")
        return container

    def get_children(self):
        return self._states

    def __getitem__(self, label):
        return self._states[label]

    def _run_child(self, label):
        child = self._states[label]
        keys = (child.get_registered_input_keys(), child.get_registered_output_keys())
        outcome = child.execute(Remapper(self.userdata, *keys, self._remappings[label]))
        if outcome not in child.get_registered_outcomes():
            raise InvalidTransitionError(f"{label} ended with {outcome}")
        return outcome

    def _copy_input_keys(self, parent):
        for key in self._input_keys if parent is not None else ():
            if key in parent:
                self.userdata[key] = parent[key]

    def _copy_output_keys(self, parent):
        for key in self._output_keys if parent is not None else ():
            if key in self.userdata:
                parent[key] = self.userdata[key]

    def call_start_cbs(self):
        pass

    def call_transition_cbs(self):
        pass

    def call_termination_cbs(self, terminal_states, outcome):
        pass


class StateMachine(_Container):
    def __init__(self, outcomes, input_keys=(), output_keys=()):
        super().__init__(outcomes, input_keys, output_keys)
        self._lock = threading.Lock()
        self._initial_state_label = None
        self._transitions = {}
        self._current = None
        self._preempted = None
        self._running = False

    @staticmethod
    def add(label, state, transitions=None, remapping=None):
        machine = StateMachine._opened(label)
        for outcome in transitions or {}:
            if outcome not in state.get_registered_outcomes():
                raise InvalidTransitionError(f"{label} has no outcome {outcome}")
        machine._initial_state_label = machine._initial_state_label or label
        machine._states[label] = state
        machine._transitions[label] = dict(transitions or {})
        machine._remappings[label] = dict(remapping or {})
        return state

    def set_initial_state(self, labels):
        (self._initial_state_label,) = labels

    def get_initial_states(self):
        return [self._initial_state_label]

    def get_internal_edges(self):
        return [
            (outcome, label, target)
            for label, transitions in self._transitions.items()
            for outcome, target in transitions.items()
        ]

    def check_consistency(self):
        known = {*self._states, *self._outcomes}
        if self._initial_state_label not in self._states:
            raise InvalidStateError(f"initial state {self._initial_state_label}")
        for label, transitions in self._transitions.items():
            unbound = set(self._states[label].get_registered_outcomes()) - transitions.keys()
            if "fall-through" in DEFECTS:
                unbound -= self._outcomes
            if unbound:
                raise InvalidTransitionError(f"{label} leaves {unbound} unbound")
            for target in transitions.values():
                if target not in known:
                    raise InvalidTransitionError(f"{label} leads to {target}")

    def is_running(self):
        return self._running

    def execute(self, parent_ud=None):
        self.check_consistency()
        self._copy_input_keys(parent_ud)
        with self._lock:
            self._preempted = None
            self._current = self._initial_state_label
            self._running = True
        try:
            while True:
                outcome = self._step()
                if outcome is not None:
                    self._copy_output_keys(parent_ud)
                    return outcome
        finally:
            self._running = False

    def _step(self):
        with self._lock:
            label = self._current
            if self._preempt_requested:
                if self._preempted is None or self._preempted.preempt_requested():
                    self._preempt_current()
                else:
                    self._preempt_requested = False
                    self._preempted = None
            state = self._states[label]
        outcome = self._run_child(label)
        with self._lock:
            target = self._transitions[label].get(outcome, outcome)
            if target in self._states:
                self._current = target
                return None
            preempting = self._preempt_requested and self._preempted is not None
            if preempting and not state.preempt_requested():
                self.service_preempt()
            self._current = None
            return target

    def request_preempt(self):
        with self._lock:
            self._preempt_requested = True
            if self._current is not None:
                self._preempt_current()

    def _preempt_current(self):
        state = self._states[self._current]
        if state is not self._preempted:
            if self._preempted is not None:
                self._preempted.recall_preempt()
            self._preempted = state
            state.request_preempt()


class Concurrence(_Container):
    def __init__(
        self,
        outcomes,
        default_outcome=None,
        input_keys=(),
        output_keys=(),
        outcome_map=None,
        outcome_cb=None,
        child_termination_cb=None,
    ):
        super().__init__(outcomes, input_keys, output_keys)
        self._outcome_map = dict(outcome_map or {})
        if default_outcome not in outcomes or not self._outcome_map.keys() <= set(outcomes):
            raise InvalidStateError("an outcome that is not declared")
        self._default_outcome = default_outcome
        self._outcome_cb = outcome_cb
        self._child_termination_cb = child_termination_cb
        self._child_outcomes = {}
        self._is_over = False
        self._failure = None
        self._done_cond = threading.Condition()

    @staticmethod
    def add(label, state, remapping=None):
        concurrence = Concurrence._opened(label)
        concurrence._states[label] = state
        concurrence._remappings[label] = dict(remapping or {})
        return state

    def get_internal_edges(self):
        return [
            (outcome, label, ends_with)
            for ends_with, criteria in self._outcome_map.items()
            for label, outcome in criteria.items()
        ]

    def check_consistency(self):
        for criteria in self._outcome_map.values():
            for label, outcome in criteria.items():
                if outcome not in self._states[label].get_registered_outcomes():
                    raise InvalidTransitionError(f"{label} has no outcome {outcome}")

    def request_preempt(self):
        super().request_preempt()
        with self._done_cond:
            self._done_cond.notify_all()

    def execute(self, parent_ud=None):
        self.check_consistency()
        self._copy_input_keys(parent_ud)
        self._child_outcomes = dict.fromkeys(self._states)
        self._is_over, self._failure = False, None
        threads = [
            threading.Thread(target=self._run_thread, args=(label,), daemon=True)
            for label in self._states
        ]
        early = self._preempt_requested
        for thread in threads:
            thread.start()
        with self._done_cond:
            while not self._is_over and (
                not self._preempt_requested or (early and "lost-preempt" in DEFECTS)
            ):
                self._done_cond.wait()
        for label, child in self._states.items():
            if self._child_outcomes[label] is None:
                child.request_preempt()
        for thread in threads:
            thread.join()
        if self._failure is not None:
            raise InvalidStateError("a state failed") from self._failure
        outcome = self._outcome()
        self._child_outcomes = {}
        self._copy_output_keys(parent_ud)
        return outcome

    def _run_thread(self, label):
        outcome = failure = None
        try:
            outcome = self._run_child(label)
        except Exception as error:
            failure = error
        with self._done_cond:
            self._child_outcomes[label] = outcome
            self._failure = self._failure or failure
            ended = self._child_termination_cb or (
                lambda outcomes: all(each is not None for each in outcomes.values())
            )
            if self._failure or ended(dict(self._child_outcomes)):
                self._is_over = True
            if all(each is not None for each in self._child_outcomes.values()):
                self._is_over = True
            self._done_cond.notify_all()

    def _outcome(self):
        if self._preempt_requested:
            if not any(child.preempt_requested() for child in self._states.values()):
                self.service_preempt()
                return "preempted"
            for child in self._states.values():
                child.recall_preempt()
        chosen, most = self._default_outcome, 0
        for outcome, criteria in self._outcome_map.items():
            holds = all(self._child_outcomes[label] == each for label, each in criteria.items())
            if holds and len(criteria) > most:
                chosen, most = outcome, len(criteria)
        if self._outcome_cb is not None:
            return self._outcome_cb(dict(self._child_outcomes)) or chosen
        return chosen
