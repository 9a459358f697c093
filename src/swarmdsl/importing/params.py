"""Import ROS parameter files: names, values and comments of params.

The format is YAML 1.1, as in ROS. Nested maps are namespaces; in ROS 2, `ros__parameters` is
between the name of a node and its parameters.
"""

from __future__ import annotations

import re

import yaml

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import fits_64_bits
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.importing.names import NamePool, is_plain, value_names
from swarmdsl.ir import Array, Literal, Param, Primitive, Type
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, FLOAT, INT, STRING

_ROS2_KEY = "ros__parameters"
_TYPES: dict[type, Primitive] = {bool: BOOL, int: INT, float: FLOAT, str: STRING}
# Limits against YAML bombs, which expand aliases.
_MAX_PARAMS = 10_000
_MAX_DEPTH = 32
_COMMENT = re.compile(r"(?P<indent>[ \t]*)#+(?:[ \t]+(?P<text>.*))?")
_TRAILING = re.compile(r"(?:.*\s)?#+[ \t]*(?P<text>.*)")
_TAG = "tag:yaml.org,2002:"
_PLAIN = {f"{_TAG}{name}" for name in ("bool", "int", "float", "str", "timestamp")}


@dataclass(eq=False)
class NodeParams:
    """Params of one node by their ROS names; `doc` is the header comment of the file."""

    doc: str = ""
    params: dict[str, Param] = field(default_factory=dict)
    names: NamePool = field(default_factory=value_names)


@dataclass(eq=False)
class _Parameter:
    """Parameter in a file; `node` is empty if the file names none."""

    node: str
    name: str
    key: yaml.Node
    value: yaml.Node
    doc: list[str]


