"""States that are wrapped or dissolved do what they did, in examples and in models by chance."""

import random
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError, rename, replaced
from swarmdsl.ir import System
from swarmdsl.ir.dump import dump
from swarmdsl.lowering import lower
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import State, StateMachine, walk
from swarmdsl.syntax.formatter import format_source
from swarmdsl.tools.refactor.extract_machine import extract_machine, why_not_extract
from swarmdsl.tools.refactor.inline_state import inline_state, why_not_inline
from swarmdsl.tools.refactor.selected_states import Selection, selected_states
from swarmdsl.tools.refactor.wrap_states import new_name, wrap_states

from .traces import behaviour, behaviours, check_text, comments

ROOT = Path(__file__).resolve().parents[2]
MODELS = sorted((ROOT / "examples").glob("*/*.swarm"))
MODELS += sorted((ROOT / "tests" / "golden").glob("*/model.swarm"))
MODELS = [each for each in MODELS if "statemachine" in each.read_text(encoding="utf-8")]


@cache
def loaded(path: Path) -> tuple[Workspace, File, System]:
    """Return a model, for all tests that look at it."""
    workspace = Workspace([path])
    file = workspace.file(path)
    if workspace.report.has_errors or file is None:
        pytest.skip("it is wrong by itself")
    return workspace, file, lower(workspace.project)


def selections(file: File, dice: random.Random) -> Iterator[Selection]:
    """Two selections of states beside each other in machines of a file."""
    machines = [each for each in file.model.declarations if isinstance(each, StateMachine)]
    states = [(one, each) for one in machines for each in walk(one) if isinstance(each, State)]
    for machine, state in dice.sample(states, min(2, len(states))):
        span = state.span.absolute
        end = dice.choice([span.start, span.end + 200, span.end + 2000])
        within = Span(file.source, span.start, min(end, machine.span.absolute.end))
        found = selected_states(file, within)
        if found is not None:
            yield found


