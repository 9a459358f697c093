"""Stand-in for the engine, which generated packages get from `swarmdsl.execution.engine`."""

from swarmdsl.execution.engine import *  # noqa: F403
