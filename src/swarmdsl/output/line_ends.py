"""Line ends of files that people have too: those of Windows stay those of Windows."""

from __future__ import annotations


def like(other: bytes, text: bytes) -> bytes:
    """A generated text with the line ends that most lines of another one have."""
    of_windows = other.count(b"\r\n") * 2 > other.count(b"\n")
    return text.replace(b"\n", b"\r\n") if of_windows and b"\r" not in text else text


def plain(text: bytes) -> bytes:
    """A text with the line ends of generated ones."""
    return text.replace(b"\r\n", b"\n")
