"""Tools that tests which did not run lack, told in one line at the end."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

# The reason of a skipped test that needs something: "no ROS 2: `make test-ros2`".
_REASON = re.compile(r"(?:Skipped: )?no (?P<part>[^:;(]+?)(?: here)?(?=[:;(]| \()")


def absent(reasons: Iterable[str]) -> str | None:
    """Return the line for the reasons of skipped tests, None if they lack nothing."""
    found = filter(None, map(_REASON.match, reasons))
    lacking = Counter(each["part"] for each in found)
    if not lacking:
        return None
    parts = ", ".join(f"{count} without {part}" for part, count in lacking.most_common())
    return f"not run here: {lacking.total()} of the tests, {parts}"
