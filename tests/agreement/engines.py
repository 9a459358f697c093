"""Engines that run one machine: ours, over a model and over a document, and those of others.

Each says after every step which states are active, by their ids in the document; of a machine
that has ended, the final state in which it has.
"""

from __future__ import annotations

import json
import math
import operator
import re
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from types import SimpleNamespace
from typing import Any, Protocol

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.exchange.scxml.arrays import ARRAY_FUNCTIONS
from swarmdsl.codegen.exchange.scxml.ecmascript import dialect
from swarmdsl.codegen.exchange.scxml.portable import SEND_TYPE
from swarmdsl.execution.engine import Envelope, Event, Instance, Machine, Run, appended, item
from swarmdsl.execution.engine import removed as without
from swarmdsl.execution.engine import replaced as with_other
from swarmdsl.execution.scxml import read
from swarmdsl.ir.operations import OPERATIONS

from ..engine.world import StillWorld

try:
    from PySide6.QtCore import QBuffer, QByteArray, QCoreApplication, QIODevice
    from PySide6.QtScxml import QScxmlEvent, QScxmlStateMachine
except ImportError:
    QCoreApplication = None

S = "{http://www.w3.org/2005/07/scxml}"


@dataclass(frozen=True)
class Step:
    """Something that happens to a machine: an event, by its name in the document.

    `run` is the state and outcome of the activity that it is the end of; `time` says that it
    comes when the next delay has passed. `sender` and `sent` are those of a swarm event.
    """

    event: str
    data: Any = None
    run: tuple[str, str] | None = None
    time: bool = False
    sender: str = ""
    sent: int = 0

    @property
    def told(self) -> Any:
        """The data in a document, which have the time of a swarm event, in milliseconds."""
        if not isinstance(self.data, dict) or not self.sent:
            return self.data
        return {"sent": self.sent / 1_000_000, **self.data}


class Engine(Protocol):
    """A machine that runs in some engine."""

    @property
    def active(self) -> frozenset[str]:
        """The active states."""

    def take(self, step: Step) -> None:
        """Let it happen."""


class World(StillWorld):
    """Remembers the runs that go on; those that are cancelled stop at once."""

    def __init__(self) -> None:
        super().__init__()
        self.going: list[Run] = []

    def start(self, run: Run) -> None:
        self.going.append(run)

    def cancel(self, run: Run) -> None:
        self.going.remove(run)
        run.end("preempted")


class Ours:
    """The engine of `swarmdsl.execution.engine`."""

    def __init__(self, machine: Machine, data: Any = None, observer: Any = None) -> None:
        self.world = World()
        self.instance = Instance(machine, self.world, data=data, observer=observer)
        self.instance.start()

    @property
    def active(self) -> frozenset[str]:
        if self.instance.final is not None:
            return frozenset([self.instance.final])
        return frozenset(self.instance.configuration.ids)

    def take(self, step: Step) -> None:
        if step.time:
            self.world.clock.step()
        else:
            envelope = Envelope(step.sender, step.sent)
            self.instance.receive(Event(step.event, self.data_of(step), envelope=envelope))

    def data_of(self, step: Step) -> Any:
        """The data that come with an event."""
        return step.data


class Document(Ours):
    """Ours, over a document."""

    def __init__(self, text: bytes) -> None:
        report = Diagnostics()
        machine = read(Source("document.scxml", text.decode()), report)
        assert machine is not None, [found.message for found in report]
        super().__init__(machine)

    def data_of(self, step: Step) -> Any:
        return step.told


def with_values(text: str, given: Mapping[str, Any]) -> bytes:
    """A document with other first values of some data."""
    root = etree.fromstring(text.encode())
    for data in root.iter(f"{S}data"):
        if data.get("id") in given:
            data.set("expr", json.dumps(given[data.get("id")]))
    return etree.tostring(root)