@pytest.mark.parametrize("path", MODELS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_wrapped_and_dissolved_again(path: Path) -> None:
    workspace, file, before = loaded(path)
    for selection in selections(file, random.Random(path.as_posix()[-30:])):
        try:
            texts = wrap_states(workspace, file, selection)
        except RefusedError:
            continue
        check_text(texts[path], file.source.text)
        name, count = str(selection.machine.name), len(selection.states)
        gone = new_name(selection)
        with workspace.overriding(texts):
            after = lower(workspace.project)
            behaviour(before, after, name, gone)
            here, wrapped = group(workspace, path, gone)
            inner = [each for each in walk(wrapped.states[0]) if isinstance(each, State)]
            assert len(inner) > count - 1
            back = inline_state(workspace, here, wrapped)
            check_text(back[path], file.source.text)
            with workspace.overriding(back):
                assert dump(lower(workspace.project)) == dump(before)
            if why_not_extract(wrapped) is None:
                with workspace.overriding(extract_machine(workspace, here, wrapped)):
                    behaviour(before, lower(workspace.project), name, gone)


def group(workspace: Workspace, path: Path, name: str) -> tuple[File, Selection]:
    file = workspace.file(path)
    assert file is not None
    at = file.source.text.index(f"state {name} {{")
    found = selected_states(file, Span(file.source, at, at))
    assert found is not None
    return file, found


@pytest.mark.parametrize("path", MODELS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_dissolved(path: Path) -> None:
    workspace, file, before = loaded(path)
    left = 2
    for machine in file.model.declarations:
        for state in walk(machine) if isinstance(machine, StateMachine) else ():
            if not isinstance(state, State) or not left:
                continue
            at = state.span.absolute.start
            selection = selected_states(file, Span(file.source, at, at))
            if selection is None or why_not_inline(selection) is not None:
                continue
            try:
                texts = inline_state(workspace, file, selection)
            except RefusedError:
                continue
            left -= 1
            assert format_source(Source("", texts[path]), Diagnostics()) == texts[path]
            assert not comments(file.source.text) - comments(texts[path])
            with workspace.overriding(texts):
                behaviour(before, lower(workspace.project), str(machine.name), str(state.name))


def machine_in(text: str, name: str) -> str:
    """Return a machine of a dump, without the names of submachines, which are expanded."""
    found = re.search(rf"^    StateMachine {name}\n(?:     .*\n)*", text, re.MULTILINE)
    assert found is not None
    return re.sub(r"^ +submachine: .*\n", "", found[0], flags=re.MULTILINE)


@pytest.mark.parametrize("path", MODELS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_machine_extracted(path: Path) -> None:
    workspace, file, before = loaded(path)
    left = 2
    for machine in file.model.declarations:
        for state in walk(machine) if isinstance(machine, StateMachine) else ():
            at = state.span.absolute.start
            selection = selected_states(file, Span(file.source, at, at))
            if not isinstance(state, State) or not left or selection is None:
                continue
            if selection.composite is None:
                continue
            if why_not_extract(selection) is not None:
                continue
            texts = extract_machine(workspace, file, selection)
            left -= 1
            assert format_source(Source("", texts[path]), Diagnostics()) == texts[path]
            assert comments(file.source.text) == comments(texts[path])
            with workspace.overriding(texts):
                after = lower(workspace.project)
            name = str(machine.name)
            if "on done.To" not in texts[path]:
                assert machine_in(dump(after), name) == machine_in(dump(before), name)
            else:
                behaviour(before, after, name, "")


MODEL = """\
package a

swarm event Go : std_msgs/Empty
swarm event Stop : std_msgs/Empty

statemachine M {
  initial A
  // about A
  state A { on Go -> B }  // after A
  /// Documentation of B.
  state B { on Go -> C }
  state C {
    history Back -> D
    initial D
    state D { on Go -> E }
    state E { on Stop -> A }
    on Stop -> A
  }
  /// Ends.
  state F {
    initial G

    state G { on Go -> H }
    final H

    on done -> Z
  }
  /// Waits.
  state W {  // head
    /// At first.
    initial X

    state X { on Go -> Y }
    state Y

    // on a stop
    on Stop -> A
  }
  final Z
}

member R { behavior M }

property P of M : in W.X leads to in A within 5 s
"""


@pytest.fixture
def model(tmp_path: Path) -> Workspace:
    (tmp_path / "model.swarm").write_text(MODEL, encoding="utf-8")
    return Workspace([tmp_path])


def chosen(model: Workspace, first: str, last: str = "") -> tuple[File, Selection]:
    [file] = [each for each in model.project.files if not each.library]
    start = file.source.text.index(first)
    end = file.source.text.index(last, start) + len(last) if last else start
    found = selected_states(file, Span(file.source, start, end))
    assert found is not None
    return file, found


def test_wrapped_text(model: Workspace) -> None:
    [text] = wrap_states(model, *chosen(model, "state A", "state B")).values()
    assert (
        """\
  initial AGroup
  state AGroup {
    initial A

    // about A
    state A { on Go -> B }  // after A

    /// Documentation of B.
    state B { on Go -> C }
  }

  state C {
    history Back -> D
    initial D
    state D { on Go -> E }
    state E { on Stop -> AGroup.A }
    on Stop -> AGroup.A
  }
"""
        in text
    )
    assert "in W.X leads to in AGroup.A within" in text


def test_state_is_renamed_in_paths_of_properties(model: Workspace) -> None:
    file, selection = chosen(model, "state W")
    spans = rename(model, file, selection.states[0].name.span.absolute.start, "Waiting")
    assert len(spans) == 2
    [text] = replaced(spans, "Waiting").values()
    assert "property P of M : in Waiting.X leads" in text


def test_extracted_text(model: Workspace) -> None:
    [text] = extract_machine(model, *chosen(model, "state F")).values()
    assert "statemachine MF {\n  initial G\n\n  state G { on Go -> H }\n  final H\n}\n" in text
    assert "  /// Ends.\n  state F = MF {\n    on done -> Z\n  }\n" in text


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (
            "on Stop -> Y",
            "defer Go; on Stop -> A",
            "`A` would be entered after events that `W` defers",
        ),
        ("[1 == 1]", "[in(A)]", "`A` is named in `W`, and not inside"),
        ("on Go -> C }", "on Go -> W.Y }", "`W.Y` is inside, and named outside of `W`"),
        (
            "initial A",
            "var n : int32 = 0; initial A",
            (
                "`n` is set in `W`, and a machine can only read variables around it:"
                " set `n` in transitions that stay"
            ),
        ),
        ("// on a stop", "do halt", "`W` has an activity"),
        (
            "// on a stop",
            "var k : int32",
            "the variable `k` of `W` starts with zero on each entry: give it an initial value",
        ),
        (
            "// on a stop",
            "var k : int32 = 0; exit / k = 1",
            "the variable `k` of `W` is used outside of its states",
        ),
        ("in W.X", "in W", ""),
    ],
)
def test_not_extracted(tmp_path: Path, old: str, new: str, reason: str) -> None:
    text = MODEL.replace("state Y\n", "state Y { on Stop [1 == 1] -> Y; on Stop -> Y }\n")
    if "n : int32" in new:
        text = text.replace("[1 == 1]", "/ n = 1")
    text = text.replace(old, new)
    text += 'function halt : swarm { service "halt" : std_srvs/Trigger }\n'
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    model = Workspace([tmp_path])
    place = chosen(model, "state W")
    assert why_not_extract(place[1]) == (reason or None)
    if reason:
        with pytest.raises(RefusedError, match=re.escape(reason)):
            extract_machine(model, *place)


def test_variables_are_passed_or_moved(tmp_path: Path) -> None:
    text = MODEL.replace("initial A", "var n : int32 = 0; initial W").replace(
        "state A { on Go -> B }", "state A { on Go / n = n + 1 -> W }"
    )
    text = text.replace("/// At first.", "/// Kept.\nvar k : int32 = 1\n/// At first.").replace(
        "state Y\n", "state Y { on Go [n > k] / k = k + n -> X; on Go [k < 5] -> X }\n"
    )
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    model = Workspace([tmp_path])
    before = lower(model.project)
    texts = extract_machine(model, *chosen(model, "state W"))
    [text] = texts.values()
    assert (
        "statemachine MW {\n  param n : int32\n  // head\n  /// Kept.\n  var k : int32 = 1\n"
        in text
    )
    assert "  state W = MW(n = n) {" in text
    with model.overriding(texts):
        assert behaviours(before, lower(model.project), "M", "") > 10


@pytest.mark.parametrize(
    ("names", "new"),
    [
        ("SearchLeft SearchRight", "Search"),
        ("Search SearchRight", "SearchGroup"),
        ("UavUp UAVDown", "UavUpGroup"),
        ("go_out go_back", "go"),
        ("wait_here look", "wait_here_group"),
        ("S1 S2", "S"),
    ],
)
def test_new_states_are_named_after_their_content(tmp_path: Path, names: str, new: str) -> None:
    first, last = names.split()
    text = f"  initial {first}\n  state {first} {{ on Go -> {last} }}\n  state {last}\n"
    made = changed(tmp_path, wrap_states, text, f"state {first}", f"state {last}")
    assert f"  initial {new}\n  state {new} {{\n" in made


def test_tabs_and_words_of_other_languages_stay(tmp_path: Path) -> None:
    text = (
        COMMON.replace("  ", "\t")
        .replace("// a", "/// Über den Wolken ☁ 🚁")
        .replace("// b", "// 終")
    )
    for change in (wrap_states, extract_machine):
        made = changed(tmp_path, change, text, "state A", "state C")
        assert "  /// Über den Wolken ☁ 🚁\n" in made
        assert "// 終\n" in made
        assert "\t" not in made


def test_transitions_that_leave_end_the_machine(tmp_path: Path) -> None:
    text = MODEL.replace("state Y\n", "state Y { on Stop -> A; on Go -> Z }\n")
    text = text.replace("initial A", "initial W").replace(
        "state A { on Go -> B }", "state A { on Go -> W }"
    )
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    model = Workspace([tmp_path])
    before = lower(model.project)
    texts = extract_machine(model, *chosen(model, "state W"))
    [text] = texts.values()
    assert "  state Y {\n    on Stop -> ToA\n    on Go   -> ToZ\n  }\n" in text
    assert "  final ToA\n  final ToZ\n}\n" in text
    assert "    on done.ToA -> A\n    on done.ToZ -> Z\n" in text
    with model.overriding(texts):
        assert behaviours(before, lower(model.project), "M", "") > 10


def test_dissolved_text(model: Workspace) -> None:
    [text] = inline_state(model, *chosen(model, "state W")).values()
    assert (
        """\
  // Waits.

  // head
  // At first.

  state X {
    on Go   -> Y
    // on a stop
    on Stop -> A
  }
  state Y {
    // on a stop
    on Stop -> A
  }

  final Z
"""
        in text
    )
    assert "in X leads to in A within" in text


@pytest.mark.parametrize(
    ("change", "first", "last", "reason"),
    [
        (wrap_states, "state D", "", "the history `Back` would restore the new state"),
        (wrap_states, "final Z", "", "the final state `Z` ends what it is in"),
        (wrap_states, "history Back", "", "the history `Back` restores what it is in"),
        (inline_state, "state A", "", "it is no composite state"),
        (inline_state, "state C", "", "`C` has a history"),
        (inline_state, "state F", "", "`F` has a final state"),
    ],
)
def test_refused(model: Workspace, change, first: str, last: str, reason: str) -> None:
    with pytest.raises(RefusedError, match=reason):
        change(model, *chosen(model, first, last))


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("// on a stop", "after 5 s -> A", "a transition of `W` is on more than events"),
        ("// on a stop", "exit / send Go", "`W` has effects at its exit"),
        ("// on a stop", "var n : int32 = 0", "`W` has variables"),
        ("state Y", "state A", "there is another state `A` around `W`"),
        ("-> B }", "[in(W)] -> B }", "an expression is about `W`"),
        ("in W.X", "in W", "`W` is named outside of its machine"),
        ("  state X {", "  state X { defer Stop", "states in `W` defer events"),
    ],
)
def test_not_dissolved(tmp_path: Path, old: str, new: str, reason: str) -> None:
    text = MODEL.replace(old, new)
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    model = Workspace([tmp_path])
    with pytest.raises(RefusedError, match=reason):
        inline_state(model, *chosen(model, "state W"))