def read_params(
    source: Source, package: str, owners: dict[str, NodeParams], report: Diagnostics
) -> None:
    """Add the params of a file to its package or to the nodes that it names."""
    reader = _Reader(source, report)
    try:
        deep = _too_deep(source.text)
        if deep is not None:
            reader.fault(deep, "it is nested too deeply")
            return
        top = yaml.compose(source.text, Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        reader.fault(mark.index if mark else 0, error.problem or error.context or "")
        return
    except yaml.reader.ReaderError as error:
        reader.fault(error.position, error.reason)
        return
    if top is not None and not isinstance(top, yaml.MappingNode):
        reader.left_out(top, "this file", "it is not a map of parameters")
    elif top is not None:
        reader.read(top)
        for entry in reader.entries:
            owner = owners.setdefault(entry.node or package, NodeParams())
            if reader.header:
                owner.doc, reader.header = f"{owner.doc}\n{reader.header}".strip(), ""
            reader.add(entry, owner)


def _too_deep(text: str) -> int | None:
    """Offset at which a text is nested too deeply to be parsed safely, or None."""
    depth = 0
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > 2 * _MAX_DEPTH:
            return event.start_mark.index if event.start_mark is not None else 0
    return None


class _Reader:
    """Reads one file; `header` is the comment at its top that a blank line ends."""

    def __init__(self, source: Source, report: Diagnostics) -> None:
        self.entries: list[_Parameter] = []
        self.header = ""
        self._source = source
        self._report = report
        # End of the comments read so far, the docs of the previous parameter, and comments that
        # belong to the next parameter.
        self._end = 0
        self._last: list[str] | None = None
        self._waiting: list[str] = []

    def read(self, top: yaml.MappingNode) -> None:
        """Find all parameters and their comments."""
        self._map(top, "", "", 1)
        self._comments(len(self._source.text), -1)

    def _map(self, node: yaml.MappingNode, whose: str, prefix: str, depth: int) -> None:
        for key, value in node.value:
            self._comments(key.start_mark.index, key.start_mark.column)
            self._end = max(self._end, key.end_mark.index)
            word = key.value if isinstance(key, yaml.ScalarNode) else "<<"
            name = f"{prefix}{word}"
            if len(self.entries) == _MAX_PARAMS or depth > _MAX_DEPTH:
                self.left_out(key, f"`{name}`", "the file has too many parameters or levels")
                return
            if word == "<<":
                self.left_out(
                    key, f"`{Span(self._source, *_extent(key)).text}`", "it is not a name"
                )
            elif value.tag == f"{_TAG}map" and not value.value:
                self.left_out(key, f"`{name}`", "it is empty")
            elif value.tag == f"{_TAG}map" and isinstance(value, yaml.MappingNode):
                self._last = None
                if word == _ROS2_KEY:
                    node_name = prefix.rstrip("/").rpartition("/")[2]
                    self._map(value, "" if "*" in node_name else node_name, "", depth + 1)
                else:
                    self._map(value, whose, f"{name}/", depth + 1)
            else:
                entry = _Parameter(whose, name, key, value, self._waiting)
                self.entries.append(entry)
                self._waiting, self._last = [], entry.doc
                line_end = self._source.text.find("\n", self._end)
                self._comments(min(value.start_mark.index, line_end + 1), -1)
                self._end = max(self._end, _end(value))

    def _comments(self, until: int, column: int) -> None:
        """Assign the comments before an offset to parameters.

        A trailing comment, or one with more indentation than `column`, belongs to the previous
        parameter, any other to the next.
        """
        if until <= self._end:
            return
        behind, *lines = self._source.text[self._end : until].split("\n")
        if self._end == 0:
            lines = self._after_header([behind, *lines])
        elif (found := _TRAILING.fullmatch(behind)) and found["text"].strip():
            (self._waiting if self._last is None else self._last).append(found["text"].strip())
        self._end = until
        for line in lines:
            found = _COMMENT.fullmatch(line)
            if found is None or not found["text"]:
                continue
            inside = self._last is not None and len(found["indent"]) > column
            about = self._last if inside and self._last is not None else self._waiting
            about.append(found["text"].strip())

    def _after_header(self, lines: list[str]) -> list[str]:
        blank = [number for number, line in enumerate(lines[:-1]) if not line.strip()]
        cut = blank[-1] if blank else 0
        comments = filter(None, map(_COMMENT.fullmatch, lines[:cut]))
        self.header = "\n".join(found["text"].strip() for found in comments if found["text"])
        return lines[cut:]

    def add(self, entry: _Parameter, owner: NodeParams) -> None:
        """Add a param to its owner and report what is not supported."""
        if entry.name in owner.params:
            self.left_out(entry.key, f"`{entry.name}`", "it already has a value")
            return
        type_, default = self._value(entry)
        if type_ is None:
            return
        plain = is_plain(entry.name) and entry.name not in owner.names.taken
        name = entry.name if plain else owner.names.new(entry.name)
        owner.names.taken.add(name)
        if name != entry.name:
            self._report.report("renamed", self._at(entry.key), name=entry.name, new=name)
        doc = "\n".join(entry.doc)
        owner.params[entry.name] = Param(name, type_, default, doc, self._at(entry.key))

    def _value(self, entry: _Parameter) -> tuple[Type | None, Literal | None]:
        node = entry.value
        if isinstance(node, yaml.SequenceNode):
            known = {type(each) for each in map(_scalar, node.value)}
            element = FLOAT if known == {int, float} else None
            if len(known) == 1:
                element = _TYPES.get(known.pop())
            if element is None:
                self.left_out(entry.key, f"`{entry.name}`", "its values have different types")
                return None, None
            what = f"the value of `{entry.name}`"
            self.left_out(entry.key, what, "a model has no array values")
            return Array(element), None
        value = _scalar(node)
        if value is None:
            self.left_out(entry.key, f"`{entry.name}`", "its value has no supported type")
            return None, None
        type_ = _TYPES[type(value)]
        if not _can_be_written(value):
            what = f"the value of `{entry.name}`"
            reason = (
                f"a model cannot contain this {'string' if isinstance(value, str) else 'number'}"
            )
            self.left_out(entry.key, what, reason)
            return type_, None
        return type_, Literal(value, type_)

    def left_out(self, node: yaml.Node, what: str, reason: str) -> None:
        """Report a parameter that is not imported."""
        self._report.report("left-out", self._at(node), what=what, reason=reason)

    def fault(self, at: int, reason: str) -> None:
        """Report a syntax error."""
        at = min(at, len(self._source.text))
        place = Span(self._source, at, min(at + 1, len(self._source.text)))
        self._report.report("not-yaml", place, reason=reason)

    def _at(self, node: yaml.Node) -> Span:
        return Span(self._source, *_extent(node))


def _extent(node: yaml.Node) -> tuple[int, int]:
    return node.start_mark.index, node.end_mark.index


def _end(node: yaml.Node) -> int:
    """End of a value; PyYAML ends a block at the start of the next token."""
    inner = node.value
    if isinstance(node, yaml.CollectionNode) and not node.flow_style and inner:
        last = inner[-1]
        return _end(last[1] if isinstance(last, tuple) else last)
    return node.end_mark.index


def _scalar(node: yaml.Node) -> bool | int | float | str | None:
    if not isinstance(node, yaml.ScalarNode) or node.tag not in _PLAIN:
        return None
    if node.tag == f"{_TAG}timestamp":
        return str(node.value)  # ROS reads it as a string
    try:
        value = yaml.constructor.SafeConstructor().construct_object(node)
    except (ValueError, KeyError):
        return str(node.value)
    return value if type(value) in _TYPES else str(node.value)


def _can_be_written(value: float | str) -> bool:
    if isinstance(value, str):
        return forbidden_character(value) is None
    return fits_64_bits(value) and (type(value) is float or value < 2**63)
