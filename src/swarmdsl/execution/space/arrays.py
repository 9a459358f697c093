"""Types of arrays in a space, with a value per row or per pair of rows."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Whole: TypeAlias = NDArray[np.int64]
Words: TypeAlias = NDArray[np.uint64]
Small: TypeAlias = NDArray[np.int8]
Rows: TypeAlias = NDArray[np.int64]
"""Indices of robots in all arrays of a stage."""
Part: TypeAlias = Any
"""Rows that move now: all of them as a slice, or indices."""
