"""Names and values of ROS parameters in YAML files."""

from __future__ import annotations

import json

_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}

_TRUTH = frozenset(("y", "n", "yes", "no", "on", "off", "true", "false", "null"))


def yaml_value(value: object) -> str:
    """Return a value in YAML 1.1, on one line.

    A string is quoted. In JSON, whose strings are nearly the same, a character above U+FFFF is two
    escapes, which YAML reads as two characters, and a line separator is none, where YAML ends a
    line.
    """
    if isinstance(value, str):
        return f'"{"".join(map(_character, value))}"'
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(yaml_value, value))}]"
    text = json.dumps(value)
    number, exponent, power = text.partition("e")
    if isinstance(value, float) and exponent and "." not in number:
        return f"{number}.0e{power}"  # a number with an exponent needs a point
    return text


def yaml_key(name: str) -> str:
    """Return a name as a key; some names are truth values in YAML 1.1."""
    return f'"{name}"' if name.lower() in _TRUTH else name


def _character(character: str) -> str:
    if character in _ESCAPES:
        return _ESCAPES[character]
    if character.isprintable():
        return character
    code = ord(character)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
