"""Events from outside, as JSON Lines."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import fits_64_bits, integer
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.inputs.values import MisfitError, fitted, kind
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND

STDIN = "<stdin>"
_KEYS = ("event", "after", "member", "data", "sender")
_LONGEST = 2**63 // MILLISECOND


@dataclass(frozen=True)
class Input:
    """Event, the time to wait before it, and the machines that receive it.

    `sender` is the robot in whose name it comes, empty for an event from outside of the swarm.
    """

    event: str
    after: int
    data: Any
    to: tuple[Actor, ...]
    sender: str = ""


class Reader:
    """Parse lines, and report errors with their spans."""

    def __init__(self, subject: Subject, actors: Iterable[Actor], report: Diagnostics) -> None:
        self._subject = subject
        self._actors = list(actors)
        self.report = report

    def file(self, source: Source) -> list[Input]:
        """Parse all lines of a file; skip empty ones."""
        found: list[Input] = []
        for start, end in zip(source.line_starts, [*source.line_starts[1:], None], strict=True):
            place = Span(source, start, len(source.text) if end is None else end - 1)
            read = self._line(place)
            if read is not None:
                found.append(read)
        return found

    def stream(self, lines: Iterable[bytes]) -> Iterator[Input | None]:
        """Parse the lines of a stream as they arrive; None for an invalid one."""
        for number, line in enumerate(lines):
            before = "\n" * number
            text = before + line.decode("utf-8", "replace").rstrip("\r\n")
            place = Span(Source(STDIN, text), number, len(text))
            read = self._line(place)
            if read is not None or place.text.strip():
                yield read

    def _line(self, place: Span) -> Input | None:
        text = place.text
        if not text.strip():
            return None
        try:
            value = json.loads(
                text,
                parse_constant=_no_number,
                parse_int=_whole,
                parse_float=_real,
                object_pairs_hook=_fields,
            )
        except json.JSONDecodeError as error:
            start = place.start + min(error.pos, max(len(text) - 1, 0))
            reason = error.msg[:1].lower() + error.msg[1:]
            self._bad(Span(place.source, start, min(start + 1, place.end)), reason)
            return None
        except RecursionError:
            self._bad(place, "it is nested too deeply")
            return None
        except _JsonError as error:
            reason, word = error.args
            start = place.start + max(text.find(word), 0)
            self._bad(Span(place.source, start, start + len(word)), reason)
            return None
        if not isinstance(value, dict):
            self._bad(place, f"expected an object, not {kind(value)}")
            return None
        return self._object(value, place)

    def _object(self, value: dict[str, Any], place: Span) -> Input | None:
        for key in value:
            if key not in _KEYS:
                help_ = suggest(key, _KEYS, "keys")
                self.report.report(
                    "unknown-key", _at(place, key), name=key, owner="an event", help=help_
                )
                return None
        name = value.get("event")
        if not isinstance(name, str) or not name:
            self._bad(place, 'missing key `"event"`, the name of an event')
            return None
        after = value.get("after", 0)
        if isinstance(after, bool) or not isinstance(after, (int, float)) or not _is_time(after):
            self._wrong(_at(place, "after"), "after", "a number of milliseconds from 0", after)
            return None
        to = self._recipients(value.get("member"), name, place)
        sender = self._sender(value, place)
        if to is None or sender is None or not self._is_known(name, place):
            return None
        if sender and value.get("member") is None:
            to = tuple(actor for actor in to if actor.robot.name != sender)
        data = value.get("data")
        event = self._declared(name)
        if event is not None and self._subject.system is not None:
            try:
                data = fitted(event, {} if data is None else data, self._subject.system)
            except MisfitError as error:
                words = [each for each in error.way if isinstance(each, str)]
                at = _at(place, words[-1] if words else "data")
                self.report.report(error.code, at, help=error.help, **error.fields)
                return None
        return Input(name, round(after * MILLISECOND), data, to, sender)

    def _recipients(self, member: Any, event: str, place: Span) -> tuple[Actor, ...] | None:
        """Return the named recipients, or all machines that react to the event."""
        if member is None:
            alone = self._subject.swarm is None
            return tuple(each for each in self._actors if alone or each.listens(event))
        if not isinstance(member, str):
            self._wrong(_at(place, "member"), "member", "the name of a member", member)
            return None
        named = [each for each in self._actors if member in (each.name, *each.robot.words)]
        if not named:
            known = {word for each in self._actors for word in (each.name or "", *each.robot.words)}
            self.report.report(
                "unresolved-name",
                _at(place, member),
                kind="member",
                name=member,
                help=suggest(member, sorted(known - {""}), "members"),
            )
            return None
        listening = tuple(each for each in named if each.listens(event))
        return listening or tuple(named)

    def _sender(self, value: dict[str, Any], place: Span) -> str | None:
        """Return the robot in whose name an event comes; alone, a machine can hear any."""
        sender = value.get("sender", "")
        if not isinstance(sender, str):
            self._wrong(_at(place, "sender"), "sender", "the id of a robot", sender)
            return None
        robots = {actor.robot.name or "": None for actor in self._actors}
        if not sender or sender in robots or self._subject.swarm is None:
            return sender
        at, help_ = _at(place, sender), suggest(sender, robots, "robots")
        self.report.report("unresolved-name", at, kind="robot", name=sender, help=help_)
        return None

    def _is_known(self, name: str, place: Span) -> bool:
        """Return True if the event exists; machines have more than the model declares."""
        if any(each.listens(name) for each in self._actors):
            return True
        system = self._subject.system
        if system is not None and self._declared(name) is None:
            known = [each.name for each in system.events]
            help_ = suggest(name, known, "events")
            at = _at(place, name)
            self.report.report("unresolved-name", at, kind="event", name=name, help=help_)
            return False
        self.report.report("unheard-event", _at(place, name), name=name)
        return True

    def _declared(self, name: str) -> Any:
        events = self._subject.system.events if self._subject.system is not None else ()
        return next((each.type for each in events if each.name == name), None)

    def _bad(self, place: Span, reason: str) -> None:
        help_ = 'a line is like `{"event": "Start", "after": 500}`'
        self.report.report("bad-event-line", place, reason=reason, help=help_)

    def _wrong(self, place: Span, name: str, expected: str, found: Any) -> None:
        self.report.report("wrong-value", place, name=name, expected=expected, found=kind(found))


def _at(place: Span, word: str) -> Span:
    """Return the span of a word in a line, or of the whole line."""
    start = place.text.find(json.dumps(word))
    if start < 0:
        start = place.text.find(json.dumps(word, ensure_ascii=False))
    if start < 0:
        return place
    start += place.start + 1
    return Span(place.source, start, start + len(word))


def _is_time(after: float) -> bool:
    return math.isfinite(after) and 0 <= after <= _LONGEST


class _JsonError(ValueError):
    """JSON that Python accepts but is invalid or ambiguous; reason and word."""


def _no_number(word: str) -> Any:
    raise _JsonError(f"`{word}` is not a JSON number", word)


def _whole(word: str) -> int:
    value = integer(word.lstrip("-"))
    if not fits_64_bits(value):
        raise _JsonError("a number has more than 64 bits", word)
    return -value if word.startswith("-") else value


def _real(word: str) -> float:
    value = float(word)
    if math.isinf(value):
        raise _JsonError(f"`{word}` is too large a number", word)
    return value


def _fields(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Create an object; duplicate keys are an error."""
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise _JsonError(f"`{key}` is a duplicate key", key)
        found[key] = value
    return found
