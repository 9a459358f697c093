"""Diagnostics, with locations, for what the target cannot express or name."""

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline

Reported = Callable[..., list[tuple[str, str, str]]]

HEADER = 'package p\nevent E : m/E\nfunction f : swarm { action "f" : m/F }\n'


def _machine(body: str, name: str = "M") -> str:
    return f"{HEADER}statemachine {name} {{ {body} }}"


SMALL = "initial A; state A { on E -> B } final B"


ENDED = "initial B; final B"
"""Body of a machine that ends at once."""
UNSUPPORTED = "target `smach` cannot express an initial state that is final"


def test_unsupported(reported: Reported) -> None:
    assert reported(_machine(ENDED)) == [("unsupported-construct", UNSUPPORTED, "M")]


@pytest.mark.parametrize(
    ("text", "place", "name", "use"),
    [
        (_machine(f"var lambda : int32; {SMALL}"), "lambda", "lambda", "a key of userdata"),
        (_machine(f"var keys : int32; {SMALL}"), "keys", "keys", "a key of userdata"),
        (_machine(f"param _x : int32 = 1; {SMALL}"), "_x", "_x", "a key of userdata"),
        (_machine(SMALL, "Lambda"), "Lambda", "lambda", "a module name"),
        (_machine(SMALL, "States"), "States", "states", "a module name"),
        (_machine(SMALL, "_"), "_", "_", "a module name"),
        (_machine(SMALL, "_1"), "_1", "1", "a module name"),
        (
            _machine(SMALL.replace("on E", "on _")) + '\nevent _ : m/E on "e"',
            "_",
            "_",
            "the name of a constant",
        ),
        (
            _machine(SMALL.replace("on E", "on _2")) + '\nevent _2 : m/E on "e"',
            "_2",
            "_2",
            "the name of a constant",
        ),
        (
            f"{_machine(SMALL)}\nstruct S {{ _x : int32 }}",
            "_x",
            "_x",
            "the name of a field",
        ),
        (
            f"{_machine(SMALL)}\naction Go {{ }}\nstruct GoGoal {{ x : int32 }}",
            "GoGoal",
            "GoGoal",
            "two types of a package",
        ),
        (
            f"{_machine(SMALL)}\nstruct S {{ x : int32 }}\nmessage p/T {{ x : int32 }}",
            "p/T",
            "p",
            "a third-party package: a generated package has that name",
        ),
        (
            f"{_machine(SMALL)}\nstruct S {{ x : int32 }}".replace("package p", "package smach"),
            "S",
            "smach",
            "the name of a ROS package",
        ),
        (
            f"{_machine(SMALL)}\nstruct S {{ x : int32 }}".replace("package p", "package _p"),
            "S",
            "_p",
            "the name of a ROS package",
        ),
        (
            _machine(
                "initial A; state A { do f(by pass); on succeeded -> B; on aborted -> B } final B"
            ),
            "do f(by pass)",
            "pass",
            "the name of a function",
        ),
        (
            f"{_machine(SMALL, 'One')}\nstatemachine one {{ {SMALL} }}",
            "one",
            "one",
            "the module of two machines, `One` and `one`",
        ),
        (
            f"{_machine(SMALL)}\nstruct lower {{ x : int32 }}",
            "lower",
            "lower",
            "the name of an interface",
        ),
    ],
)
def test_bad_identifiers(text: str, place: str, name: str, use: str, reported: Reported) -> None:
    message = f"target `smach` cannot use `{name}` as {use}"
    assert ("bad-identifier", message, place) in reported(text)


def test_bad_package_option(reported: Reported) -> None:
    ((name, message, _),) = reported(_machine(SMALL), package="My-Package")
    assert name == "bad-option"
    assert "`My-Package` cannot be the name of the package" in message


