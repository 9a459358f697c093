"""Stand-in for the monitors, which generated packages get from `swarmdsl.execution.monitor`."""

from swarmdsl.execution.monitor import (
    FALSE,
    LOST,
    Measure,
    OPEN,
    Plan,
    Property,
    PropertyResult,
    TRUE,
    Watch,
)

__all__ = (
    'FALSE',
    'LOST',
    'OPEN',
    'TRUE',
    'Measure',
    'Plan',
    'Property',
    'PropertyResult',
    'Watch',
)
