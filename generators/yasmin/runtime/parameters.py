"""Stand-in for module `parameters` of target `ros2`."""

from ...ros2.runtime.parameters import Parameter

__all__ = ('Parameter',)
