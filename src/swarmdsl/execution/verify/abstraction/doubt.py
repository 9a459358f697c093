"""Reasons why a proof does not show everything."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span


@dataclass(frozen=True)
class Doubt:
    """Reason why a proof is not complete, with its place in the model.

    If it only adds `more` runs, those that were looked at are possible all the same.
    """

    reason: str
    place: Span | None = None
    more: bool = False