def test_machine_whose_name_is_taken_gets_a_number(tmp_path: Path) -> None:
    text = MODEL.replace("member R", "member MF")
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    model = Workspace([tmp_path])
    [changed] = extract_machine(model, *chosen(model, "state F")).values()
    assert "state F = MF2" in changed
    assert "statemachine MF2 {" in changed


def changed(tmp_path: Path, change, text: str, first: str, last: str = "") -> str:
    """Return a machine after a change of what is selected."""
    head = MODEL[: MODEL.index("statemachine")]
    path = tmp_path / "model.swarm"
    path.write_bytes(f"{head}statemachine M {{\n{text}\n}}\n".encode())
    [made] = change((model := Workspace([tmp_path])), *chosen(model, first, last)).values()
    return made[made.index("statemachine") :]


COMMON = """\
  initial A
  // a
  state A { on Go -> B; on Stop -> Z }  // b
  state B {
    on Go -> C
    // c
    on Stop -> Z  // d
  }
  state C { on Stop -> Z }
  final Z
"""


def test_common_transitions_are_kept_once(tmp_path: Path) -> None:
    assert (
        changed(tmp_path, wrap_states, COMMON, "// a", "state C")
        == """\
statemachine M {
  initial AGroup
  state AGroup {
    initial A

    // a
    state A { on Go -> B }  // b

    state B {
      on Go -> C
    }

    state C

    // c
    // d
    on Stop -> Z
  }

  final Z
}
"""
    )


