"""An engine in a package of its own: Ray, or what has its shape."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
import tomli

from swarmdsl.execution.experiments.engines import GROUP, cluster, local
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.store import Store
from swarmdsl.execution.experiments.task import Candidate, Task

from .conftest import Packed

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "tests" / "plugins" / "ray_engine"


class StandIn(ModuleType):
    """Stand-in for the part of Ray that the package uses, with a pool of processes."""

    def __init__(self) -> None:
        super().__init__("ray")
        self.said: list[str] = []

    def init(self, address: str, **_: Any) -> None:
        self.said.append(address)
        self._pool = ProcessPoolExecutor(2, get_context("spawn"))

    def cluster_resources(self) -> dict[str, float]:
        return {"CPU": 2.0}

    def remote(self, function: Callable[..., Any]) -> Any:
        def start(*args: Any, **named: Any) -> Any:
            future: Future[Any] = self._pool.submit(function, *args, **named)
            return SimpleNamespace(future=lambda: future)

        return SimpleNamespace(remote=start)

    def shutdown(self) -> None:
        self._pool.shutdown()
        self.said.append("shutdown")


def test_ray_gives_the_same_rows(
    packed: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With Ray if it is installed (`make test-ray`); the wheel is too large for each run."""
    is_real = find_spec("ray") is not None
    stand_in = StandIn()
    if not is_real:
        monkeypatch.setitem(sys.modules, "ray", stand_in)
    monkeypatch.syspath_prepend(PACKAGE)
    monkeypatch.delitem(sys.modules, "swarmdsl_ray", raising=False)
    project = tomli.loads((PACKAGE / "pyproject.toml").read_text())["project"]
    points = project["entry-points"][GROUP]
    info = tmp_path / "site" / "swarmdsl_ray-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: swarmdsl-ray\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{GROUP}]\nray = {points['ray']}\n")
    monkeypatch.syspath_prepend(tmp_path / "site")

    shipment = packed()
    tasks = [
        Task(shipment.digest, "scenario.toml", Candidate.of({"count of robot": n}), (1, 2, 3))
        for n in range(1, 5)
    ]
    with local(1) as engine, Store(tmp_path / "one" / "runs.sqlite") as store:
        one = Runs({shipment.digest: shipment}, engine, store).run(tasks)
    with cluster("ray://local") as engine, Store(tmp_path / "ray" / "runs.sqlite") as store:
        ray = Runs({shipment.digest: shipment}, engine, store).run(tasks)
        ran = {each.worker for each in store.all()}

    assert ray == one
    assert str(os.getpid()) not in ran
    assert is_real or stand_in.said == ["local", "shutdown"]


def test_the_page_shows_the_package() -> None:
    page = (ROOT / "docs" / "experiments.md").read_text(encoding="utf-8")
    assert (PACKAGE / "swarmdsl_ray.py").read_text(encoding="utf-8") in page