def alone(text: bytes) -> bytes:
    """A document for an engine without a world around: as it is, but for two things.

    Delays are taken out, their events come as steps; so are events for others, whose type an
    engine need not know.
    """
    root = etree.fromstring(text)
    for send in [*root.iter(f"{S}send")]:
        if send.get("type") == SEND_TYPE or send.get("delay") or send.get("delayexpr"):
            send.getparent().remove(send)
    for cancel in [*root.iter(f"{S}cancel")]:
        cancel.getparent().remove(cancel)
    return etree.tostring(root)


# ---- python-statemachine


class _Object(SimpleNamespace):
    """An object of ECMAScript in Python."""


class _List(list[Any]):
    """A list of ECMAScript in Python."""

    @property
    def length(self) -> int:
        return len(self)

    def filter(self, test: Callable[[Any], bool]) -> _List:
        return _List(each for each in self if test(each))

    def some(self, test: Callable[[Any], bool]) -> bool:
        return any(map(test, self))

    def every(self, test: Callable[[Any], bool]) -> bool:
        return all(map(test, self))

    def least(self, key: Callable[[Any], Any] | None = None) -> Any:
        return min(self, key=key)

    def greatest(self, key: Callable[[Any], Any] | None = None) -> Any:
        return max(self, key=key)

    def indexOf(self, value: Any) -> int:  # noqa: N802 - its name in ECMAScript
        return self.index(value) if value in self else -1


def _of(value: Any) -> Any:
    if isinstance(value, dict):
        return _Object(**{key: _of(each) for key, each in value.items()})
    if isinstance(value, _Object):
        return _of(vars(value))
    return _List(map(_of, value)) if isinstance(value, list) else value


OF_ONE = ("sqrt", "int", "round", "floor", "ceil", "sin", "cos")


def _distance(one: _Object, other: _Object) -> float:
    names = set(vars(one)) & set(vars(other)) & {"x", "y", "z"}
    return math.hypot(*(getattr(one, name) - getattr(other, name) for name in names))


@cache
def _functions() -> Mapping[str, str]:
    """The functions that a document has, in Python: they have no value where those have none."""
    words = dialect({})
    assert words.division is not None
    calls = {
        "quotient": words.quotient("a", "b"),
        "modulo": words.modulo("a", "b"),
        "language_div": words.division("a", "b"),
    }
    for word in (*OF_ONE, "clamp"):
        write = words.functions[word]
        assert not isinstance(write, str)
        calls[f"language_{word}"] = write("abc" if word == "clamp" else "a")
    for word in ("item", "append", "remove", "replace"):
        calls[f"language_{word}"] = ARRAY_FUNCTIONS[word]("abc"[: 2 + (word[0] == "a")])
    found = {call[: call.rindex("(")]: name for name, call in calls.items()}
    for names in ("xy", "xyz"):
        write = words.functions["distance"]
        assert not isinstance(write, str)
        call = write([f"{point}.{name}" for point in "ab" for name in names])
        found[call[: call.rindex("(")]] = "language_distance"
    return found


