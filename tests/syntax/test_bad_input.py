"""Bad input of any kind gives a diagnostic at its place, and quickly."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.cli import run
from swarmdsl.driver import pipeline

START = "event Start : std_msgs/Empty\n"
LONG = 1_000_000
# The slowest of these takes a tenth of it.
soon = pytest.mark.timeout(60)

Check = Callable[[str | bytes], list[tuple[str, int, int]]]


def place(found: Diagnostic) -> tuple[str, int, int]:
    """Name, line and column; 0 for a diagnostic without a place."""
    if found.primary is None:
        return found.name, 0, 0
    source, start, end = found.primary.span
    assert 0 <= start <= end <= len(source.text)
    return found.name, *source.line_column(start)


@pytest.fixture
def check(tmp_path: Path) -> Check:
    def check_text(content: str | bytes) -> list[tuple[str, int, int]]:
        path = tmp_path / "model.swarm"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return [place(found) for found in pipeline.check([path]).report]

    return check_text


@pytest.mark.parametrize(
    "text", ["", " \n\t\n\n", "// nothing\n", "/* nothing */", "package a.b\n"]
)
def test_nothing(check: Check, text: str) -> None:
    assert check(text) == [("empty-file", 1, 1)]


@pytest.mark.parametrize(
    ("content", "at"),
    [
        (bytes(range(256)), (0, 0)),
        (b"\x00\x01\x02", (0, 0)),
        (START.encode("utf-16"), (0, 0)),
        (START.encode("utf-16-be"), (0, 0)),
        (f"{START}// Größe\n".encode("latin-1"), (2, 6)),
        (b"\xef\xbb\xbf// \xff\n", (1, 4)),
        (b"event Start : std_msgs/Empty\r\n\xff", (2, 1)),
        (b"\xed\xa0\x80", (1, 1)),  # half of a surrogate pair
    ],
)
def test_other_encodings(check: Check, content: bytes, at: tuple[int, int]) -> None:
    assert check(content) == [("not-text", *at)]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_ends_of_lines(check: Check, end: str) -> None:
    text = f"{START}\n/// It is over.\nevent Stop std_msgs/Empty\nevent Halt : Empti\n"

    assert check(text.replace("\n", end)) == [("syntax-error", 4, 12), ("unresolved-name", 5, 14)]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_documentation_is_the_same_for_all_ends_of_lines(tmp_path: Path, end: str) -> None:
    path = tmp_path / "model.swarm"
    path.write_bytes(f"/// One.\n/// Two.\n{START}".replace("\n", end).encode())
    system = pipeline.check([path]).system

    assert system is not None
    assert [event.doc for event in system.events] == ["One.\nTwo."]


def test_a_byte_order_mark_has_no_column(check: Check) -> None:
    assert check(b"\xef\xbb\xbfevent Start std_msgs/Empty\n") == [("syntax-error", 1, 13)]


@pytest.mark.parametrize("character", ["\ufeff", "\u200b", "\u00a0", "\u2028", "\u202e"])
def test_characters_that_cannot_be_seen(check: Check, character: str) -> None:
    assert check(f"{START}event{character} Stop : std_msgs/Empty\n") == [("syntax-error", 2, 6)]


@pytest.mark.parametrize("character", ["\x01", "\x0c", "\x1b", "\x7f"])
def test_control_characters_stand_nowhere(check: Check, character: str) -> None:
    assert check(f"/// One{character}.\n{START}") == [("control-character", 1, 8)]
    assert ("control-character", 2, 6) in check(f"{START}event{character} Stop : std_msgs/Empty\n")


@pytest.mark.parametrize("character", ["§", "é", "🚁", "\\", "`", "$", "@", "~"])
def test_characters_that_mean_nothing(check: Check, character: str) -> None:
    assert check(f"{START}event {character}Stop : std_msgs/Empty\n") == [("syntax-error", 2, 7)]


def test_any_character_may_stand_in_comments_and_texts(check: Check) -> None:
    text = 'environment Field { world "\u200b§🚁" }\n'

    assert check(f"// \u200b§🚁\n{text}") == []


@soon
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("// " + "x" * LONG + f"\n{START}", []),
        ("/* " + "*" * LONG + f"*/\n{START}", []),
        ("/* " + "x" * LONG + f"\n{START}", [("unterminated-comment", 1, 1)]),
        ("/// " + "x" * LONG + f"\n{START}", []),
        ("event " + "X" * LONG + " : std_msgs/Empty\n", []),
        (START[:-1] + "x " * (LONG // 2), [("syntax-error", 1, 31)]),
        (START[:-1] + f' on "{"x" * LONG}"\n', []),
        (START[:-1] + f' on "{"x" * LONG}\n', [("unterminated-text", 1, 33)]),
        (START + '"' * LONG, [("syntax-error", 2, 1)]),
        (START + "(" * LONG, [("nested-too-deeply", 2, 65)]),
        (START + "}" * LONG, [("syntax-error", 2, 1)]),
        (START + "§" * LONG, [("syntax-error", 2, 1)]),
        (START + " " * LONG, []),
        (START + "\n" * LONG, []),
        ("member Uav { param x : int8 = " + "1" * LONG + " }", [("syntax-error", 1, 31)]),
        ("".join(f"event E{i} : a/B; " for i in range(LONG // 100)), []),
        ("member Uav { param x : int8 = 1" + " + 1" * (LONG // 200) + " }", None),
        ("member Uav { param x : bool = " + "not " * (LONG // 200) + "true }", None),
        ("member Uav { param x : int8 = y" + ".z" * (LONG // 100) + " }", None),
    ],
    ids=lambda value: value[:20] if isinstance(value, str) else "",
)
def test_very_long_lines(
    check: Check, text: str, expected: list[tuple[str, int, int]] | None
) -> None:
    expected = [("nested-too-deeply", 1, 31)] if expected is None else expected
    assert check(text) == expected


def nested_states(depth: int) -> str:
    inner = "".join(f"state S{i} {{ initial S{i + 1}; " for i in range(depth))
    return f"endless statemachine M {{ initial S0; {inner}state S{depth}{'}' * depth} }}"


@pytest.mark.parametrize("depth", [10, 63])
def test_nesting_that_is_allowed(check: Check, depth: int) -> None:
    parentheses = f"member Uav {{ param x : int8 = {'(' * depth}1{')' * depth} }}"

    assert check(nested_states(depth)) == []
    assert check(parentheses) == []


@pytest.mark.parametrize(
    "text",
    [
        "statemachine M " + "{ state S " * 1000,
        nested_states(1000),
        f"member Uav {{ param x : int8 = {'(' * 1000}1{')' * 1000} }}",
        "member Uav { param x : int8 = " + "abs(" * 1000,
        "member Uav { a : A" + "[" * 1000 + "]" * 1000 + " }",
    ],
    ids=["open braces", "states", "parentheses", "calls", "square brackets"],
)
def test_nesting_without_end(check: Check, text: str) -> None:
    assert [name for name, _, _ in check(text)] == ["nested-too-deeply"]


def test_a_name_of_ten_thousand_characters(check: Check) -> None:
    name = "X" * 10_000

    assert check(f"event {name} : std_msgs/Empty\n") == []
    assert check(f"event Start : {name}\n") == [("unresolved-name", 1, 15)]


# ---- files


def names(paths: Iterable[Path]) -> list[tuple[str, int, int]]:
    return [place(found) for found in pipeline.check(list(paths)).report]


def test_a_missing_file(tmp_path: Path) -> None:
    assert names([tmp_path / "no.swarm"]) == [("file-not-found", 0, 0)]


def test_an_empty_folder(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("no model")

    assert names([tmp_path]) == [("nothing-to-compile", 0, 0)]


def test_a_folder_called_like_a_file(tmp_path: Path) -> None:
    (tmp_path / "model.swarm").mkdir()
    (tmp_path / "model.swarm" / "inside.swarm").write_text(START)

    assert names([tmp_path]) == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root can read every file")
def test_a_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "model.swarm"
    path.write_text(START)
    path.chmod(0)

    assert names([path]) == [("unreadable-file", 0, 0)]


def test_a_file_that_the_system_cannot_open(tmp_path: Path) -> None:
    loop = tmp_path / "loop.swarm"
    loop.symlink_to(loop)
    main = tmp_path / "main.swarm"
    main.write_text(f'import "loop.swarm"\nimport "{"x" * 5000}.swarm"\n{START}')

    assert names([loop]) == [("unreadable-file", 0, 0)]
    assert names([main]) == [("unreadable-file", 1, 8), ("unreadable-file", 2, 8)]


@pytest.mark.parametrize(
    ("command", "name", "way"),
    [
        ("check", "swarm.toml", "found without being named"),
        ("simulate", "mission.toml", "`swarmc simulate --scenario FILE`"),
        ("simulate", "uav_1.jsonl", "`--replay FILE`"),
        ("check", "events.json", "`--events FILE`"),
        ("build", "robot.xml", "`swarmc import`"),
        ("fmt", "robot.scxml", "`swarmc import`"),
    ],
)
def test_a_file_that_is_no_model_by_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str, name: str, way: str
) -> None:
    path = tmp_path / name
    path.write_text("[functions]\ngo = 1\n" if name == "mission.toml" else "", encoding="utf-8")

    assert run([command, str(path)]) == 1

    said = "".join(capsys.readouterr())
    assert said.count("error[") == 1
    assert f"error[SW0002]: `{path}` is a {path.suffix} file, not a model, *.swarm" in said
    assert way in " ".join(said.split())


def test_an_import_of_a_folder(check: Check) -> None:
    assert check(f'import ""\nimport "."\n{START}') == [("not-a-file", 1, 8)]


# ---- many


def chain(folder: Path, length: int, last: str) -> Path:
    """Files that import each other in a row; `last` is the head of the last one."""
    for number in range(length):
        head = f'import "f{number + 1}.swarm"\n' if number + 1 < length else last
        (folder / f"f{number}.swarm").write_text(f"{head}event E{number} : std_msgs/Empty\n")
    return folder / "f0.swarm"


def test_a_long_chain_of_imports(tmp_path: Path) -> None:
    result = pipeline.check([chain(tmp_path, 500, "")])

    assert result.files == 500
    assert list(result.report) == []


def test_a_long_circle_of_imports(tmp_path: Path) -> None:
    assert names([chain(tmp_path, 500, 'import "f0.swarm"\n')]) == [("import-cycle", 1, 8)]


def reusing(length: int, last: str) -> str:
    """Machines that reuse each other in a row; `last` is the only state of the last one."""
    return "".join(
        f"statemachine M{i} {{ initial S; state S "
        + (f"= M{i + 1} {{ on done -> F }}" if i + 1 < length else last)
        + " final F }\n"
        for i in range(length)
    )


def test_a_chain_of_submachines(check: Check) -> None:
    assert check(reusing(60, "{ after 1 s -> F }")) == []
    assert check(reusing(500, "{ after 1 s -> F }")) == [("nested-too-deeply", 436, 42)]
    assert check(reusing(500, "= M0 { on done -> F }")) == [("submachine-cycle", 500, 42)]


def test_a_chain_of_types(check: Check) -> None:
    aliases = "".join(f"type T{i} = T{i + 1}\n" for i in range(500))
    structs = "".join(f"struct S{i} {{ next : S{i + 1} }}\n" for i in range(500))

    assert check(f"{aliases}type T500 = float64\n") == []
    assert check(f"{aliases}type T500 = T0\n") == [("type-cycle", 2, 11)]
    assert check(f"{structs}struct S500 {{ }}\n") == []
    assert check(f"{structs}struct S500 {{ next : S0 }}\n") == [("type-cycle", 501, 22)]


@soon
def test_a_machine_of_two_thousand_states(check: Check) -> None:
    states = "".join(f"state S{i} {{ on Start -> S{i + 1} }}\n" for i in range(2000))
    text = f"{START}statemachine M {{\ninitial S0\n{states}final S2000\n}}\n"

    assert check(text) == []
    assert check(text.replace("final S2000", "final End")) == [("unresolved-name", 2003, 27)]


def test_two_thousand_mistakes(check: Check) -> None:
    found = check("".join(f"event E{line:04} std_msgs/Empty\n" for line in range(2000)))

    assert found == [("syntax-error", line, 13) for line in range(1, 2001)]
