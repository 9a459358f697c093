"""Parameter files of ROS: values, types and the comments that say what they are."""

from __future__ import annotations

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.importing.params import NodeParams, read_params
from swarmdsl.ir import Literal


def read(
    text: str, owners: dict[str, NodeParams] | None = None
) -> tuple[dict[str, NodeParams], Diagnostics]:
    owners, report = owners if owners is not None else {}, Diagnostics()
    read_params(Source("uav.yaml", text), "uav", owners, report)
    return owners, report


def values(text: str) -> dict[str, tuple[str, object]]:
    owners, _ = read(text)
    return {
        param.name: (
            str(param.type),
            param.default.value if isinstance(param.default, Literal) else None,
        )
        for param in owners["uav"].params.values()
    }


def docs(text: str) -> dict[str, str]:
    owners, _ = read(text)
    return {param.name: param.doc for param in owners["uav"].params.values()}


def said(report: Diagnostics) -> list[tuple[str, str]]:
    return [(f.name, f.primary.span.text if f.primary else "") for f in report]


def test_values_have_the_types_that_ros_gives_them() -> None:
    text = 'a: 10.0\nb: 10\nc: true\nd: map\ne: "10"\nf: 1.0e-3\ng: yes\nh: 2001-01-01\ni: -1\n'

    assert values(text) == {
        "a": ("float64", 10.0),
        "b": ("int64", 10),
        "c": ("bool", True),
        "d": ("string", "map"),
        "e": ("string", "10"),
        "f": ("float64", 0.001),
        "g": ("bool", True),
        "h": ("string", "2001-01-01"),
        "i": ("int64", -1),
    }


def test_lists_have_a_type_and_no_value() -> None:
    text = "a: [1, 2.5]\nb:\n- x\n- y\nc: [[1], [2]]\nd: []\ne: [1, x]\nf: 1\n"

    assert values(text) == {
        "a": ("float64[]", None),
        "b": ("string[]", None),
        "f": ("int64", 1),
    }
    assert said(read(text)[1]) == [("left-out", name) for name in "abcde"]


@pytest.mark.parametrize("value", [".inf", "-.inf", ".nan", "9223372036854775808", r'"\x07"'])
def test_values_that_no_model_can_have(value: str) -> None:
    (_, written), *_ = values(f"a: {value}\n").values()

    assert written is None
    assert said(read(f"a: {value}\n")[1]) == [("left-out", "a")]


@pytest.mark.parametrize(
    "value", ["", "~", "!degrees 90", "!!binary aGk=", "{}", "!!python/object:os.system {x: 1}"]
)
def test_values_without_a_type(value: str) -> None:
    owners, report = read(f"a: {value}\nb: 1\n")

    assert list(owners["uav"].params) == ["b"]
    assert said(report) == [("left-out", "a")]


def test_comments_document_what_they_stand_above_and_behind() -> None:
    text = """\
# All of it.
# And more.

# Above.
rate:  5.0   # Behind.
  # Further in.
#old:   1    # commented out
size: 1 #without a blank
text: "a # b"  # Not in the text.
list:          # Of the list.
# Of an element.
- 1
- 2  # Behind the last.
group:         # Of the group.
  # Of the first.
  first: 1     # Of it.
  second: 2
  # Below.
flow: {a: 1, b: 2} # Of both.
# At the end.
"""
    owners, _ = read(text)

    assert owners["uav"].doc == "All of it.\nAnd more."
    assert docs(text) == {
        "rate": "Above.\nBehind.\nFurther in.",
        "size": "without a blank",
        "text": "Not in the text.",
        "list": "Of the list.\nBehind the last.",
        "group_first": "Of the group.\nOf the first.\nOf it.",
        "group_second": "Below.",
        "flow_a": "",
        "flow_b": "Of both.\nAt the end.",
    }


def test_names_in_groups_are_joined() -> None:
    text = "spiral:\n  fov: 0.5\n  inner:\n    state: 1\nspiral_fov: 1\nmaxSpeed: 1\n"
    owners, report = read(text)

    assert [(written, p.name) for written, p in owners["uav"].params.items()] == [
        ("spiral/fov", "spiral_fov"),
        ("spiral/inner/state", "spiral_inner_state"),
        ("spiral_fov", "spiral_fov2"),
        ("maxSpeed", "maxSpeed"),
    ]
    assert said(report) == [("renamed", "fov"), ("renamed", "state"), ("renamed", "spiral_fov")]


def test_nodes_of_ros_2() -> None:
    text = """\
/ns/planner:
  ros__parameters:
    rate: 5.0
    inner: {deep: 1}
/**:
  ros__parameters:
    size: 1
"""
    owners, _ = read(text)

    assert {name: list(owner.params) for name, owner in owners.items()} == {
        "planner": ["rate", "inner/deep"],
        "uav": ["size"],
    }


def test_the_first_of_several_files_counts() -> None:
    owners, _ = read("a: 1\n")
    _, report = read("a: 2\nb: 3\n", owners)

    assert [p.default.value for p in owners["uav"].params.values() if p.default] == [1, 3]  # type: ignore[union-attr]
    assert said(report) == [("left-out", "a")]


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("a: 1\n  b: 2\n", ":"),
        ("a: [1\n", ""),
        ("a: 1\n--- \nb: 2\n", "-"),
        ("a: \x01\n", "\x01"),
        ("a: *b\n", "*"),
        ("[" * 5000, "["),
    ],
)
def test_what_is_no_yaml(text: str, place: str) -> None:
    owners, report = read(text)

    assert owners == {}
    assert said(report) == [("not-yaml", place)]


@pytest.mark.parametrize(
    ("text", "left"), [("- 1\n", "- 1\n"), ("? [1]\n: 2\n", "[1]"), ("", None)]
)
def test_yaml_without_parameters(text: str, left: str | None) -> None:
    owners, report = read(text)

    assert not any(owner.params for owner in owners.values())
    assert said(report) == ([("left-out", left)] if left else [])


def test_aliases_do_not_multiply_without_end() -> None:
    lines = ["a0: &a0 {x: 1}"]
    lines += [
        f"a{i}: &a{i} {{p: *a{i - 1}, q: *a{i - 1}, r: *a{i - 1}, s: *a{i - 1}}}"
        for i in range(1, 12)
    ]
    owners, report = read("\n".join(lines))

    assert len(owners["uav"].params) == 10_000
    assert {found.name for found in report} == {"left-out", "renamed"}
