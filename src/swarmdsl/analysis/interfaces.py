"""Old place of `resolve.interfaces`, for imports in `codegen`."""

from swarmdsl.analysis.resolve.interfaces import Interfaces

__all__ = ["Interfaces"]
