"""Type inference, conversions and constants of expressions."""

from swarmdsl.analysis.types.arrays import COUNT, QUERIES
from swarmdsl.analysis.types.built_ins import BUILT_INS
from swarmdsl.analysis.types.expressions import Typing
from swarmdsl.analysis.types.fitting import fits, is_float, is_number, range_of
from swarmdsl.analysis.types.forms import assignable, constant, item_of, stored_name
from swarmdsl.analysis.types.unit_checks import check_types
from swarmdsl.analysis.types.unit_rules import of_field
from swarmdsl.analysis.types.unknown_fields import report_unknown_field

__all__ = [
    "BUILT_INS",
    "COUNT",
    "QUERIES",
    "Typing",
    "assignable",
    "check_types",
    "constant",
    "fits",
    "is_float",
    "is_number",
    "item_of",
    "of_field",
    "range_of",
    "report_unknown_field",
    "stored_name",
]
