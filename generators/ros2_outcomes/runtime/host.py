"""Stand-in for module `host` of target `ros2`."""

from ...ros2.runtime.host import Host

__all__ = ('Host',)
