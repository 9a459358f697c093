"""Models run without a robot, on the engine of `swarmdsl.execution.engine`."""
