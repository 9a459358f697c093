"""Breakpoints on states and transitions of diagrams, which stay when the text changes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

from swarmdsl.base.source import Span
from swarmdsl.ide.debugger.messages import RequestError
from swarmdsl.ide.preview.adapter import Adapter
from swarmdsl.ide.server.positions import position

Stops = Mapping[tuple[str, str], Span]
"""Places of states and transitions, by diagram and id."""


class Breakpoints:
    """Breakpoints that pages have set."""

    def __init__(self) -> None:
        self._set: dict[tuple[str, str], None] = {}
        self._stops: Stops = {}
        self._files: set[str] = set()
        """Files in which the adapter knows some."""

    def learn(self, stops: Stops) -> bool:
        """Take the elements of a new text; return True if breakpoints have gone with others."""
        kept = {each: None for each in self._set if each in stops}
        is_less = len(kept) < len(self._set)
        self._stops, self._set = stops, kept
        return is_less

    def toggle(self, wish: Mapping[str, Any]) -> None:
        """Set a breakpoint, or remove it; raise RequestError for what no run can stop at."""
        diagram, element = wish.get("diagram"), wish["breakpoint"]
        if not isinstance(diagram, str) or not isinstance(element, str):
            raise RequestError("a breakpoint is on a `breakpoint` of a `diagram`")
        if (diagram, element) not in self._stops:
            raise RequestError(f"there is no state or transition `{element}` in `{diagram}`")
        if (diagram, element) in self._set:
            del self._set[diagram, element]
        else:
            self._set[diagram, element] = None

    def clear(self) -> None:
        """Remove all of them."""
        self._set.clear()

    def shown(self) -> Mapping[str, Sequence[str]]:
        """Return their elements by diagram."""
        found: dict[str, list[str]] = defaultdict(list)
        for diagram, element in self._set:
            found[diagram].append(element)
        return found

    def send(self, adapter: Adapter, *, is_new: bool = False) -> None:
        """Send them to a debug adapter, which knows none yet if it is new."""
        asked: dict[str, list[Mapping[str, int]]] = {}
        if not is_new:
            asked.update((file, []) for file in self._files)
        for each in self._set:
            at = self._stops[each].absolute
            line, column = position(at.source, at.start)
            found = asked.setdefault(str(at.source.path), [])
            found.append({"line": line + 1, "column": column + 1})
        for file, places in asked.items():
            adapter.request("setBreakpoints", {"source": {"path": file}, "breakpoints": places})
        self._files = set(asked)
