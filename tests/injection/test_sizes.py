"""Numbers, names and strings of any size: a diagnostic, and no internal error."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from ..conftest import Ran

# Python converts 4,300 digits at most.
DIGITS = "9" * 50_000
MODELS = {
    "a value of an enum": ("enum E {{\n  A = {}\n}}", "SW0609"),
    "an initial value": ("statemachine M {{ var x : int = {}\n initial A\n final A }}", "SW0101"),
    "a delay": ("statemachine M {{ initial A\n state A {{ after {} s -> A }} }}", "SW0101"),
    "a multiplicity": ("member U {{ }}\nswarm S {{ u : U[{}] }}", "SW0301"),
    "an index": ("member U {{ }}\nswarm S {{ u : U[*] {{ }}\n u[{}] {{ }} }}", "SW0311"),
    "an array": ("message a/B {{ x : int[{}] }}", "SW"),
    "a bound": ("message a/B {{ x : string<={} }}", "SW"),
}
MACHINE = (
    '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript">'
    '<datamodel><data id="x" expr="{0}"/></datamodel><state id="A">'
    '<onentry><send event="e" delay="{0}s"/><assign location="x" expr="x + {0}"/></onentry>'
    '<transition event="e" cond="x &gt; {0}" target="A"/></state></scxml>'
)
YAML = "a: {0}\nb: .inf\nc: .nan\nd: -.inf\ne: [.inf, 1.0]\nf: 1e{0}\ng: 0x{0}\nh: 0b{1}\n"
MESSAGE = "int32 X={0}\nint32[{0}] y\nstring<={0} z\nint32 d {0}\nfloat64 E=1e{0}\n"


@pytest.mark.parametrize("case", MODELS)
def test_numbers_in_models(case: str, folder: Path, swarmc: Callable[..., Ran]) -> None:
    text, code = MODELS[case]
    (folder / "model.swarm").write_text(f"package a\n{text.format(DIGITS)}\n")
    done = swarmc("check", "model.swarm")
    assert done.code == 1
    assert f"[{code}" in done.out


@pytest.mark.parametrize("number", [DIGITS, f"0x{DIGITS}", f"1e{DIGITS}", "1e308"])
def test_numbers_in_documents(number: str, folder: Path, swarmc: Callable[..., Ran]) -> None:
    (folder / "machine.scxml").write_text(MACHINE.format(number))
    assert swarmc("import", "scxml", "machine.scxml").code in (0, 1)
    assert swarmc("simulate", "machine.scxml", "--until", "1s").code in (0, 1)


def test_numbers_in_packages(folder: Path, swarmc: Callable[..., Ran]) -> None:
    for path, text in (("config/a.yaml", YAML), ("msg/A.msg", MESSAGE)):
        place = folder / "package" / path
        place.parent.mkdir(parents=True)
        place.write_text(text.format(DIGITS, "1" * 50_000))
    done = swarmc("import", "ros", "package")
    assert done.code == 1
    assert "`int32[" in done.err or "SW0101" in done.err


@pytest.mark.parametrize("number", ["1e999", "-1e999", "1e308", "9" * 30])
def test_numbers_in_descriptions(number: str, folder: Path, swarmc: Callable[..., Ran]) -> None:
    constants = f'[{{"name": "X", "class": "duration", "value": {number}}}]'
    (folder / "a.json").write_text(
        '{"functions": [{"name": "fly", "param_list": '
        f'[{{"name": "p", "class": "number", "value": {number}}}], "api": {{"outputs": '
        f'[{{"topic": "t", "msg": {{"class": "A", "constants": {constants}}}}}]}}}}]}}'
    )
    done = swarmc("import", "adf", "a.json")
    assert done.code in (0, 1)
    assert "is left out" in done.err


@pytest.mark.parametrize("line", ['{"t": %s}', '{"event": "Go", "after": %s}'])
@pytest.mark.parametrize("option", ["--events", "--replay"])
@pytest.mark.parametrize("number", [DIGITS, "9" * 400], ids=len)
def test_numbers_in_recordings(
    number: str, line: str, option: str, folder: Path, swarmc: Callable[..., Ran]
) -> None:
    (folder / "machine.scxml").write_text(MACHINE.format(1))
    (folder / "lines.jsonl").write_text(line % number)
    assert swarmc("simulate", "machine.scxml", option, "lines.jsonl").code == 1


@pytest.mark.parametrize("text", ["seed = {}", 'until = "{} s"', "[network]\nloss = {}"])
@pytest.mark.parametrize("number", [DIGITS, "9" * 20, f"0x{DIGITS}"], ids=len)
def test_numbers_in_scenarios(
    number: str, text: str, folder: Path, swarmc: Callable[..., Ran]
) -> None:
    (folder / "machine.scxml").write_text(MACHINE.format(1))
    (folder / "scenario.toml").write_text(text.format(number))
    done = swarmc("simulate", "machine.scxml", "--scenario", "scenario.toml")
    assert done.code == 1


FLOATING = """package a
message a/Level {{ value : float64, whole : int32 }}
event Go : a/Level
statemachine M {{ initial A
 state A {{ on Go -> End }}
 final End }}
