"""The grammar for tree-sitter, compiled."""

from __future__ import annotations

import atexit
import ctypes
import shutil
import subprocess
import tempfile
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "editors" / "tree-sitter"
QUERIES = FOLDER / "queries"


@cache
def language() -> Any:
    """Compile the parser as editors do, without a warning."""
    tree_sitter = pytest.importorskip(
        "tree_sitter", reason="no tree-sitter: pip install tree-sitter"
    )
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no compiler of C: apt-get install gcc libc6-dev")
    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder)
    built = Path(folder) / "swarm.so"
    sources = [str(FOLDER / "src" / name) for name in ("parser.c", "scanner.c")]
    options = ["-O0", "-std=c11", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter"]
    subprocess.run([compiler, *options, "-shared", "-fPIC", "-o", str(built), *sources], check=True)
    made = ctypes.CDLL(str(built)).tree_sitter_swarm
    made.restype = ctypes.c_void_p
    with warnings.catch_warnings():  # about an address that is no capsule
        warnings.simplefilter("ignore", DeprecationWarning)
        return tree_sitter.Language(made())
