"""Errors of the command line and of plugins."""

from __future__ import annotations


class UsageError(Exception):
    """Raised for a command line that makes no sense, before anything is done."""


def describe_exception(action: str, error: BaseException) -> str:
    """Describe an exception of third-party code in one line: `ValueError: not a number`.

    The traceback goes to the log, which `--debug` shows, under the name of the action.
    """
    import logging  # slow to import, and seldom needed

    logging.getLogger(__name__).debug(action, exc_info=error)
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