member B {{ behavior M }}
"""


@pytest.mark.parametrize("number", ["9" * 400, "1" + "0" * 30, "-" + "9" * 400], ids=len)
@pytest.mark.parametrize("key", ["value", "whole"])
def test_numbers_in_data(key: str, number: str, folder: Path, swarmc: Callable[..., Ran]) -> None:
    """Whole numbers where a model has others."""
    (folder / "model.swarm").write_text(FLOATING.format())
    (folder / "events.jsonl").write_text(f'{{"event": "Go", "data": {{"{key}": {number}}}}}')
    scenario = f'[[messages]]\nevent = "Go"\nat = "1 s"\ndata = {{ {key} = {number} }}\n'
    (folder / "scenario.toml").write_text(scenario)
    for option in ("--events=events.jsonl", "--scenario=scenario.toml"):
        assert swarmc("simulate", "model.swarm", option).code == 1


def test_numbers_in_logs(folder: Path, swarmc: Callable[..., Ran]) -> None:
    (folder / "a.log").write_text(f'  File "a.py", line {DIGITS}, in f\na.py:{DIGITS}: error\n')
    assert swarmc("trace", "a.log").code in (0, 1)


@pytest.mark.parametrize("value", ["{}", '{"a": 1}', "[]", "[[]]", "1", "true", "null"])
@pytest.mark.parametrize("key", ["name", "category", "description", "api", "param_list"])
def test_other_values_in_descriptions(
    key: str, value: str, folder: Path, swarmc: Callable[..., Ran]
) -> None:
    described = f'[{{"name": "fly", "{key}": {value}}}]'
    (folder / "a.json").write_text(
        f'{{"functions": {described}, "sensors/actuators": {described}}}'
    )
    for format_ in ("adf", "amf"):
        assert swarmc("import", format_, "a.json").code in (0, 1)


@pytest.mark.parametrize(
    "name", ["...*", "....", "a...b", "..", ".*", "a..*", '"..."', 'ros "..."']
)
def test_imports_of_dots(name: str, folder: Path, swarmc: Callable[..., Ran]) -> None:
    (folder / "model.swarm").write_text(f"import {name}\nevent E : std_msgs/Empty\n")
    assert swarmc("check", "model.swarm").code == 1


@pytest.mark.timeout(60)
def test_a_constant_that_doubles(folder: Path, swarmc: Callable[..., Ran]) -> None:
    doubled = "".join(f"const A{n + 1} : string = A{n} + A{n}\n" for n in range(40))
    (folder / "model.swarm").write_text(f'const A0 : string = "{"a" * 64}"\n{doubled}')
    done = swarmc("check", "model.swarm")
    assert done.code == 1
    assert "it would be longer than 65536 characters" in done.out
    assert "1 error in 1 file" in done.err


@pytest.mark.timeout(60)
def test_many_long_constants(folder: Path, swarmc: Callable[..., Ran]) -> None:
    long = "a" * 30_000
    uses = "".join(f"const B{n} : string = A + A\n" for n in range(300))
    (folder / "model.swarm").write_text(f'const A : string = "{long}"\n{uses}')
    done = swarmc("check", "model.swarm")
    assert done.code == 1
    assert "all strings would be longer than 16777216 characters" in done.out
