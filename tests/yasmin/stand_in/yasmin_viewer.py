"""A stand-in for `yasmin_viewer`: says on `/fsm_viewer` which states are active."""

from __future__ import annotations

from typing import Any

from std_msgs.msg import String  # type: ignore[import-not-found]


class YasminViewerPub:
    """Publishes the current state of a machine."""

    def __init__(self, fsm: Any, fsm_name: str = "", rate: int = 4, node: Any = None) -> None:
        publisher = node.create_publisher(String, "/fsm_viewer", 10)
        node.create_timer(
            1 / rate,
            lambda: publisher.publish(String(data=f"{fsm_name} {fsm.get_current_state()}")),
        )