@pytest.mark.parametrize(
    ("option", "value", "fault"),
    [
        ("package", "smach", "`smach` cannot be the name of the package"),
        ("version", "1.0", "`1.0` is not a version: expected three numbers, such as `1.2.0`"),
        ("version", "1.0.0\n", "`1.0.0\n` is not a version"),
        ("email", "somebody", "`somebody` is not an e-mail address"),
        ("email", "a b@example.org", "`a b@example.org` is not an e-mail address"),
        ("maintainer", " ", "option `maintainer` needs a text on one line"),
        ("license", "MIT\x01", "option `license` needs a text on one line"),
    ],
)
def test_bad_options(option: str, value: str, fault: str, reported: Reported) -> None:
    ((name, message, _),) = reported(_machine(SMALL), **{option: value})
    assert name == "bad-option"
    assert fault in message


def test_package_of_interfaces_called_like_the_other(reported: Reported) -> None:
    text = f"{_machine(SMALL)}\nstruct S {{ x : int32 }}"
    ((name, message, at),) = reported(text, package="p")
    assert (name, at) == ("bad-identifier", "S")
    assert "the package with the behaviour has that name" in message


def test_constants_that_ros_cannot_hold(reported: Reported) -> None:
    for value, construct in (('" a"', "blanks around it"), ('"a\\nb"', "line breaks")):
        text = f"{_machine(SMALL)}\nmessage C {{ const c : string = {value} }}"
        ((name, message, at),) = reported(text)
        assert (name, at) == ("unsupported-construct", "c")
        assert construct in message


def test_wide_strings_are_none_of_ros_1(reported: Reported) -> None:
    ((name, message, at),) = reported(f"{_machine(SMALL)}\nstruct S {{ x : wstring }}")
    assert (name, at) == ("unsupported-construct", "x")
    assert message.endswith("a `wstring`")


def test_nothing_without_a_machine(generate: Callable[..., dict[str, object]]) -> None:
    assert generate("package p\nstruct S { x : int32 }") == {}


def test_machines_that_get_no_node_may_use_anything(tmp_path: Path) -> None:
    model = f"{_machine(SMALL)} statemachine Unused {{ {ENDED} }}"
    found = ("unsupported-construct", UNSUPPORTED, "Unused")
    assert _built(tmp_path, {"model": model}) == [found]
    assert _built(tmp_path, {"model": f"{model} member R {{ behavior M }}"}) == []


def test_whole_numbers_that_the_parameter_server_does_not_hold(tmp_path: Path) -> None:
    params = "param big : int64 = 2147483648; param real : float64 = 2147483648"
    given = "param big : int64 = -2147483649"
    text = f"{_machine(f'{params}; {SMALL}')} member R {{ behavior M }}"
    other = (
        f"member S {{ behavior M; {given} }} member T {{ behavior M; {given.replace('9', '8')} }}"
    )
    assert _built(tmp_path, {"model": f"{text} {other}"}) == [
        ("unsupported-construct", f"target `smach` cannot express a param of {value}", place)
        for value, place in [(2147483648, "2147483648"), (-2147483649, "-2147483649")]
    ]
    assert _built(tmp_path, {"model": text.replace("8; param", "7; param")}) == []
    written = tmp_path / "out" / "smach" / "p_behavior" / "param" / "r.yaml"
    assert "  big: 2147483647\n  real: 2147483648.0\n" in written.read_text(encoding="utf-8")


def test_packages_whose_interfaces_need_each_other(tmp_path: Path) -> None:
    first = (
        'package a\nimport "b.swarm"\nmessage A { b : B }\nstruct C { x : int32 }\n'
        f"event E : A\nstatemachine M {{ {SMALL} }}\n"
    )
    found = _built(tmp_path, {"a": first, "b": "package b\nstruct B { more : a/C }\n"})
    construct = "packages whose interfaces depend on each other (a -> b -> a)"
    message = f"target `smach` cannot express {construct}"
    assert found == [("unsupported-construct", message, "A")]


def _built(folder: Path, texts: dict[str, str]) -> list[tuple[str, str, str]]:
    """The errors of a build of these files, the first being the one that is named."""
    for name, text in texts.items():
        (folder / f"{name}.swarm").write_text(text, encoding="utf-8")
    path = folder / f"{next(iter(texts))}.swarm"
    report = pipeline.build([path], [Request("smach", {})], folder / "out").report
    return [
        (found.name, found.message, found.primary.span.text if found.primary else "")
        for found in report
        if found.severity is Severity.ERROR
    ]
