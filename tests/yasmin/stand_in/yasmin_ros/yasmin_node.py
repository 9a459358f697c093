"""The node of YASMIN, which spins by itself."""

from __future__ import annotations

from threading import Thread
from typing import Any

import rclpy  # type: ignore[import-not-found]
from rclpy.executors import MultiThreadedExecutor  # type: ignore[import-not-found]


class YasminNode:
    """Keeps the one node that there is."""

    _instance: Any = None

    @classmethod
    def get_instance(cls) -> Any:
        if cls._instance is None:
            cls._instance = rclpy.create_node("yasmin_node")
            executor = MultiThreadedExecutor()
            executor.add_node(cls._instance)
            Thread(target=executor.spin, daemon=True).start()
        return cls._instance
