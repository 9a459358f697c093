"""Measure work by what the interpreter executes, which no other work disturbs."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from types import FrameType


def executed(action: Callable[[], object]) -> int:
    """Return the number of executed instructions, which also counts iterations."""
    instructions = 0

    def count(frame: FrameType, event: str, _argument: object) -> object:
        nonlocal instructions
        instructions += event == "opcode"
        frame.f_trace_opcodes, frame.f_trace_lines = True, False
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        action()
    finally:
        sys.settrace(before)
    return instructions


def is_proportional(works: Sequence[int]) -> bool:
    """Return True if work grows linearly: from twice to four times as from once to twice."""
    once, twice, four_times = works
    return four_times - twice < 2.2 * (twice - once)
