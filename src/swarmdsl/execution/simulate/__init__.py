"""Simulate models without a robot, on `swarmdsl.execution.engine`."""
