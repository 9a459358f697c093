"""Section of a report about the settings that matter in a search."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.report.charts import Mean, main_effect
from swarmdsl.execution.experiments.report.page import Figure, Section, Table


@dataclass(frozen=True)
class Importance:
    """A setting with the means of the candidates that have some of its values.

    `share` is that of the variance between candidates which nothing but this setting explains, less
    what as many groups by chance would explain. None if nothing varies, or if there are too few
    candidates to tell.
    """

    setting: str
    share: float | None
    groups: tuple[tuple[str, float, int], ...]


def importance_section(found: Sequence[Importance], name: str) -> Section | None:
    """Return the section with the main effects of settings on a measure; None without any."""
    if not found:
        return None
    every = [mean for each in found for _, mean, _ in each.groups]
    span = Interval(min(every), max(every))
    caption = (
        f"Means of {name} over the candidates that were tried. Where a method tries more of the "
        "good ones, other settings differ between these means."
    )
    figures = [
        Figure(
            main_effect(
                each.setting, [Mean(label, mean, None) for label, mean, _ in each.groups], span
            ),
            caption,
        )
        for each in found
    ]
    rows = [(each.setting, share_text(each)) for each in found]
    head = ("setting", f"share of the differences in {name}")
    return Section(f"What matters for {name}", [Table(head, rows, frozenset((1,))), *figures])


def share_text(found: Importance) -> str:
    """Return the share of a setting for people."""
    return f"{100 * found.share:.1f} %" if found.share is not None else "-"
