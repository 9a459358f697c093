"""Type inference, conversions and constants of expressions."""

from swarmdsl.analysis.types.arrays import COUNT, QUERIES
from swarmdsl.analysis.types.built_ins import BUILT_INS
from swarmdsl.analysis.types.expressions import Typing, report_unknown_field
from swarmdsl.analysis.types.fitting import fits, is_float, is_number, range_of
from swarmdsl.analysis.types.forms import assignable, constant, item_of, stored_name

__all__ = [
    "BUILT_INS",
    "COUNT",
    "QUERIES",
    "Typing",
    "assignable",
    "constant",
    "fits",
    "is_float",
    "is_number",
    "item_of",
    "range_of",
    "report_unknown_field",
    "stored_name",
]
