"""Search all states of a swarm once.

Usage: `python benchmarks/verify_once.py MODEL ROLE=N...`

Prints the numbers of states and transitions, the CPU seconds of the search alone, and how much the
process has grown in it, in bytes, as JSON.
"""

from __future__ import annotations

import json
import resource
import sys
from pathlib import Path
from time import process_time

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.search.explore import explore
from swarmdsl.execution.verify.swarm.model import Model, Options
from swarmdsl.execution.verify.swarm.network import Network


def main() -> None:
    """Search the states of the only swarm of a model."""
    path = Path(sys.argv[1])
    counts = {role: int(number) for role, _, number in (w.partition("=") for w in sys.argv[2:])}
    system = pipeline.check([path], find_settings([path], Diagnostics())).system
    assert system is not None
    (swarm,) = system.swarms
    budget = Budget(Limits(states=10_000_000))
    subject = Subject(swarm.name, system, swarm)
    model = Model(subject, counts, (), Options(), budget, Diagnostics())
    network = Network(model.groups(thorough=True), model.alphabet, 2, lossy=False)
    before, start = _size(), process_time()
    graph = explore(network, budget)
    seconds = process_time() - start
    json.dump([len(graph.seen), graph.transitions, seconds, _size() - before], sys.stdout)


def _size() -> int:
    """Return the memory in use; the greatest ever used may be that of the parent process."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize()


if __name__ == "__main__":
    main()
