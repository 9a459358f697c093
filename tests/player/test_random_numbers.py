"""Random numbers of the page are those of the simulator."""

from __future__ import annotations

import json
from pathlib import Path

from swarmdsl.execution.simulate.scenario.durations import Fixed, Normal, Uniform
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.tools.player.engine_world import _length

from .engine_in_page import needs_node, node


@needs_node
def test_streams(tmp_path: Path) -> None:
    second = 10**9
    lengths = [Fixed(7), Uniform(second, 9 * second), Normal(4 * second, second), Normal(0, second)]
    words = [("uav[0]", "search", 1), ("", "to", "é" * 60, 12), ("x" * 55,), ("x" * 119, 3)]
    questions = [
        (length, count, str(seed), *each)
        for length in lengths
        for count, seed in ((1, 0), (700, 2**60), (5, 3))
        for each in words
    ]
    line = json.dumps([[_length(length), *rest] for length, *rest in questions])
    (found,) = node("numbers.js", [line], tmp_path)
    for (length, count, seed, *each), (numbers, drawn) in zip(questions, found, strict=True):
        stream = RandomSource(int(seed)).stream(*each)
        assert numbers == [stream.random() for _ in range(count)]
        assert drawn == str(length.draw(stream))
