"""Monitors of properties: deterministic automata with clocks, one for each property.

Standard library only, and nothing else of swarmdsl, so that generated packages can carry them.
A monitor knows nothing of robots: it gets the truth of each claim at each step of a run.
"""

from swarmdsl.execution.monitor.monitor import FALSE, OPEN, TRUE, Monitor, Sentence, Verdict
from swarmdsl.execution.monitor.patterns import Pattern, pattern_of

__all__ = ["FALSE", "OPEN", "TRUE", "Monitor", "Pattern", "Sentence", "Verdict", "pattern_of"]
