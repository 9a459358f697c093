"""Sequential tests of properties with a chance, from many runs."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.execution.estimation.sequential import Region, SequentialTest
from swarmdsl.execution.monitor import FALSE, OPEN, TRUE
from swarmdsl.ir import Property


@dataclass(frozen=True)
class Level:
    """Level of intervals, and of the sequential test: half the region, and the two errors."""

    confidence: float = 0.95
    indifference: float = 0.02
    error: float = 0.05


class Chance:
    """Test of a property with a chance, in the order of the runs.

    A run that leaves the property open counts for neither decision: as a success where it could
    be low, and as a failure where it could be high.
    """

    def __init__(self, property_: Property, level: Level) -> None:
        assert property_.chance is not None
        self.region = Region.around(property_.chance.probability, level.indifference, level.error)
        self._least = property_.chance.bound == "least"
        self._pessimist = SequentialTest(self.region)
        self._optimist = SequentialTest(self.region)

    def add(self, verdict: str) -> None:
        """Process a run."""
        self._pessimist.add(success=verdict == TRUE)
        self._optimist.add(success=verdict != FALSE)

    @property
    def verdict(self) -> str:
        """True or false once the test has decided, else open."""
        if self._pessimist.decision == "high":
            return TRUE if self._least else FALSE
        if self._optimist.decision == "low":
            return FALSE if self._least else TRUE
        return OPEN

    @property
    def runs(self) -> int | None:
        """Number of runs after which the test decided."""
        if self._pessimist.decision == "high":
            return self._pessimist.runs
        return self._optimist.runs if self._optimist.decision == "low" else None
