"""Old name of `swarmdsl.codegen.xml`; it will be removed."""

from swarmdsl.base.deprecated_names import moved

__getattr__ = moved(__name__, "swarmdsl.base.xml_writer", "swarmdsl.codegen.xml")
