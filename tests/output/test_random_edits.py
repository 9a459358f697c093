"""Models and files change at random, again and again: no line of a user is ever lost.

The model is one of functions and components as target `skeleton` makes packages of them. Between
two builds some of its elements come, go, get another name or another interface, and a user
writes lines of their own into any file of the output. Builds are killed, too.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

from hypothesis import given, settings
from hypothesis import strategies as st

from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.output import WriteOptions
from swarmdsl.output.changes import PARKED

NAMES = ("takeoff", "land", "rise_up", "Camera")
TYPES = ("float64", "int32")
MINE = "line of mine"
HELP = (".swarmc-new", ".swarmc-changes")

ELEMENTS = st.dictionaries(
    st.sampled_from(NAMES), st.tuples(st.sampled_from(TYPES), st.booleans()), min_size=1
)
# What a user does to a file: to which, and where in it, both as parts of a thousand.
EDIT = st.tuples(
    st.integers(0, 999), st.integers(0, 999), st.sampled_from(["insert", "replace", "windows"])
)
# The elements, the edits after the build, whether it renames, and after how many of its changes
# of files it is killed.
KILL = st.none() | st.integers(0, 60)
STEP = st.tuples(ELEMENTS, st.lists(EDIT, max_size=5), st.booleans(), KILL)

Elements = dict[str, tuple[str, bool]]
Edit = tuple[int, int, str]


def model(elements: Elements) -> str:
    """The text of a model with these elements, with a type and an extra param each."""
    text = "package lab\n"
    for name, (type_, extra) in elements.items():
        more = "  param more : float64 = 1.0\n" if extra else ""
        if name[0].isupper():
            text += f"sensor {name} {{\n  out image : {type_}\n{more}}}\n"
        else:
            action = f'  action "cmd/{name}" : Work\n  in "height" : std_msgs/Float64\n'
            text += f"function {name} : abstraction {{\n{action}  param limit : {type_}\n{more}}}\n"
    return text + "action Work { goal { now : bool } }\n"


def files(out: Path) -> list[Path]:
    """All files but the lists of swarmc, and what an interrupted build leaves."""
    found = (path for path in sorted(out.rglob("*")) if path.is_file())
    return [path for path in found if not path.name.startswith((".swarmdsl", ".swarmc-"))]


def change_file(out: Path, edit: Edit, number: int) -> None:
    """A user writes a line into a file, or in place of one that is not theirs, marks as well."""
    which, where, how = edit
    # What is beside a file to help with it, the user reads and deletes.
    own = [path for path in files(out) if not path.name.endswith(HELP)]
    path = own[which * len(own) // 1000]
    content = path.read_bytes()
    end = b"\r\n" if b"\r\n" in content or how == "windows" else b"\n"
    lines = content.splitlines()
    at = where * len(lines) // 1000
    if how == "replace" and at < len(lines) and MINE.encode() not in lines[at]:
        del lines[at]
    lines.insert(at, f"# {MINE} {number}.".encode())
    path.write_bytes(end.join([*lines, b""]))


def mine(out: Path) -> set[str]:
    """The lines of the user in all files, but for copies."""
    found = set()
    for path in files(out):
        if path.name.endswith(HELP):
            continue
        text = path.read_text(encoding="utf-8")
        found |= {line for line in text.splitlines() if MINE in line}
    return found


def build(out: Path, text: str, **how: object) -> pipeline.Result:
    source = out.parent / "lab.swarm"
    source.write_text(text, encoding="utf-8")
    request = Request("skeleton", {"language": "cpp"})
    return pipeline.build([source], [request], out, options=WriteOptions(**how))  # type: ignore[arg-type]


def renames(before: Elements, now: Elements) -> tuple[tuple[str, str], ...]:
    """One element that is gone, as if it were one that is new."""
    gone = [name for name in before if name not in now]
    new = [name for name in now if name not in before]
    return tuple(zip(gone[:1], new[:1], strict=False))


def stamps(out: Path) -> dict[Path, int]:
    return {path: path.stat().st_mtime_ns for path in out.rglob("*") if path.is_file()}


class Killed(BaseException):
    """Raised at each change of a file from then on, so that nothing is cleaned up either."""


@contextmanager
def killed(after: int | None) -> Iterator[None]:
    """Let what is done inside end before one of its changes of files; with None, let it be."""
    left = after

    def counted(real: Callable[..., object]) -> Callable[..., object]:
        def call(*arguments: object, **named: object) -> object:
            nonlocal left
            if left is not None:
                left -= 1
                if left < 0:
                    raise Killed
            return real(*arguments, **named)

        return call

    with ExitStack() as patches:
        for owner, name in (
            (os, "open"),
            (os, "replace"),
            (Path, "unlink"),
            (Path, "rmdir"),
            (Path, "mkdir"),
            (Path, "write_bytes"),
        ):
            patches.enter_context(patch.object(owner, name, counted(getattr(owner, name))))
        with suppress(Killed):
            yield


@settings(max_examples=15)
@given(st.lists(STEP, min_size=2, max_size=4))
def test_no_line_of_the_user_is_lost(
    steps: list[tuple[Elements, list[Edit], bool, int | None]],
) -> None:
    with TemporaryDirectory() as folder:
        out = Path(folder, "out")
        before: Elements = {}
        number = 0
        for elements, edits, renamed, kill in steps:
            there = mine(out)
            how = {"renames": renames(before, elements)} if renamed else {}
            text = model(elements)
            with killed(kill):
                build(out, text, **how)
            # Two files of the user may be one then: nothing is done, until they are asked.
            assert mine(out) == there
            build(out, text)
            assert mine(out) == there

            done = stamps(out)
            again = build(out, text)
            assert again.written is not None
            assert again.written.changes == ()
            assert stamps(out) == done
            assert not list(out.rglob(".swarmc-*"))

            for edit in edits:
                number += 1
                change_file(out, edit, number)
            before = elements


def test_the_test_sees_all_kinds_of_changes() -> None:
    """Each random kind of change above occurs here for certain."""
    one, other = {"takeoff": ("float64", False)}, {"land": ("float64", False)}
    with TemporaryDirectory() as folder:
        out = Path(folder, "out")
        build(out, model(one))
        for place in range(0, 1000, 50):
            change_file(out, (place, 500, "insert"), place)
        build(out, model(other))
        assert (out / PARKED).exists()
        assert len(mine(out)) == 20
        build(out, model(other), renames=(("takeoff", "land"),))
        assert not (out / PARKED).exists()
        assert len(mine(out)) == 20
