"""Twice the model is twice the work: functions that are called are counted, not seconds."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import FORMATS, render
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.syntax.parse import parse
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.recovery.prescan import scan
from swarmdsl.syntax.recovery.statements import statement_at

HEAD = "package p\nevent Go : std_msgs/Empty\nevent Num : std_msgs/Int32\n"
FEW = 60


def each(pattern: str) -> Callable[[int], str]:
    """Return a file with many declarations; `<i>` is the number of each, `<j>` that of the next."""
    return lambda count: HEAD + repeated(pattern, count)


def machine(pattern: str, around: str = "<>", values: str = "") -> Callable[[int], str]:
    """A machine of that many states, or of one with that many transitions."""

    def text(count: int) -> str:
        inside = around.replace("<>", repeated(pattern, count))
        inside = inside.replace("<n>", str(count))
        return f"{HEAD}statemachine M {{\n{values}{inside}\nfinal F\n}}\n"

    return text


def repeated(pattern: str, count: int) -> str:
    return "".join(
        pattern.replace("<i>", str(number)).replace("<j>", str(number + 1)) + "\n"
        for number in range(count)
    )


def chain(pattern: str, last: str) -> Callable[[int], str]:
    """Declarations each of which leads to the next."""
    return lambda count: each(pattern)(count) + last.replace("<n>", str(count))


ON_S = "initial S\nstate S {\n<>\non Go -> F }"
MODELS = {
    "functions": each('function f_<i> : abstraction { service "f_<i>" : std_srvs/Empty }'),
    "states": machine("state S<i> { on Go -> S<j> }", "initial S0\n<> state S<n> { on Go -> F }"),
    "effects on exit": machine(
        "state S<i> { on Num -> S<j>\nexit / x = <i> }",
        "initial T; state T { initial S0\n<> state S<n> { on Go -> S0 }\n"
        "on Num [x > 3] / x = event.data -> F }",
        "var x : int32\n",
    ),
    "values of an enum": lambda count: (
        each("")(count)
        + f"enum E : uint32 {{ {repeated('V<i>', count + 1)} }}\n"
        + "statemachine M { var e : E = E.V0\ninitial S\nstate S {\n"
        + repeated("on Num [e == E.V<i>] / e = E.V<j> -> S", count)
        + "on Go -> F }\nfinal F }"
    ),
    "transitions": machine("on Num [event.data == <i>] -> F", ON_S),
    "guards of two terms": machine(
        "on Num [event.data == <i> and x < <i>] / x = x + 1 -> F", ON_S, "var x : int32 = 0\n"
    ),
    "variables": lambda count: (
        HEAD
        + f"statemachine M {{\n{repeated('var v<i> : int32', count)}initial S; state S {{\n"
        + repeated("on Num [v<i> == event.data] / v<i> = event.data -> S", count)
        + "on Go -> F }\nfinal F }"
    ),
    "delays": machine("after <j> s -> F", ON_S),
    "branches": machine(
        "[x == <i>] -> F",
        "initial S; state S { on Num / x = event.data -> C }\nchoice C {\n<>\nelse -> F }",
        "var x : int32 = 0\n",
    ),
    "final states": machine(
        "final F<i>", "initial S; state S { initial A; state A { on Go -> F0 }\n<> on done -> F }"
    ),
    "aliases": chain("type A<i> = A<j>", "type A<n> = int32"),
    "constants": chain("const K<i> : int32 = K<j>", "const K<n> : int32 = 1"),
    "constants of a constant": chain("const K<i> : int32 = LAST", "const LAST : int32 = 1"),
    "structs": chain("struct S<i> { a : S<j> }", "struct S<n> { a : int32 }"),
    "members that extend": chain("member M<i> extends M<j> { }", "member M<n> { }"),
    "machines that reuse": chain(
        "statemachine M<i> { initial A; state A = M<j> { on done -> F } final F }",
        "statemachine M<n> { initial A; state A { on Go -> F } final F }",
    ),
    "members with one machine": lambda count: (
        each("member R<i> { behavior M }")(count)
        + "statemachine M { initial A; state A { on Go -> F } final F }"
    ),
    "parts": lambda count: (
        HEAD
        + "sensor C { out a : std_msgs/Empty }\nactuator D { in a : std_msgs/Empty }\nmember R {"
        + repeated("c<i> : C\nd<i> : D\nconnect c<i>.a -> d<i>.a", count)
        + "}"
    ),
    "connectors of unknown ports": lambda count: (
        HEAD
        + f"controller C {{ {repeated('out a<i> : std_msgs/Empty', count)} }}\n"
        + f"controller D {{ {repeated('in a<i> : std_msgs/Empty', count)} }}\n"
        + f"member R {{ c : C; d : D {repeated('connect c.b<i> -> d.a<i>', count)} }}"
    ),
    "unknown params": lambda count: (
        HEAD
        + f"controller C {{ {repeated('param a<i> : int32 = 0', count)} }}\n"
        + f"member R {{ c : C {{ {repeated('b<i> = 1', count)} }} }}"
    ),
    "unknown types": each("struct S<i> { a : Missing<i> }"),
    "unknown states": machine("state S<i> { on Go -> T<i> }", "initial S0\n<>"),
    "unknown values": each("const K<i> : int32 = missing<i>"),
    "unknown values in activities": lambda count: (
        HEAD
        + repeated('function f_<i> : abstraction { action "f_<i>" : p/A<i> }', count)
        + repeated("action A<i> { goal { g : uint8 } result { r : uint8 } }", count)
        + "statemachine M { initial S0\n"
        + repeated("state S<i> { do f_<i>(g = unknown_<i>); on succeeded -> S<j> }", count)
        + "state S<n> { on Go -> F }\nfinal F }".replace("<n>", str(count))
    ),
    "one unknown value among activities": lambda count: (
        HEAD
        + repeated('function f_<i> : abstraction { action "f_<i>" : p/A<i> }', count)
        + repeated("action A<i> { goal { g : uint8 } result { r : uint8 } }", count)
        + "statemachine M { initial S0\n"
        + repeated("state S<i> { do f_<i>(g = 1); on succeeded -> S<j> }", count)
        + "state S<n> { on Go [abs(missing) > 1] -> F }\nfinal F }".replace("<n>", str(count))
    ),
    "unreachable states": machine("state S<i> { on Go -> F }\nfinal F<i>", "initial F\n<>"),
    "one name": each("struct S { a : int32 }"),
    "names in another style": each("struct s_<i> { a : int32 }"),
    "one line": lambda count: each("struct s_<i> { a : int32 }")(count).replace("\n", " "),
}

BROKEN: dict[str, tuple[Callable[[Source, Diagnostics], object], Callable[[int], str]]] = {
    "blocks that were not opened": (
        scan,
        lambda count: repeated("state A\n  do b\n}", count),
    ),
    "blocks in each other": (
        lambda source, _: statement_at(source.text, len(source.text)).around,
        lambda count: "state S { " * 20 * count,
    ),
    "merges that stopped": (
        scan,
        lambda count: repeated("<<<<<<< a\n=======\n>>>>>>> b\n>>>>>>> c\n=======", count),
    ),
    "brackets closed by others": (
        parse,
        lambda count: "struct S {\n" + repeated("a<i> : int32[3)", count) + "}\n",
    ),
}


def work(action: Callable[[], object]) -> int:
    """Return the number of function calls."""
    calls = 0

    def count(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal calls
        calls += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        action()
    finally:
        sys.setprofile(before)
    return calls


def is_proportional(works: list[int]) -> bool:
    """Return True if cost grows linearly: from twice to four times as from once to twice."""
    once, twice, four_times = works
    return four_times - twice < 2.4 * (twice - once)


@pytest.mark.parametrize("name", MODELS)
def test_twice_the_model_is_twice_the_work(name: str, tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    works = []
    for count in (1, FEW, 2 * FEW, 4 * FEW):  # the first time much is read that is kept
        path.write_text(MODELS[name](count), encoding="utf-8")
        works.append(work(lambda: pipeline.check([path])))
    assert is_proportional(works[1:]), works


@pytest.mark.parametrize("name", BROKEN)
def test_twice_the_wrong_brackets_are_twice_the_work(name: str) -> None:
    works = []
    read, text = BROKEN[name]
    for count in (1, 2 * FEW, 4 * FEW):
        source = Source("model.swarm", text(count))
        works.append(work(lambda: read(source, Diagnostics())))  # noqa: B023
    assert works[-1] < 2.4 * works[-2], works


def test_a_long_line_of_mistakes_is_not_read_thousands_of_times(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text = HEAD + "-> " * 2_000
    read = []

    def counted(source: Source, docs: dict[int, str], limit: int) -> object:
        read.append(len(source.text))
        return original(source, docs, limit)

    original = generated.parse
    monkeypatch.setattr(generated, "parse", counted)
    parse(Source("model.swarm", text), Diagnostics())

    assert sum(read) < 20 * len(text)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("name", ["unknown types", "one line", "one name"])
def test_twice_the_diagnostics_are_twice_the_work(name: str, kind: str, tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    works = []
    for count in (1, FEW, 2 * FEW, 4 * FEW):
        path.write_text(MODELS[name](count), encoding="utf-8")
        report = pipeline.check([path]).report
        with (tmp_path / "output").open("w", encoding="utf-8") as stream:
            works.append(work(lambda: render(report, kind, stream)))  # noqa: B023
    assert is_proportional(works[1:]), works


def test_many_files_that_import_each_other(tmp_path: Path) -> None:
    works = []
    for count in (1, FEW, 2 * FEW, 4 * FEW):
        folder = tmp_path / str(count)
        folder.mkdir(exist_ok=True)
        for number in range(count):
            text = f"package p{number}\nconst K{number} : int32 = {number}\n"
            if number + 1 < count:
                text = text.replace("\n", f'\nimport "f{number + 1}.swarm"\n', 1)
            (folder / f"f{number}.swarm").write_text(text, encoding="utf-8")
        works.append(work(lambda: pipeline.check([folder / "f0.swarm"])))  # noqa: B023
    assert is_proportional(works[1:]), works


@pytest.mark.parametrize("name", ["aliases", "constants", "structs"])
def test_long_chains_are_valid(name: str, tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    path.write_text(MODELS[name](3_000), encoding="utf-8")
    assert [found.message for found in pipeline.check([path]).report] == []


@pytest.mark.parametrize("name", ["members that extend", "machines that reuse"])
def test_chains_that_are_too_long_are_told(name: str, tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    path.write_text(MODELS[name](200), encoding="utf-8")
    assert [found.name for found in pipeline.check([path]).report] == ["nested-too-deeply"]
