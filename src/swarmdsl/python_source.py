"""Old name of `swarmdsl.codegen.python`; it will be removed."""

from swarmdsl.base.deprecated_names import moved

__getattr__ = moved(
    __name__, "swarmdsl.codegen.python", "swarmdsl.codegen.python", {"place": "source_place"}
)
