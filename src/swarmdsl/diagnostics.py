"""Old name of `swarmdsl.codegen`; it will be removed."""

from swarmdsl.base.deprecated_names import moved

__getattr__ = moved(__name__, "swarmdsl.base.diagnostics.collector", "swarmdsl.codegen")
