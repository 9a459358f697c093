"""Stand-in for module `values` of target `ros2`."""

from ...ros2.runtime.values import SECOND

__all__ = ('SECOND',)
