"""Write plain values as TOML."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml_text(values: Mapping[str, Any]) -> str:
    """Return a document: values first, then each table that is not in an array."""
    return "".join(f"{line}\n" for line in _table((), values)).lstrip("\n")


def _table(above: tuple[str, ...], values: Mapping[str, Any]) -> Iterator[str]:
    plain = {name: value for name, value in values.items() if not isinstance(value, dict)}
    if above and (plain or not values):
        yield ""
        yield f"[{'.'.join(map(_key, above))}]"
    for name, value in plain.items():
        yield f"{_key(name)} = {_value(value)}"
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _table((*above, name), value)


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _string(name)


def _value(value: Any) -> str:
    match value:
        case bool():
            return str(value).lower()
        case str():
            return _string(value)
        case dict():
            pairs = (f"{_key(name)} = {_value(each)}" for name, each in value.items())
            return f"{{ {', '.join(pairs)} }}" if value else "{}"
        case list() | tuple():
            return f"[{', '.join(map(_value, value))}]"
    # Numbers, and dates as TOML writes them too.
    return str(value)


def _string(text: str) -> str:
    # TOML has the escapes of JSON, and control characters must be escaped, the last one too.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
