"""Parts of patterns that find mistakes."""

from __future__ import annotations

import re

from swarmdsl.syntax.units import UNITS

START = r"(?:^|[{;]) *"
DELAY = r"\d+(?:\.\d+)? *(?:us|ms|s|min|h)"
UNIT = "|".join(sorted(map(re.escape, UNITS), key=len, reverse=True))
_SETTING = r"(?:reliable|latest|best[ \t]+effort|(?:keep|lifespan|deadline)[ \t]+[\w. ]+)"
DELIVERY = rf"{_SETTING}(?:[ \t]*,?[ \t]*{_SETTING})*"
"""Settings of the delivery of an event."""
