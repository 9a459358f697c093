"""A stand-in for smach_ros 3, of which generated packages use the server for introspection."""

from __future__ import annotations

from typing import Any

import rclpy  # type: ignore[import-not-found]

import smach  # type: ignore[import-not-found]

smach.set_shutdown_check(lambda: not rclpy.ok())
if hasattr(smach, "set_loggers"):  # not in the stand-in
    logger = rclpy.logging.get_logger("smach")
    smach.set_loggers(logger.info, logger.warning, logger.debug, logger.error)


class IntrospectionServer:
    """Takes what the real one takes; nobody looks at the machine."""

    def __init__(self, server_name: str, state: Any, path: str) -> None:
        """Know what is to be shown."""

    def start(self) -> None:
        """Show nothing."""
