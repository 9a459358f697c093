"""Objects of the compiler are freed without garbage collection."""

import gc
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

EXAMPLES = Path(__file__).parents[1] / "examples"


@pytest.mark.parametrize("folder", sorted(path for path in EXAMPLES.iterdir() if path.is_dir()))
def test_a_check_leaves_no_garbage(folder):
    gc.collect()
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        result = pipeline.check([folder])
        gc.set_debug(gc.DEBUG_SAVEALL)
        gc.collect()
        left = {type(each) for each in gc.garbage}
        assert not {each for each in left if each.__module__.startswith("swarmdsl")}
        assert result.files
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        if was_enabled:
            gc.enable()
