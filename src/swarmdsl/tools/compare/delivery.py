"""Compare two deliveries of an event by what receivers can rely on."""

from __future__ import annotations

from math import inf

from swarmdsl.ir import Delivery


def offers_less(before: Delivery | None, after: Delivery | None) -> bool:
    """Return True if receivers can rely on less than before in any respect.

    That is the direction that breaks: a receiver of ROS 2 hears who offers more than it asks for,
    but not who offers less. What is not said is what the nodes of ROS 2 do: they are reliable.
    """
    return any(
        was > now
        for was, now in zip(_offer(before or Delivery()), _offer(after or Delivery()), strict=True)
    )


def _offer(delivery: Delivery) -> tuple[float, ...]:
    """Return what a sender offers, each as a number of which more is better."""
    return (
        delivery.reliable is not False,
        delivery.latest,
        _kept(delivery),
        inf if delivery.lifespan is None else delivery.lifespan,
        -inf if delivery.deadline is None else -delivery.deadline,
    )


def _kept(delivery: Delivery) -> float:
    """Return the number of events that wait for a receiver."""
    if delivery.reliable is False:
        return 0
    without = 1 if delivery.latest else inf
    return delivery.keep if delivery.keep is not None else without
