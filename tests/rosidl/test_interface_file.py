"""Interface files to syntax nodes: the syntax of ROS 1 and of ROS 2."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.rosidl.declarations import Constant
from swarmdsl.project.rosidl.interface_file import (
    INTERFACE_KINDS,
    InterfaceFile,
    Kind,
    parse_interface,
)
from swarmdsl.syntax.ast import ActionType, Field, MessageType, ServiceType, Value, walk

from .conftest import Read


def types(fields: list[Field]) -> dict[str, str]:
    return {str(field.name): field.type.name + field.type.array for field in fields}


def message(found: InterfaceFile) -> MessageType:
    assert isinstance(found.declaration, MessageType)
    return found.declaration


def only(found: InterfaceFile) -> Field:
    (field,) = message(found).fields
    return field


def only_constant(found: InterfaceFile) -> Constant:
    (constant,) = found.constants["fields"]
    return constant


def test_a_message(read_well: Read) -> None:
    found = message(read_well("float64 x\nfloat64[] values\nuint8[16] id\n"))

    assert found.name == "my_msgs/Thing"
    assert types(found.fields) == {"x": "float64", "values": "float64[]", "id": "uint8[16]"}


def test_a_service(read_well: Read) -> None:
    found = read_well("bool data\n---\nbool success\nstring message\n", "srv").declaration

    assert isinstance(found, ServiceType)
    assert types(found.request) == {"data": "bool"}
    assert types(found.response) == {"success": "bool", "message": "string"}


def test_an_action(read_well: Read) -> None:
    found = read_well("int32 a\n---\nint32 b\n---\nint32 c\n", "action").declaration

    assert isinstance(found, ActionType)
    parts = (found.goal, found.result, found.feedback)
    assert [types(part) for part in parts] == [{"a": "int32"}, {"b": "int32"}, {"c": "int32"}]


@pytest.mark.parametrize(("text", "kind"), [("", "msg"), ("---", "srv"), ("---\n---\n", "action")])
def test_empty_parts(text: str, kind: str, read_well: Read) -> None:
    declaration = read_well(text, kind).declaration
    assert not [node for node in walk(declaration) if isinstance(node, Field)]


def test_parts_may_use_the_same_names(read_well: Read) -> None:
    found = read_well("uint8 OK=0\nint32 id\n---\nuint8 OK=0\nint32 id\n", "srv").declaration
    assert isinstance(found, ServiceType)
    assert types(found.request) == types(found.response) == {"id": "int32"}


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("Pose", "my_msgs/Pose"),
        ("geometry_msgs/Pose", "geometry_msgs/Pose"),
        ("Header", "std_msgs/Header"),
        ("time", "time"),
        ("duration", "duration"),
        ("builtin_interfaces/Time", "time"),
        ("builtin_interfaces/Duration", "duration"),
        ("byte", "byte"),
        ("char", "char"),
        ("wstring", "wstring"),
        ("Pose[]", "my_msgs/Pose[]"),
        ("int32[<=5]", "int32[<=5]"),
        ("builtin_interfaces/Time[2]", "time[2]"),
    ],
)
def test_types(written: str, meant: str, read_well: Read) -> None:
    field = only(read_well(f"{written} x"))

    assert types([field]) == {"x": meant}
    assert field.type.span.text == written


@pytest.mark.parametrize(
    ("written", "name", "array", "bound"),
    [
        ("string<=10", "string", "", 10),
        ("wstring<=7[]", "wstring", "[]", 7),
        ("string<=10[<=5]", "string", "[<=5]", 10),
    ],
)
def test_bounds_of_texts(written: str, name: str, array: str, bound: int, read_well: Read) -> None:
    found = read_well(f"{written} x")
    type_ = only(found).type

    assert (type_.name, type_.array, found.bounds[type_]) == (name, array, bound)


@pytest.mark.parametrize(
    "text",
    [
        "\ufefffloat32 x\r\nfloat32 y\r\n",  # Windows
        "float32 x#comment\nfloat32 y#another",
        "\tfloat32 \t x\n\n   float32    y   \n",
    ],
)
def test_layout(text: str, read_well: Read) -> None:
    found = message(read_well(text))

    assert types(found.fields) == {"x": "float32", "y": "float32"}
    assert [field.name.span.text for field in found.fields] == ["x", "y"]
    assert [field.span.text.split() for field in found.fields] == [
        ["float32", "x"],
        ["float32", "y"],
    ]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("uint8 X=1", 1),
        ("uint8 X = 255 # the most", 255),
        ("int8 X=-128", -128),
        ("uint16 X=0xFF", 255),
        ("byte X=-1", -1),
        ("char X=65", 65),
        ("float32 X=-1.5e3#metres", -1500.0),
        ("float64 X=1", 1.0),
        ("bool X=True", True),
        ("bool X=0", False),
        # ROS 1: all that follows, without spaces around it.
        ("string X=  text with # in it  ", "text with # in it"),
        ("string X=don't", "don't"),
        ("string X=", ""),
        ("string X=a=b", "a=b"),
        ('string X="a" and "b"', '"a" and "b"'),
        # ROS 2: in quotes.
        ('string X="text with # in it" # and a comment', "text with # in it"),
        ("string X='it\\'s'", "it's"),
        ('string X=" spaces "', " spaces "),
        ('wstring X=""', ""),
    ],
)
def test_constants(text: str, value: object, read_well: Read) -> None:
    constant = only_constant(read_well(text))

    assert constant.name == "X"
    assert isinstance(constant.value.tree, Value)
    assert constant.value.tree.value == value
    assert type(constant.value.tree.value) is type(value)


def test_places_of_constants(read_well: Read) -> None:
    constant = only_constant(read_well("uint8 X = 255 # the most"))

    assert constant.span.text == "uint8 X = 255"
    assert constant.value.span.text == "255"
    assert constant.doc == "the most"


def test_constants_are_those_of_their_part(read_well: Read) -> None:
    found = read_well("uint8 A=1\n---\nuint8 B=2\nuint8 C=3\n---\n", "action")

    names = {part: [str(c.name) for c in constants] for part, constants in found.constants.items()}
    assert names == {"goal": ["A"], "result": ["B", "C"], "feedback": []}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("int32 x 5", 5),
        ("int16 x -256 # with a comment", -256),
        ("float64 x .5", 0.5),
        ("bool x true", True),
        ('string x "Hello # world!"', "Hello # world!"),
        ("string x 'Hello\"world!'", 'Hello"world!'),
        ("string<=5 x 'abcde'", "abcde"),
        ('string x "a=b"', "a=b"),
        ("string x bare", "bare"),
        ("int32[] x [1, 2, 3]", [1, 2, 3]),
        ("int32[] x []", []),
        ("int32[<=3] x [1, 2]", [1, 2]),
        ("float32[2] x [0.5,1]", [0.5, 1.0]),
        ("string[] x ['a, b', \"c#\"] # comment", ["a, b", "c#"]),
    ],
)
def test_defaults(text: str, value: object, read_well: Read) -> None:
    found = read_well(text)
    default = found.defaults[only(found)]

    plain = default.value if isinstance(default, Value) else [item.value for item in default]
    assert plain == value


def test_documentation(read_well: Read) -> None:
    text = """\
