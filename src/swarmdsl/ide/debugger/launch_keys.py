"""Keys of launch configurations."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.suggest import did_you_mean
from swarmdsl.ide.debugger.messages import Arguments

MODEL_KEYS = ("program", "swarm", "machine", "scenario", "events", "world", "until")
"""Keys about a model, which a test file says itself."""
_KEYS = (*MODEL_KEYS, "test", "seed", "cwd", "speed", "realTime", "stopOnEntry", "noDebug")
_OF_CLIENTS = frozenset(("name", "type", "request", "mark", "restart"))


def misspelled(arguments: Arguments) -> Iterator[str]:
    """Yield a hint for each key that is not read, but looks like one: clients add their own."""
    for key in arguments:
        hint = did_you_mean(key, _KEYS) if key not in (*_KEYS, *_OF_CLIENTS) else None
        if hint:
            yield f"`{key}` in the launch configuration is not read: {hint}"
