"""Messages of the Debug Adapter Protocol: framing, and typed access to what clients send."""

from __future__ import annotations

import json
import os
import re
import threading
from collections.abc import Mapping
from typing import Any, TypeVar

from swarmdsl.ide.server.io import Incoming, Outgoing

T = TypeVar("T")
Arguments = Mapping[str, Any]
_LENGTH = re.compile(rb"Content-Length: (\d+)\r\n")


class RequestError(Exception):
    """A request cannot be answered; the message tells the user why."""


class Connection:
    """Messages from and to a client. `write` may be called from several threads."""

    def __init__(self, incoming: Incoming, outgoing: Outgoing) -> None:
        self._incoming = incoming
        self._outgoing = outgoing
        self._lock = threading.Lock()
        self._number = 0

    def read(self) -> Any:
        """Return the next message, any JSON; None at the end, and where the framing is wrong.

        What is no message at all is an empty one.
        """
        length = 0
        while (line := self._incoming.readline()).strip():
            found = _LENGTH.fullmatch(line)
            length = int(found[1]) if found is not None and len(found[1]) < 10 else length
        if not line or not length:
            return None
        try:
            message = json.loads(self._incoming.read(length))
        except (ValueError, RecursionError):
            return {}
        return {} if message is None else message

    def write(self, message: Mapping[str, Any]) -> None:
        """Write a message, with the next number."""
        with self._lock:
            self._number += 1
            text = json.dumps({"seq": self._number, **message}, ensure_ascii=False)
            body = text.encode("utf-8", "replace")
            self._outgoing.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))


def optional(arguments: Arguments, name: str, kind: type[T]) -> T | None:
    """Return an argument of a type, or None if it is left out.

    Raises RequestError for another type.
    """
    value = arguments.get(name)
    if value is None:
        return None
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise RequestError(f"`{name}` must be {_KINDS[kind]}")
    return value


def required(arguments: Arguments, name: str, kind: type[T]) -> T:
    """Return an argument of a type; raise RequestError if it is left out or of another one."""
    value = optional(arguments, name, kind)
    if value is None:
        raise RequestError(f"`{name}` is missing")
    return value


def speed_of(arguments: Arguments) -> float | None:
    """Return the speed at which time passes; None if it is as fast as it can."""
    speed = arguments.get("speed")
    if speed is None:
        return 1.0 if optional(arguments, "realTime", bool) else None
    if isinstance(speed, bool) or not isinstance(speed, (int, float)) or not 0 < speed <= 1000:
        raise RequestError("`speed` must be a number above 0, at most 1000")
    return float(speed)


def texts(arguments: Arguments, name: str) -> list[str]:
    """Return an argument that is a list of strings, or one string; empty if it is left out."""
    value = arguments.get(name)
    given = [value] if isinstance(value, str) else value if value is not None else []
    if not isinstance(given, list) or not all(isinstance(each, str) for each in given):
        raise RequestError(f"`{name}` must be a list of strings")
    return given


def as_path(text: str) -> str:
    """Return a text that can be a path; raise RequestError for another one."""
    try:
        os.fsencode(text)
    except UnicodeError:
        is_path = False
    else:
        is_path = "\0" not in text
    if not is_path:
        raise RequestError(f"{text!a} has characters that no path has")
    return text


_KINDS: Mapping[type[Any], str] = {
    str: "a string",
    int: "a whole number",
    bool: "true or false",
    dict: "an object",
    list: "a list",
}
