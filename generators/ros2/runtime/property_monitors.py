"""Stand-in for the monitors, which generated packages get from `swarmdsl.execution.monitor`."""

from swarmdsl.execution.monitor import FALSE, LOST, OPEN, Property, TRUE, Watch

__all__ = ('FALSE', 'LOST', 'OPEN', 'TRUE', 'Property', 'Watch')
