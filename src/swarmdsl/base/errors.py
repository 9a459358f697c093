"""What is said of a failure in the code of others: of generators, their options, and libraries."""

from __future__ import annotations


def failure(doing: str, error: BaseException) -> str:
    """An exception in one line, for a person; `--debug` shows where it comes from."""
    import logging  # is slow to import, and hardly ever needed

    logging.getLogger(__name__).debug(doing, exc_info=error)
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
