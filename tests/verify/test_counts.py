"""Numbers of states, as other model checkers count them on the same model."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest

from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.search.explore import explore
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.network import Network

from .conftest import model_of

# rumur without symmetry, on a model of emergency_exit written by hand, with a queue of two.
ALL = {4: 9_488}
# Orbits of the same, as rumur with symmetry counts them for 4, 6 and 8 robots.
ORBITS = {3: 187, 4: 661, 6: 4_894, 8: 24_122}


@pytest.mark.parametrize(("robots", "states"), ORBITS.items())
def test_equal_robots_are_counted(examples: Path, robots: int, states: int) -> None:
    found = survey(model_of(examples / "emergency_exit", {"robot": robots}), Budget(Limits()))

    assert (found.states, found.missing, found.findings) == (states, "", ())


@pytest.mark.parametrize(("robots", "states"), ALL.items())
def test_robots_by_themselves_have_all_states(examples: Path, robots: int, states: int) -> None:
    model = model_of(examples / "emergency_exit", {"robot": robots})
    (group,) = model.groups(thorough=True)
    alone = [Group(group.automaton, (name,)) for name in group.robots]

    network = Network(alone, model.alphabet, model.options.capacity, lossy=False)

    assert len(explore(network, Budget(Limits())).seen) == states


def test_independent_robots_are_looked_at_one_by_one(examples: Path) -> None:
    few = survey(model_of(examples / "search_and_rescue"), Budget(Limits()))
    many = survey(
        model_of(examples / "search_and_rescue", {"uav": 8, "rover": 5}), Budget(Limits())
    )

    assert few.states == many.states == 12


def test_states_take_less_than_a_hundred_bytes_each(examples: Path) -> None:
    model = model_of(examples / "emergency_exit", {"robot": 8})
    network = Network(model.groups(thorough=True), model.alphabet, 2, lossy=False)
    tracemalloc.start()
    graph = explore(network, Budget(Limits()))
    used, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert used / len(graph.seen) < 100
