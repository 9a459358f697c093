"""Tests of the modules that a started server has imported."""

import subprocess
import sys

import pytest

from swarmdsl.ide.server.features import FEATURES, handlers_of

STARTED = """
import sys
from swarmdsl.ide.server.server import Server
Server(None)
print(*sys.modules)
"""


@pytest.mark.parametrize("module", FEATURES)
def test_handlers_match_features(module):
    assert handlers_of(module).keys() == FEATURES[module].keys()


def test_handlers_are_imported_later():
    ran = subprocess.run([sys.executable, "-c", STARTED], capture_output=True, text=True)
    modules = ran.stdout.split()
    assert "swarmdsl.ide.server.session" in modules
    late = {
        *(f"swarmdsl.ide.server.handlers.{module}" for module in FEATURES),
        "swarmdsl.syntax.formatter",
        "click",
    }
    assert late.isdisjoint(modules)
