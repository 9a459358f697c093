"""What the target cannot express or name is reported where it stands."""

from collections.abc import Callable

import pytest

Reported = Callable[..., list[tuple[str, str, str]]]

HEADER = 'package p\nevent E : m/E\nfunction f : swarm { action "f" : m/F }\n'


def _machine(body: str, name: str = "M") -> str:
    return f"{HEADER}statemachine {name} {{ {body} }}"


SMALL = "initial A state A { on E -> B } final B"
GUARDED = """
var n : int32
initial P
parallel state P {
  region R { initial A state A { on E -> Z } final Z }
  on R.done [n > 1] -> End
}
final End
"""


@pytest.mark.parametrize(
    ("body", "place", "construct"),
    [
        (
            GUARDED,
            "on R.done [n > 1] -> End",
            "a guard on the completion of a region without a transition for when it is false",
        ),
        (f"param pose : m/Pose {SMALL}", "pose", "a param of type `m/Pose`"),
        ("initial B final B", "M", "an initial state that is final"),
    ],
)
def test_unsupported(body: str, place: str, construct: str, reported: Reported) -> None:
    text = _machine(body).replace("statemachine", "endless statemachine")
    ((name, message, at),) = reported(text)
    assert (name, message) == (
        "unsupported-construct",
        f"target `smach` cannot express {construct}",
    )
    assert at == place


@pytest.mark.parametrize(
    ("text", "place", "name", "use"),
    [
        (_machine(f"var lambda : int32 {SMALL}"), "lambda", "lambda", "a key of userdata"),
        (_machine(f"var keys : int32 {SMALL}"), "keys", "keys", "a key of userdata"),
        (_machine(f"param _x : int32 = 1 {SMALL}"), "_x", "_x", "a key of userdata"),
        (_machine(SMALL, "Lambda"), "Lambda", "lambda", "a module name"),
        (_machine(SMALL, "States"), "States", "states", "a module name"),
        (
            _machine(
                "initial A state A { do f(by pass) on succeeded -> B on aborted -> B } final B"
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


def test_nothing_without_a_machine(generate: Callable[..., dict[str, object]]) -> None:
    assert generate("package p\nstruct S { x : int32 }") == {}
