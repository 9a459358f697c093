"""Parser of interface files (.msg, .srv, .action) of ROS 1 and ROS 2.

One parser reads both: ROS 2 only adds bounds, defaults and quoted strings. Names are completed
with their packages: `Pose` becomes `geometry_msgs/Pose`, `Header` becomes `std_msgs/Header`.
`builtin_interfaces/Time` of ROS 2 becomes `time` as in ROS 1.

Comments document as in ROS 2: at the start of a file the interface; above, after or indented
below a field the field.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal, get_args

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.project.rosidl.declarations import read_line
from swarmdsl.project.rosidl.fault import InterfaceError
from swarmdsl.project.rosidl.values import Values
from swarmdsl.syntax.ast import (
    ActionType,
    Constant,
    Documented,
    Field,
    MessageType,
    ServiceType,
    TypeRef,
    Word,
)

Kind = Literal["msg", "srv", "action"]
INTERFACE_KINDS: tuple[Kind, ...] = get_args(Kind)
Interface = MessageType | ServiceType | ActionType

# Attributes of the node for the parts of a file between `---`.
_PARTS: dict[Kind, tuple[str, ...]] = {
    "msg": ("fields",),
    "srv": ("request", "response"),
    "action": ("goal", "result", "feedback"),
}
_SHAPES: dict[Kind, str] = {
    "msg": "a message has none",
    "srv": "a service is its request, `---` and its response",
    "action": "an action is its goal, `---`, its result, `---` and its feedback",
}
# A file with more errors is something else: Tcl and mail programs have .msg files too.
_FAULTS_PER_FILE = 10
_SEPARATOR = r"-{3,}\s*(?:#.*)?"


@dataclass
class InterfaceFile:
    """Content of an interface file.

    `constants` are by part (attribute of the node), `defaults` the default values of fields,
    `bounds` the greatest lengths of strings (`string<=10`). `damaged` is True if a line could
    not be parsed, so that a field may be missing.
    """

    declaration: Interface
    constants: dict[str, list[Constant]]
    defaults: dict[Field, Values] = field(default_factory=dict)
    bounds: dict[TypeRef, int] = field(default_factory=dict)
    damaged: bool = False


def parse_interface(
    source: Source, package: str, name: str, kind: Kind, report: Diagnostics
) -> InterfaceFile:
    """Parse the file of `package/name`; report and skip invalid lines."""
    reader = _Reader(source, package, kind, report)
    reader.read()
    word = Word(f"{package}/{name}", Span(source, 0, 0))
    whole = Span(source, 0, len(source.text))
    declaration: Interface
    if kind == "msg":
        fields = reader.fields["fields"]
        declaration = MessageType(whole, word, reader.constants["fields"], fields)
    else:
        parts = reader.fields.values()
        declaration = (ServiceType if kind == "srv" else ActionType)(whole, word, *parts)
    declaration.doc = reader.doc
    return InterfaceFile(
        declaration, reader.constants, reader.defaults, reader.bounds, reader.damaged
    )


class _Reader:
    """Parses one file line by line; the public attributes are the result."""

    def __init__(self, source: Source, package: str, kind: Kind, report: Diagnostics) -> None:
        self._source = source
        self._package = package
        self._kind = kind
        self._report = report
        self.doc = ""
        self.fields: dict[str, list[Field]] = {part: [] for part in _PARTS[kind]}
        self.constants: dict[str, list[Constant]] = {part: [] for part in _PARTS[kind]}
        self.defaults: dict[Field, Values] = {}
        self.bounds: dict[TypeRef, int] = {}
        self._faults = 0
        self._part, *self._parts_left = _PARTS[kind]
        # Names in the current part.
        self._names: dict[str, Word] = {}
        # Pending comments, and the node that an indented comment continues.
        self._above: list[str] = []
        self._last: Documented | None = None

    @property
    def damaged(self) -> bool:
        """True if a line could not be parsed."""
        return self._faults > 0

    def read(self) -> None:
        """Parse all lines."""
        lines = list(self._lines())
        heading = next((i for i, line in enumerate(lines) if line.text[:1] != "#"), len(lines))
        self.doc = _joined([line.text for line in lines[:heading]])
        for line in lines[heading:]:
            if self._faults == _FAULTS_PER_FILE:
                return
            if line.text.startswith("---") and not self._parts_left:
                self._fault(line, f"one `---` too many: {_SHAPES[self._kind]}")
                return
            try:
                self._read_line(line)
            except InterfaceError as error:
                self._above, self._last = [], None
                self._fault(error.span, error.message, error.help)
        if self._parts_left:
            at = len(self._source.text.rstrip())
            self._fault(Span(self._source, at, at), f"a `---` is missing: {_SHAPES[self._kind]}")

    def _lines(self) -> Iterator[Span]:
        """Lines without line ends and without a byte order mark."""
        text = self._source.text
        start = 1 if text.startswith("\ufeff") else 0
        while start <= len(text):
            end = text.find("\n", start)
            end = len(text) if end < 0 else end
            yield Span(self._source, start, start + len(text[start:end].rstrip()))
            start = end + 1

    def _read_line(self, line: Span) -> None:
        text = line.text
        if not text:
            self._above, self._last = [], None
        elif text.startswith("---"):
            self._above, self._last = [], None
            self._part = self._parts_left.pop(0)
            self._names = {}
            if not re.fullmatch(_SEPARATOR, text):
                raise InterfaceError(line, "a line with `---` has nothing else")
        elif not text.lstrip().startswith("#"):
            self._read_declaration(line)
        elif self._last is not None and text[0] in " \t":
            self._last.doc = f"{self._last.doc}\n{_joined([text])}".strip("\n")
        else:
            self._above.append(text)
            self._last = None

    def _read_declaration(self, line: Span) -> None:
        found = read_line(line, self._package)
        declared = found.declared
        declared.doc = _joined([*self._above, found.comment])
        self._above, self._last = [], declared
        first = self._names.setdefault(str(declared.name), declared.name)
        if first is not declared.name:
            self._report.report(
                "duplicate-name",
                declared.name.span,
                kind="field" if isinstance(declared, Field) else "constant",
                name=declared.name,
                related=(Label(first.span, "first declared here"),),
            )
        elif isinstance(declared, Constant):
            self.constants[self._part].append(declared)
        else:
            self.fields[self._part].append(declared)
            if found.default is not None:
                self.defaults[declared] = found.default
        if found.bound is not None:
            self.bounds[declared.type] = found.bound
        if found.bad_default is not None:
            raise found.bad_default

    def _fault(self, span: Span, message: str, help_: str | None = None) -> None:
        self._report.report("syntax-error", span, message=message, help=help_)
        self._faults += 1


def _joined(comments: list[str]) -> str:
    """Text of comments, one per line."""
    lines = (re.sub(r"^\s*#+ ?", "", comment).rstrip() for comment in comments)
    return "\n".join(lines).strip("\n")
