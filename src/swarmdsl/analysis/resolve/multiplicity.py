"""Multiplicities of roles."""

from __future__ import annotations

from swarmdsl.syntax.ast import Role

MOST_DIGITS = 9
"""Number of digits of a multiplicity; with more, it is reported as wrong."""


def greatest(role: Role) -> int | None:
    """Return the greatest number of robots in a role; None if it is unlimited or wrong."""
    if role.multiplicity is None:
        return 1
    upper = role.multiplicity.upper or role.multiplicity.lower
    return int(upper) if upper.isdecimal() and len(upper) <= MOST_DIGITS else None
