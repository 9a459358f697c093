"""Bundled generators, one package a target.

In a checkout they are in the top-level folder `generators/`, in an installed
package beside this file.
"""

from swarmdsl.base.resources import checkout_root

_root = checkout_root()
if _root is not None:
    __path__.append(str(_root / "generators"))
