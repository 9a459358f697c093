"""Line ends of files that the user shares: CRLF stays CRLF."""

from __future__ import annotations


def like(other: bytes, text: bytes) -> bytes:
    """Convert generated content to the line ends of most lines of `other`."""
    of_windows = other.count(b"\r\n") * 2 > other.count(b"\n")
    return text.replace(b"\n", b"\r\n") if of_windows and b"\r" not in text else text


def plain(text: bytes) -> bytes:
    """Convert content to LF line ends."""
    return text.replace(b"\r\n", b"\n")