_ECMASCRIPT = {
    "as_object": _of,
    "Math": SimpleNamespace(
        **{name: getattr(math, name) for name in ("sqrt", "hypot", "atan2", "sin", "cos")},
        **{name: getattr(math, name) for name in ("ceil", "floor", "trunc")},
        **{function.__name__: function for function in (abs, max, min)},
    ),
    "Number": float,
    "Date": SimpleNamespace(now=lambda: time.time_ns() // 1_000_000),
    "JSON": SimpleNamespace(parse=_of, stringify=_of),
    "modulo": operator.mod,
    "quotient": operator.truediv,
    **{f"language_{word}": OPERATIONS[word] for word in (*OF_ONE, "clamp", "div")},
    "language_distance": _distance,
    "language_item": item,
    "language_append": lambda *given: _of(appended(*given)),
    "language_remove": lambda *given: _of(without(*given)),
    "language_replace": lambda *given: _of(with_other(*given)),
    "Object": SimpleNamespace(assign=lambda one, other: _of({**one, **other})),
    "true": True,
    "false": False,
}
_ORIGIN, _WHO = "_event.origin", "origin_of_event"
_WORDS = {"&&": " and ", "||": " or ", "!": " not "}
_PYTHON = re.compile(
    r"""(?P<kept>"(?:[^"\\]|\\.)*"|!=)|(?P<word>&&|\|\||!)|(?P<function>\(function [^}]*\}\))"""
)
_EXTREME = re.compile(
    r"\.reduce\(function \((?P<one>\w+), (?P<other>\w+)\) \{ return "
    r"(?:(?P<key>\(function [^}]*\}\))\((?P=other)\) (?P<sign>[<>]) (?P=key)\((?P=one)\)"
    r"|(?P=other) (?P<plain>[<>]) (?P=one)) \? (?P=other) : (?P=one); \}\)"
)
_FUNCTION = re.compile(r"\(function \((\w+)\) \{ return (.*); \}\)")


def _extreme(found: re.Match[str]) -> str:
    """The item of a list with the least or greatest value, as Python finds it."""
    word = "least" if (found["sign"] or found["plain"]) == "<" else "greatest"
    return f".{word}({(found['key'] or '()')[1:-1]})"


def in_python(document: bytes) -> str:
    """A document whose expressions python-statemachine can evaluate: it does so as Python."""

    def word(found: re.Match[str]) -> str:
        if found["function"]:
            # Those of Python have no value where these have none.
            known = _functions().get(found["function"])
            return known or _FUNCTION.sub(applied, found["function"])
        return found["kept"] or _WORDS[found["word"]]

    def applied(function: re.Match[str]) -> str:
        return f"(lambda {function[1]}: {_PYTHON.sub(word, function[2])})"

    root = etree.fromstring(document)
    for element in root.iter():
        for attribute in ("cond", "expr"):
            if element.get(attribute) is not None:
                # There, only events that a machine sends itself have an origin.
                element.set(
                    attribute, element.get(attribute).replace(_ORIGIN, f"_event.data.{_WHO}")
                )
                written = _EXTREME.sub(_extreme, element.get(attribute))
                written = _PYTHON.sub(word, written).strip()
                element.set(attribute, f"as_object({written})")
    return etree.tostring(root).decode()


class PythonStateMachine:
    """python-statemachine, which knows the time of the clock on the wall only."""

    def __init__(self, text: str) -> None:
        from statemachine.io import load

        model = SimpleNamespace(**_ECMASCRIPT)
        self.machine = load(text, format="scxml", trusted=True)(model=model)

    @property
    def active(self) -> frozenset[str]:
        return frozenset(state.id for state in self.machine.configuration)

    def take(self, step: Step) -> None:
        told = step.told
        if isinstance(told, dict):
            told = {_WHO: step.sender, **told}
        given = () if told is None else (_of(told),)
        self.machine.send(step.event, *given)


# ---- Qt


class Qt:
    """QtScxml, whose machines run in the event loop of the application."""

    application: Any = None

    def __init__(self, text: bytes) -> None:
        if Qt.application is None:
            Qt.application = QCoreApplication.instance() or QCoreApplication([])
        buffer = QBuffer()
        buffer.setData(QByteArray(text))
        buffer.open(QIODevice.OpenModeFlag.ReadOnly)
        self.machine = QScxmlStateMachine.fromData(buffer, "document.scxml")
        errors = [error.description() for error in self.machine.parseErrors()]
        assert not errors, errors
        self.machine.init()
        self.machine.start()
        Qt.application.processEvents()

    @property
    def active(self) -> frozenset[str]:
        return frozenset(self.machine.activeStateNames(False))

    def take(self, step: Step) -> None:
        event = QScxmlEvent()
        event.setName(step.event)
        event.setOrigin(step.sender)
        if step.told is not None:
            event.setData(step.told)
        self.machine.submitEvent(event)
        Qt.application.processEvents()


ENGINES: Mapping[str, Callable[[bytes], Engine]] = {
    "document": Document,
    "python-statemachine": lambda text: PythonStateMachine(in_python(alone(text))),
    "QtScxml": lambda text: Qt(alone(text)),
}
"""The engines that are compared with what ours does with a model."""
