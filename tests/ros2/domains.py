"""Domains of ROS 2, in which nodes find each other: each for one test at a time."""

from __future__ import annotations

import fcntl
import itertools
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

# Beyond these, ports of the middleware may be taken by other programs.
_FIRST, _COUNT = 20, 80
_worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0")[2:])
# Workers are far from each other: a node that was killed stays known in its domain for seconds.
_turns = itertools.count(os.getpid() + 40 * _worker)


@contextmanager
def free_domain() -> Iterator[int]:
    """Hold a domain that no other process of these tests uses."""
    for turn in _turns:
        number = _FIRST + turn % _COUNT
        with Path(tempfile.gettempdir(), f"swarmdsl-domain-{number}").open("a") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield number
            return
