"""Types of expressions: what follows from their parts, and what can be used where."""

from swarmdsl.inference.expressions import Typing, report_unknown_field
from swarmdsl.inference.fitting import fits, is_float, is_number, range_of
from swarmdsl.inference.forms import assignable, constant

__all__ = [
    "Typing",
    "assignable",
    "constant",
    "fits",
    "is_float",
    "is_number",
    "range_of",
    "report_unknown_field",
]
