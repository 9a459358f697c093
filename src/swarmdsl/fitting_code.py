"""Whether a file of the user fits what is generated beside it.

Such a file says with `swarmc:fits MARK` what it was written for: MARK stands for all of the model
that its code builds on. The person who has adapted the code writes the new mark there.
"""

from __future__ import annotations

import re

_MARK = re.compile(rb"swarmc:fits ([0-9a-f]{8})\b")


def outdated(of_user: bytes, generated: bytes) -> tuple[str, str] | None:
    """The mark in the user's file and the one it should have; None where it fits or has none."""
    written, wanted = _MARK.search(of_user), _MARK.search(generated)
    if written is None or wanted is None or written[1] == wanted[1]:
        return None
    return written[1].decode(), wanted[1].decode()
