"""Removal of stale files: the work for each file does not grow with the number of files."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.output.changes import WriteOptions
from swarmdsl.output.disk import Disk
from swarmdsl.output.manifest import Manifest
from swarmdsl.output.plan import Plan
from swarmdsl.output.removals import drop_stale


class Compared(str):
    """A path that counts how often it is compared."""

    __slots__ = ()
    times = 0

    def __eq__(self, other: object) -> bool:
        Compared.times += 1
        return str.__eq__(self, other)

    __hash__ = str.__hash__


def test_each_file_of_before_is_looked_up_once(tmp_path: Path) -> None:
    names = [f"t/{number}" for number in range(500)]
    before = Manifest(files={Compared(name): "hash" for name in names})
    plan = Plan(Disk(tmp_path), before, WriteOptions(), Diagnostics())
    plan.hashes = dict.fromkeys(names, "hash")
    Compared.times = 0
    drop_stale(plan, ["t"])
    assert 0 < Compared.times < 3 * len(names)
    assert not plan.changes
