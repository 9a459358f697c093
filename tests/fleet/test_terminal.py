"""Keys in the terminal of a fleet."""

from __future__ import annotations

import os
import pty
import tty

import pytest

from swarmdsl.ide.fleet.terminal import pressed


@pytest.mark.parametrize(
    ("typed", "keys"),
    [
        ("1", ["1"]),
        ("12", ["1", "2"]),
        # An arrow, `Delete`, F5 and Alt+1 send no event, and hide no key that comes after them.
        ("\x1b[A1", ["1"]),
        ("\x1b[3~2", ["2"]),
        ("\x1b[15~\x1bOP\x1b1", []),
        ("\u00e41\x1b", ["\u00e4", "1"]),
        ("\x1b\x1b[3~2", ["2"]),
    ],
)
def test_each_key_is_seen_at_once(typed: str, keys: list[str]) -> None:
    person, terminal = pty.openpty()
    try:
        tty.setcbreak(terminal)
        os.write(person, typed.encode())
        assert [*pressed(terminal, 5.0)] == keys
        assert pressed(terminal, 0.0) == ""
    finally:
        os.close(person)
        os.close(terminal)
