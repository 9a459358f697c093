"""Hooks that make the tests fast: distribution to workers, order, garbage collection."""

from __future__ import annotations

import gc
from collections.abc import Iterable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

# Files that write to one folder of the checkout, or share a fixture that is slow to make.
TOGETHER = ("tests/editors/",)
# They need ROS 2, whose interfaces may still be built when the tests begin.
LATER = (
    "tests/ros2/", "tests/skeleton/test_ros2_run.py", "tests/docs/test_tutorial.py",
    "tests/injection/test_real_readers.py",
)  # fmt: skip
# Their tests wait for processes, often long: they are not to be the last ones.
WAITING = {"editors", "preview", "ros1", "ros2", "skeleton"}

gc.disable()  # until all tests are collected: hardly anything of them is garbage


def unit(nodeid: str) -> str:
    """The file of a test, or the folder whose tests share a worker."""
    file = nodeid.partition("::")[0]
    return next((folder for folder in TOGETHER if file.startswith(folder)), file)


def spread(units: Iterable[str]) -> dict[str, float]:
    """The place of each unit between 0 and 1, at even distances within its folder.

    Folders whose tests wait are through a little earlier, what needs ROS 2 begins later.
    """
    folders: dict[str, list[str]] = {}
    for each in dict.fromkeys(units):
        folders.setdefault(each.split("/")[1], []).append(each)
    places = {
        each: (number + 0.5) / len(found) * (0.8 if folder in WAITING else 1)
        for folder, found in folders.items()
        for number, each in enumerate(found)
    }
    return {
        each: 0.3 + 0.5 * place if each.startswith(LATER) else place
        for each, place in places.items()
    }


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Run each file on one worker, so that its fixtures are made once."""
    if config.getoption("dist") != "load":  # the default
        return None
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return unit(nodeid)

    config.option.loadscopereorder = False  # the order of `pytest_collection_modifyitems`
    return Scheduling(config, log)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Begin with the slow tests on several workers, so that these end at about the same time.

    Tests of each folder are spread over the run: some folders wait for nodes while others compute.
    """
    if not config.getoption("--thorough"):
        left_out = [item for item in items if item.get_closest_marker("thorough")]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if not item.get_closest_marker("thorough")]
    if hasattr(config, "workerinput"):
        units = [unit(item.nodeid) for item in items]
        places = spread(units)
        keys = {
            id(item): (
                item.get_closest_marker("long") is None or each.startswith(LATER),
                places[each],
            )
            for item, each in zip(items, units, strict=True)
        }
        items.sort(key=lambda item: keys[id(item)])


def pytest_collection_finish() -> None:
    """Exempt what pytest has made so far from garbage collection.

    Programs under test collect garbage, which would walk all of it each time. Models are large
    and leave hardly any, so it is looked for less often than by default.
    """
    _begin_hypothesis()
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000)
    gc.enable()


@settings(max_examples=1)
@given(st.none())
def _begin_hypothesis(_: None) -> None:
    """Let Hypothesis register its source of chance, for which it asks the garbage collector."""