# What it is,
#   and why.
# Not of x.
float64 x

# A heading of what follows.

# Above,
# in two lines.
float64 y   # behind
            # and below
## Another.
float64 z
uint8 MODE=1  # A mode.
float64 last
"""
    found = read_well(text)

    docs = {str(field.name): field.doc for field in message(found).fields}
    assert message(found).doc == "What it is,\n  and why.\nNot of x."
    assert docs == {
        "x": "",
        "y": "Above,\nin two lines.\nbehind\nand below",
        "z": "Another.",
        "last": "",
    }
    assert only_constant(found).doc == "A mode."


def test_documentation_of_the_parts(read_well: Read) -> None:
    found = read_well("# Switches.\n---\n# Whether it did.\nbool success\n", "srv").declaration

    assert isinstance(found, ServiceType)
    assert found.doc == "Switches."
    assert found.response[0].doc == "Whether it did."


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("float64", "float64", "`float64` has no name"),
        ("X=1", "X=1", "`X=1` has no type"),
        ("uint8 X=", "X", "constant `X` has no value"),
        ("int32 x, y", "x,", "`x,` cannot be a name"),
        ("int32 x;", "x;", "`x;` cannot be a name"),
        ("int32 x[5]", "x[5]", "`x[5]` cannot be a name"),
        ("int32 1st", "1st", "`1st` cannot be a name"),
        ("int32 größe", "größe", "`größe` cannot be a name"),
        (
            "geometry_msgs/msg/Pose p",
            "geometry_msgs/msg/Pose",
            "`geometry_msgs/msg/Pose` is no type",
        ),
        ("std::vector<int> v", "std::vector<int>", "`std::vector<int>` is no type"),
        ("int32<=5 x", "int32<=5", "`int32<=5` is no type"),
        ("string<=0 x", "string<=0", "`string<=0` is no type"),
        ("int32[0] x", "int32[0]", "`[0]` is no size of an array"),
        ("int32[N] x", "int32[N]", "`[N]` is no size of an array"),
        ("int32[][] x", "int32[][]", "ROS has no arrays of arrays"),
        ("uint8 X=256", "256", "`256` is no value of type `uint8`"),
        ("int8 X=1.5", "1.5", "`1.5` is no value of type `int8`"),
        ("bool X=yes", "yes", "`yes` is no value of type `bool`"),
        ("float32 X=1,5", "1,5", "`1,5` is no value of type `float32`"),
        ("int32[] X=1", "int32[]", "a constant cannot be of type `int32[]`"),
        ("time X=1", "time", "a constant cannot be of type `time`"),
        ("Pose X=1", "Pose", "a constant cannot be of type `Pose`"),
        ("Pose p 1", "1", "a field of type `my_msgs/Pose` cannot have a default"),
        ("float64 x in metres", "in metres", "`in metres` is no value of type `float64`"),
        ("int32[] x 1", "1", "`1` is no list of values"),
        ("int32[] x [1, two]", "two", "`two` is no value of type `int32`"),
        ("int32[] x [1,]", "", "`` is no value of type `int32`"),
        ("int32[2] x [1]", "[1]", "expected 2 values, found 1"),
        ("int32[<=2] x [1, 2, 3]", "[1, 2, 3]", "expected at most 2 values, found 3"),
        ("string<=3 x 'abcd'", "'abcd'", "the string is longer than 3 characters"),
        ('string x "open', '"open', 'this string has no closing `"`, or goes on after it'),
        ("int32 x\nbool x", "x", "field `x` is declared twice"),
        ("uint8 X=1\nuint8 X=2", "X", "constant `X` is declared twice"),
        ("---", "---", "one `---` too many: a message has none"),
    ],
)
def test_mistakes(text: str, at: str, message: str, read: Read, report: Diagnostics) -> None:
    read(text)

    (found,) = report
    assert found.message == message
    assert found.primary is not None
    assert found.primary.span.text == at
    assert found.primary.span.line == text.count("\n") + 1


@pytest.mark.parametrize(
    ("text", "kind", "line", "message"),
    [
        ("", "srv", 1, "a `---` is missing: a service is its request, `---` and its response"),
        ("int32 a\n---\nint32 b\n", "action", 3, "a `---` is missing: an action is its goal"),
        ("---\n---\n", "srv", 2, "one `---` too many: a service is its request"),
        ("int32 a\n--- response\n", "srv", 2, "a line with `---` has nothing else"),
    ],
)
def test_mistakes_in_the_parts(
    text: str, kind: str, line: int, message: str, read: Read, report: Diagnostics
) -> None:
    assert read(text, kind).damaged

    (found,) = report
    assert found.message.startswith(message)
    assert found.primary is not None
    assert found.primary.span.line == line


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("int32 x[5]", "write `int32[5] x`"),
        ("geometry_msgs/msg/Pose[] p", "write `geometry_msgs/Pose[]`"),
        ("int32 x, y", "a line has one field and nothing after it: `int32 x`"),
        ("uint8 X=256", "write a whole number from 0 to 255"),
    ],
)
def test_hint(text: str, hint: str, read: Read, report: Diagnostics) -> None:
    read(text)

    assert [found.help for found in report] == [hint]


def test_every_mistake_is_reported_and_the_rest_is_read(read: Read, report: Diagnostics) -> None:
    text = "float64\nfloat64 x\nint32 2nd\nuint8 X=300\nint8 y 1000\nbool ok\n"

    found = read(text)

    assert [diagnostic.primary.span.line for diagnostic in report if diagnostic.primary] == [
        1,
        3,
        4,
        5,
    ]
    assert types(message(found).fields) == {"x": "float64", "y": "int8", "ok": "bool"}
    assert found.damaged


@pytest.mark.parametrize("text", ["int32[{}] x", "string<={} x", "int32 X={}", "int32[] x [{}]"])
def test_numbers_that_are_out_of_all_bounds(text: str, read: Read, report: Diagnostics) -> None:
    read(text.format("9" * 5000))

    assert len(report) == 1


def test_a_file_of_something_else(read: Read, report: Diagnostics) -> None:
    read("From: A Person <a@b.c>\n" * 1000)

    assert 0 < len(report) <= 10


PIECES = [
    *("int32", "string", "bool", "float64", "time", "Pose", "a/B", "x", "X", "<=", "=", "3", "-1"),
    *(
        "[",
        "]",
        "[]",
        ",",
        '"',
        "'",
        "\\",
        "#",
        "# note",
        "---",
        " ",
        "\t",
        "\n",
        "\r\n",
        "\ufeff",
        "é",
    ),
]


@given(
    st.lists(st.sampled_from(PIECES) | st.text(max_size=3)).map("".join),
    st.sampled_from(INTERFACE_KINDS),
)
def test_any_text_is_read_or_reported(text: str, kind: Kind) -> None:
    report = Diagnostics()
    found = parse_interface(Source("Thing", text), "my_msgs", "Thing", kind, report)

    spans = [node.span for node in walk(found.declaration)]
    spans += [diagnostic.primary.span for diagnostic in report if diagnostic.primary]
    assert all(0 <= span.start <= span.end <= len(text) for span in spans)
    assert found.damaged <= (len(report) > 0)
