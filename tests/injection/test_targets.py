"""Text of a model reaches the readers of every target as it is, or is rejected at its place."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from markdown_it import MarkdownIt

from swarmdsl.codegen import registry

from .conftest import Make
from .model import DOCS, ENDS, HOSTILE, Place, model, placeholders, replaced
from .readers import content, with_strings

Variant = tuple[str, dict[str, str]]

VARIANTS: list[Variant] = [
    *((target, {}) for target in registry.BUILT_IN if target != "skeleton"),
    *(
        ("skeleton", {"language": language, "ros": ros})
        for language in ("python", "cpp")
        for ros in ("1", "2")
    ),
    ("smach", {"ros": "2"}),
    ("adf", {"form": "schema"}),
]
# The places of strings that are not safe in every target.
PLACES = (
    "message constant",
    "param of a member",
    "param of a machine",
    "value of a role",
    "value of a robot",
)
ROS1 = {"smach", "skeleton python 1", "skeleton cpp 1"}
ROS2 = {"ros2", "yasmin", "smach 2", "skeleton python 2", "skeleton cpp 2"}
# What people read, and what they write; all others are read by programs.
FOR_PEOPLE = re.compile(r"README\.md$|param/team/")
# Its digest is that of the model with these strings.
DIGEST = re.compile(r"_behavior/model\.py$")


def name_of(variant: Variant) -> str:
    target, options = variant
    return " ".join([target, *options.values()])


def is_rejected(name: str, place: str, text: str) -> bool:
    """Return True for a string that the readers of a target would change, or fail at."""
    if place == "message constant" and name in ROS1 | ROS2:
        changed = text != text.strip() if name in ROS1 else "#" in text
        return "\\" in text or not text.isprintable() or changed
    return False


def differences(one: Any, other: Any, at: str = "") -> Iterator[str]:
    if type(one) is not type(other) or (isinstance(one, list) and len(one) != len(other)):
        yield f"{at}: {one!r:.300} is {other!r:.300}"
    elif isinstance(one, list):
        for number, (left, right) in enumerate(zip(one, other, strict=True)):
            yield from differences(left, right, f"{at}[{number}]")
    elif isinstance(one, dict):
        for key in sorted({*one, *other}, key=str):
            yield from differences(one.get(key), other.get(key), f"{at}.{key}")
    elif one != other:
        yield f"{at}: {one!r} is {other!r}"


@pytest.mark.parametrize("variant", VARIANTS, ids=name_of)
def test_strings_are_the_same_for_the_readers(variant: Variant, make: Make) -> None:
    target, options = variant
    ros = 2 if name_of(variant) in ROS2 else 1
    # What has no place in a target, as a string or not.
    dropped = make(model(placeholders(HOSTILE), "x"), target, options).rejected.keys()
    rejected: set[Place] = set()
    # A value that is left out uncovers another one.
    while more := make(model(HOSTILE, "x", rejected), target, options).rejected.keys() - dropped:
        assert not more & rejected
        rejected |= more
    assert rejected == {
        (place, number)
        for place in PLACES
        for number, text in enumerate(HOSTILE)
        if is_rejected(name_of(variant), place, text)
    }

    theirs = make(model(HOSTILE, "x", rejected), target, options)
    plain = make(model(placeholders(HOSTILE), "x", rejected), target, options)
    assert theirs.files.keys() == plain.files.keys()
    for path, text in theirs.files.items():
        if text != plain.files[path] and not (FOR_PEOPLE.search(path) or DIGEST.search(path)):
            expected = with_strings(
                content(path, plain.files[path], ros), lambda each: replaced(each, HOSTILE)
            )
            assert list(differences(expected, content(path, text, ros))) == [], path


@pytest.mark.parametrize("variant", VARIANTS, ids=name_of)
def test_documentation_changes_nothing_but_documentation(variant: Variant, make: Make) -> None:
    target, options = variant
    for end in ENDS:
        lines = [*DOCS, end] if end == ENDS[0] else [f"start {end}", end]
        marks = [f"D{number:03}C" for number, _ in enumerate(lines)]
        plain = make(model(["x"], "\n".join(marks)), target, options)
        made = make(model(["x"], "\n".join(lines)), target, options)
        assert made.files.keys() == plain.files.keys()
        for path, text in made.files.items():
            if text == plain.files[path] or FOR_PEOPLE.search(path):
                continue
            expected = with_strings(
                content(path, plain.files[path]),
                lambda each, lines=lines: one_line(
                    re.sub(r"D(\d{3})C", lambda mark: lines[int(mark[1])], each)
                ),
            )
            found = with_strings(content(path, text), one_line)
            assert list(differences(expected, found)) == [], path


def one_line(text: str) -> str:
    return " ".join(text.split())


@pytest.mark.parametrize(
    "variant", [each for each in VARIANTS if name_of(each) in ROS1 | ROS2], ids=name_of
)
def test_documentation_in_readmes_is_text(variant: Variant, make: Make) -> None:
    target, options = variant
    name = "<b>![x](x) --> [y](y).swarm"
    hostile = make(
        model(DOCS, "\n\n".join([*DOCS, "# head", "head", "---"])), target, options, name
    )
    plain = make(model(placeholders(DOCS), "\n\n".join("x" * (len(DOCS) + 3))), target, options)
    paths = [path for path in hostile.files if path.endswith("README.md")]
    assert paths
    for path in paths:
        mine, theirs = (marks(made.files[path]) for made in (hostile, plain))
        assert mine == theirs, path


def marks(text: str) -> list[str]:
    """Return what is not text in a document, in order."""
    tokens = MarkdownIt("gfm-like", {"linkify": False}).parse(text)
    inner = [child for token in tokens for child in token.children or ()]
    kinds = ("heading_open", "fence", "td_open", "html_block", "html_inline", "image", "link_open")
    return [token.type for token in (*tokens, *inner) if token.type in kinds]