def test_states_are_extracted_into_a_machine(tmp_path: Path) -> None:
    text = COMMON.replace("on Go -> C", "on Go -> D").replace("final Z", "state D\n  final Z")
    made = changed(tmp_path, extract_machine, text.replace("\n", "\r\n"), "-> B; on", "state C {")
    assert "  initial AGroup\n  state AGroup = MAGroup {\n    on done.ToD -> D\n    // c\n" in made
    assert "    on Go -> ToD\n" in made
    assert made.startswith("statemachine MAGroup {\n  initial A\n\n  // a\n")


AROUND = """\
  initial P
  state P {
    initial S
    state S {
      initial A
      state A { on Go -> B }
      state B { on Stop -> A }
      on Go, Stop -> A
      on Stop -> Z
    }
    on Go -> Z
  }
  final Z
"""


def test_transitions_are_lifted_to_the_state_around(tmp_path: Path) -> None:
    made = changed(tmp_path, inline_state, AROUND, "state S")
    assert "    state B { on Stop -> A }\n" in made
    assert re.search(r"internal on Go, Stop +-> A\n +on Stop +-> Z\n +on Go +-> Z\n", made)


def test_copies_are_as_few_as_possible(tmp_path: Path) -> None:
    text = AROUND.replace("state P {", "state P {\nstate Q { on Go -> S }")
    made = changed(tmp_path, inline_state, text, "state S")
    assert re.sub(r"\s+", " ", made[made.index("state A") : made.index("final Z")]) == (
        "state A { on Go -> B on Stop -> A on Stop -> Z }"
        " state B { on Stop -> A on Go -> A } on Go -> Z } "
    )


@pytest.mark.parametrize(
    ("text", "first", "last", "names"),
    [
        (COMMON, "// a", "// a", ""),
        (COMMON, "on Go -> C", "on Go", "B"),
        (COMMON, "on Go -> B", "state B", "AB"),
        (AROUND, "state A", "state B", "AB"),
        (AROUND, "on Stop -> Z", "on Stop", "S"),
        (COMMON + "}\nstatemachine N { initial A; state A", "state C", "state A", ""),
        (COMMON, "  initial A", "final Z", "ABCZ"),
    ],
)
def test_what_a_selection_touches(tmp_path: Path, text, first, last, names) -> None:
    head = MODEL[: MODEL.index("statemachine")]
    (tmp_path / "model.swarm").write_text(f"{head}statemachine M {{\n{text}\n}}\n", "utf-8")
    [file] = [each for each in Workspace([tmp_path]).project.files if not each.library]
    start = file.source.text.index(first)
    end = file.source.text.index(last, start) + len(last)
    found = selected_states(file, Span(file.source, start, end))
    assert "".join(str(each.name) for each in (found.states if found else ())) == names


def test_machine_of_states_that_are_entered_twice(tmp_path: Path) -> None:
    text = COMMON.replace("final Z", "state D { on Go -> B }\n  final Z")
    with pytest.raises(RefusedError, match="`B` is inside, and named outside of `A` and"):
        changed(tmp_path, extract_machine, text, "state A", "state C")
