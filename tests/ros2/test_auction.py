"""An auction on a real ROS 2: offers in an array, the cheapest wins, the others hear nothing."""

from __future__ import annotations

from typing import Any


def test_the_cheapest_robot_wins(ros: Any) -> None:
    """The auctioneer stores the offers of two robots, and tells one that it has won."""
    fakes = ros.fakes()
    fakes.publisher("/lab/go", "lab_msgs/msg/Order")
    for event in ("Asked", "Answer"):
        fakes.publisher(f"/lab/{event.lower()}", f"lab_events/msg/{event}Envelope")
    seller = ros.node("lab_behavior.auctioneer", "/lab/seller_0", member="seller[0]")
    dear, cheap = (
        ros.node("lab_behavior.bidder", f"/lab/worker_{n}", member=f"worker[{n}]", cost=cost)
        for n, cost in enumerate((3.5, 1.5))
    )
    seller.wait_in("Waiting")
    for worker in (dear, cheap):
        worker.wait_in("Free")
    fakes.listeners("/lab/asked", count=2)
    fakes.listeners("/lab/answer", count=3)
    fakes.listeners("/lab/go", count=3)

    fakes.publish("/lab/go")
    cheap.wait_in("Working")
    won = cheap.wait_for("Answer")
    assert won["data"] == {"name": "worker[1]", "speed": 2.0}
    assert won["envelope"]["sender"] == "seller[0]"
    assert seller.exit_code() == 0
    assert seller.trace[-1]["configuration"] == ["Sold"]
    (told,) = [line for line in seller.trace if line.get("to") == ["worker[1]"]]
    assert told["sent"] == ["Answer"]

    # What the other one hears first is what is published later, for all.
    fakes.publish("/lab/answer", sender="seller[0]", message={"name": "nobody"})
    dear.wait_in("Working")
    assert dear.wait_for("Answer")["data"]["name"] == "nobody"
