"""`swarmc add`: what is new comes where it belongs, and all else stays as it is."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from swarmdsl.driver import pipeline
from swarmdsl.syntax.ast import Member, Swarm
from swarmdsl.tools.refactor import element_text
from swarmdsl.tools.refactor.add import FindInsertion, add, declaration, part_of, state

MODEL = """/// A swarm of robots.
package yard

import cpswarm.events.*

event Bump : std_msgs/Bool   // of the bumper

function drive : abstraction { action "drive" : yard_msgs/Drive }

sensor Bumper { out hit : std_msgs/Bool }   // in front

member Cart {
  behavior Going
  bumper : Bumper   // of rubber
}

statemachine Going {
  initial Idle   // not yet

  state Idle { on MissionStart -> Busy }

  state Busy {
    initial Drive
    state Drive { do drive;   on succeeded, aborted -> Drive }   // for ever
    on Bump [event.data] -> Over
    on MissionAbort      -> Over
  }

  parallel state Over {
    region Left { initial Slow; state Slow { after 1 s -> Gone }  final Gone }
    region Right {
      initial Slow
      state Slow { after 2 s -> Gone }
      final Gone   // too
    }
    on done -> Done
  }

  // The end.
  final Done
}

swarm Yard {
  cart : Cart[3]
}
"""


@pytest.fixture
def model(folder: Path) -> Path:
    path = folder / "yard.swarm"
    path.write_text(MODEL, encoding="utf-8")
    return path


CASES: dict[str, tuple[list[str], str, str]] = {
    "operator event": (
        ["event", "Dark", "std_msgs/Empty", "--operator"],
        "event Bump : std_msgs/Bool   // of the bumper",
        """

swarm operator event Dark : std_msgs/Empty""",
    ),
    "event": (
        ["event", "Dark", "std_msgs/Empty", "--doc", "Night falls."],
        "event Bump : std_msgs/Bool   // of the bumper",
        """

/// Night falls.
event Dark : std_msgs/Empty""",
    ),
    "function": (
        ["function", "honk", "--service", "horn:std_srvs/Empty", "--param", "n:int32=2"],
        'function drive : abstraction { action "drive" : yard_msgs/Drive }',
        """

function honk : abstraction {
  service "horn" : std_srvs/Empty
  param n : int32 = 2
}""",
    ),
    "component": (
        [
            *("component", "Motor", "--kind", "actuator", "--in", "speed:float64@motor/speed"),
            *("--operation", "brake(in hard : bool)", "--doc", "Turns."),
        ],
        "sensor Bumper { out hit : std_msgs/Bool }   // in front",
        """

/// Turns.
actuator Motor {
  in speed : float64 on "motor/speed"
  operation brake(in hard : bool)
}""",
    ),
    "member": (
        ["member", "Truck", "--extends", "Cart", "--part", "rear:Bumper"],
        "  bumper : Bumper   // of rubber\n}",
        """

member Truck extends Cart {
  rear : Bumper
}""",
    ),
    "swarm": (
        ["swarm", "Pair", "--member", "Cart=2", "--member", "last:Cart"],
        "  cart : Cart[3]\n}",
        """

swarm Pair {
  cart : Cart[2]
  last : Cart
}""",
    ),
    "state": (
        ["state", "Going.Wait", "--after", "5 s -> Idle"],
        "    on done -> Done\n  }",
        """

  state Wait {
    after 5 s -> Idle
  }""",
    ),
    "state in a state": (
        ["state", "Going.Busy.Rest", "--on", "Bump / send MissionAbort -> Drive"],
        "    state Drive { do drive;   on succeeded, aborted -> Drive }   // for ever",
        """
    state Rest {
      on Bump / send MissionAbort -> Drive
    }""",
    ),
    "state that does something": (
        ["state", "Busy.Back", "--do", "drive", "--on", "succeeded, aborted -> Drive"],
        "    state Drive { do drive;   on succeeded, aborted -> Drive }   // for ever",
        """
    state Back {
      do drive
      on succeeded, aborted -> Drive
    }""",
    ),
    "state in a region": (
        ["state", "Over.Right.Fast", "--after", "1 s -> Gone"],
        "      state Slow { after 2 s -> Gone }",
        """
      state Fast {
        after 1 s -> Gone
      }""",
    ),
    "final state": (
        ["state", "Going.Broken", "--final"],
        "  // The end.\n  final Done",
        "\n  final Broken",
    ),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_what_is_new_comes_where_it_belongs(case: str, ends: str, swarmc, model) -> None:
    arguments, above, text = CASES[case]
    before = b"\xef\xbb\xbf" + MODEL.replace("\n", ends).encode()
    model.write_bytes(before)
    shown = swarmc("add", *arguments, "--dry-run")
    assert model.read_bytes() == before
    ran = swarmc("add", *arguments)
    wanted = MODEL.replace(above, above + text, 1).replace("\n", ends)

    assert (ran.code, ran.out) == (0, "yard.swarm\n"), ran.err
    assert model.read_bytes().decode("utf-8-sig") == wanted
    assert model.read_bytes().startswith(b"\xef\xbb\xbf")
    added = [line[1:].rstrip("\r\n") for line in shown.out.split("\n") if line[:1] == "+"]
    assert sorted(added[1:]) == sorted(text.split("\n")[1:])
    assert swarmc("check").code == 0


def test_a_part_and_a_role_are_added_too(swarmc, model) -> None:
    assert swarmc("fmt").code == 0
    assert swarmc("add", "component", "Horn", "--kind", "actuator", "--to", "Cart.horn").code == 0
    assert swarmc("add", "member", "Van", "--extends", "Cart", "--to", "Yard=1..2").code == 0
    text = model.read_text()

    assert "  bumper : Bumper  // of rubber\n  horn   : Horn\n}" in text
    assert "  cart : Cart[3]\n  van  : Van[1..2]\n}" in text
    assert swarmc("check").out == ""


def test_a_way_leads_to_a_new_state(swarmc, model) -> None:
    assert swarmc("fmt").code == 0
    before = model.read_text()
    ways = ["--from", "Busy: MissionStart", "--from", "Idle: after 5 s", "--final"]
    ran = swarmc("add", "state", "Going.Late", *ways)
    text = model.read_text()

    assert (ran.code, ran.err) == (0, "")
    assert "    on MissionAbort -> Over\n    on MissionStart -> Late\n" in text
    assert "on MissionStart -> Busy\n    after 5 s -> Late" in text
    assert set(before.split()) <= set(text.split())
    assert swarmc("check", "--deny", "warnings").out == ""

    assert swarmc("add", "state", "Going.X", "--final", "--from", "Idel: Bump").code == 1
    assert swarmc("add", "state", "Going.X", "--final", "--from", "Idle Bump").code == 2
    assert model.read_text() == text


def test_a_behaviour_is_made_where_there_is_none(swarmc, model) -> None:
    assert swarmc("add", "component", "Arm", "--kind", "virtual", "--behavior", "Reach").code == 0
    assert swarmc("add", "member", "Van", "--behavior", "Going").code == 0
    text = model.read_text()

    assert "/// The behaviour of `Arm`.\nstatemachine Reach {\n  initial Ready" in text
    assert "virtual Arm {\n  behavior Reach\n}" in text
    assert text.count("statemachine") == 2
    assert swarmc("check", "--deny", "warnings").out == ""


def test_each_kind_goes_to_the_file_that_has_most_of_it(swarmc, folder) -> None:
    (folder / "events.swarm").write_text("package a.events\nevent One : std_msgs/Empty\n")
    (folder / "robots.swarm").write_text('package a\nimport "events.swarm"\nmember Robot { }\n')
    assert swarmc("add", "event", "Two", "std_msgs/Empty").out == "events.swarm\n"
    assert swarmc("add", "member", "Other").out == "robots.swarm\n"
    assert swarmc("add", "event", "X", "std_msgs/Empty", "--file", "robots.swarm").code == 0
    assert "event X" in (folder / "robots.swarm").read_text()
    assert swarmc("check").code == 0


def test_a_file_without_declarations(swarmc, folder) -> None:
    (folder / "main.swarm").write_text('package a\n\nimport "empty.swarm"\n\nmember Robot { }\n')
    (folder / "empty.swarm").write_text("/// Nothing yet.\npackage a.more\n")
    assert swarmc("add", "member", "X", "--file", "empty.swarm").code == 0
    assert (folder / "empty.swarm").read_text() == (
        "/// Nothing yet.\npackage a.more\n\nmember X { }\n"
    )


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["component", "Bumper"], "SW1507", "choose another name"),
        (["member", "Truck", "--part", "b:Bumpr"], "SW0202", "did you mean `Bumper`?"),
        (["event", "on", "std_msgs/Empty"], "SW0103", "choose another name"),
        (["event", "E", "std_msgs/Empty; event F : std_msgs/Empty"], "SW1507", "more than one"),
        (["function", "f", "--action", "f:std_srvs/Empty"], "SW0604", "service"),
        (["swarm", "S", "--member", "Cart=0"], "SW0301", "write `[3]`"),
        (["state", "Goin.X"], "SW1503", "did you mean `Going`?"),
        (["state", "Yrd.X"], "SW1503", "such as a state machine `Going`"),
        (["state", "Cart.X"], "SW1507", "a member cannot contain it"),
        (["state", "Slow.X"], "SW1504", "qualify it, such as"),
        (["state", "Going.Idle"], "SW1507", "already"),
        (["state", "Done.X"], "SW1507", "a final state cannot contain it"),
        (["state", "Drive.X"], "SW0511", "Drive"),
        (["state", "Going.X", "--do", "drive"], "SW0505", "add `on succeeded"),
        (["state", "Going.X", "--on", "Bump -> Nowhere"], "SW0202", "Nowhere"),
        (["state", "Going.X", "--on", "Bump -> Done } state Y {"], "SW1507", "more than one"),
        (["component", "X", "--to", "Yard"], "SW1507", "a swarm cannot contain it"),
        (["component", "X", "--to", "Cart.bumper"], "SW1507", "already"),
        (
            ["event", "E", "std_msgs/Empty", "--file", "other.swarm"],
            "SW1507",
            "use `yard.swarm`",
        ),
    ],
)
def test_what_would_be_a_mistake_is_not_added(arguments, code, said, swarmc, model) -> None:
    ran = swarmc("add", *arguments)

    assert (ran.code, ran.out) == (1, ""), ran.out
    assert code in ran.err
    assert said in ran.err
    assert ran.err.endswith("nothing was added\n")
    assert model.read_text() == MODEL


@pytest.mark.parametrize(
    "arguments",
    [
        ["component", "X", "--in", "speed"],
        ["component", "X", "--param", "speed = 3"],
        ["function", "f"],
        ["function", "f", "--action", "a:b/C", "--service", "a:b/C"],
        ["member", "X", "--connect", "a.b c.d"],
        ["state", "X"],
        ["state", "Going.X", "--final", "--do", "drive"],
        ["swarm", "S"],
    ],
)
def test_what_cannot_be_meant(arguments, swarmc, model) -> None:
    ran = swarmc("add", *arguments)

    assert (ran.code, model.read_text()) == (2, MODEL)


def test_an_interface_that_nothing_describes_is_told(swarmc, model) -> None:
    ran = swarmc("add", "function", "count", "--action", "count:stock_msgs/Count")
    assert (ran.code, ran.out) == (0, "yard.swarm\n")
    assert "warning[SW0616]: no definition of interface `stock_msgs/Count`" in ran.err
    # `yard_msgs/Drive` was there before.
    assert ran.err.count("SW0616") == 1
    assert swarmc("check", "--deny", "warnings").code == 0


def test_a_model_with_mistakes_gets_what_makes_none(swarmc, model) -> None:
    model.write_text(MODEL.replace("MissionStart", "MissionStrt"))
    ran = swarmc("add", "event", "MissionStrt", "std_msgs/Empty")

    assert ran.code == 0
    assert swarmc("check").code == 0


def test_a_mistake_that_is_there_already_is_not_told_again(swarmc, model) -> None:
    model.write_text(MODEL.replace("-> Over", "-> Ovr"))
    ran = swarmc("add", "event", "Dark", "std_msgs/Empty")

    assert (ran.code, ran.err) == (0, "")


# ---- random things into random models

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# One imports files from beside it, and members of the other need values of their params.
_OTHERS = {"meadow", "turtlebots"}
FOLDERS = sorted({path.name for path in EXAMPLES.iterdir() if path.is_dir()} - _OTHERS)
names = st.from_regex(r"[A-Z][a-z]{2,5}[A-Z][a-z]{2,5}Zz", fullmatch=True)
docs = st.sampled_from(["", "One line.", "Two\nlines, and { braces }."])
types = st.sampled_from(["bool", "float64", "std_msgs/String", "geometry_msgs/Pose[]"])


@st.composite
def things(draw: st.DrawFn) -> Callable[[pipeline.Result, int], FindInsertion]:
    """Something to add, made for a model."""
    start, doc, type_ = draw(names), draw(docs), draw(types)
    number = draw(st.integers(0, 10_000))
    kind = draw(st.sampled_from(["component", "event", "function", "machine", "part", "state"]))

    def made(checked: pipeline.Result, turn: int) -> FindInsertion:
        name, small = f"{start}{turn}", f"{start.lower()}_{turn}"
        system = checked.system
        assert system is not None
        if kind == "event":
            return declaration(name, f"event {name} : std_msgs/String")
        if kind == "function":
            text = element_text.block(
                doc, f"function {small} : swarm", [f'service "{small}" : a/B']
            )
            return declaration(small, text)
        if kind == "machine":
            return declaration(name, element_text.machine(name, doc))
        if kind == "part" and system.swarms:
            swarm = system.swarms[number % len(system.swarms)]
            member = system.members[number % len(system.members)]
            return part_of(swarm.name, small, Swarm, f"{small} : {member.name}[2]")
        if kind == "part" and system.members and system.components:
            member = system.members[number % len(system.members)]
            component = system.components[number % len(system.components)].name
            return part_of(member.name, small, Member, f"{small} : {component}")
        if kind == "state" and system.machines:
            machine = system.machines[number % len(system.machines)]
            text = element_text.block(doc, f"state {name}", [f"after {number + 1} ms -> {name}"])
            return state(f"{machine.name}.{name}", text)
        ports = element_text.Ports((f"data:{type_}@{small}",), (f"more:{type_}",))
        return declaration(name, element_text.block(doc, f"sensor {name}", ports.lines()))

    return made


def _is_insertion(before: bytes, after: bytes) -> bool:
    """Return True if bytes were inserted in one place and no others changed."""
    same = next(
        (at for at, (a, b) in enumerate(zip(before, after, strict=False)) if a != b), len(before)
    )
    return after.endswith(before[same:])


@given(
    example=st.sampled_from(FOLDERS),
    added=st.lists(things(), min_size=1, max_size=3),
    ends=st.sampled_from(["\n", "\r\n"]),
)
@settings(
    max_examples=10,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],  # to shrink takes minutes
)
def test_random_things_in_random_models(example, added, ends, tmp_path_factory) -> None:
    folder = tmp_path_factory.mktemp("model")
    shutil.copytree(EXAMPLES / example, folder, dirs_exist_ok=True)
    files = sorted(folder.glob("*.swarm"))
    for file in files:
        file.write_bytes(file.read_bytes().replace(b"\n", ends.encode()))
    for number, make in enumerate(added):
        before = {file: file.read_bytes() for file in files}
        checked = pipeline.check([folder])
        done = add([folder], [make(checked, number)])
        after = {file: file.read_bytes() for file in files}

        assert not done.report.has_errors, [each.message for each in done.report]
        changed = [file for file in files if before[file] != after[file]]
        assert [Path(layout.name) for layout in done.layouts] == changed
        assert len(changed) == 1
        for file in changed:
            assert len(after[file]) > len(before[file])
            assert _is_insertion(before[file], after[file])
            assert len(re.findall(rb"(?<!\r)\n", after[file])) == 0 or ends == "\n"
            assert (b"\r\n" in after[file]) == (ends == "\r\n")
        assert not pipeline.check([folder]).report.has_errors


PARTS = "package parts\n\nsensor Eye { out seen : std_msgs/Empty }\n"
ROBOTS = "/// About robots.\nmember Bot { }\n"
MACHINES = """import "parts.swarm"

event Go : std_msgs/Empty

statemachine Old {
  initial A
  state A { on Go -> B }
  final B
}
"""
MAIN = """import "robots.swarm"
import "machines.swarm"

swarm Team { bot : Bot }
"""


@pytest.fixture
def files(folder: Path) -> Path:
    """A model of several files, of which one has robots only and imports nothing."""
    for name, text in (
        ("parts", PARTS),
        ("robots", ROBOTS),
        ("machines", MACHINES),
        ("main", MAIN),
    ):
        (folder / f"{name}.swarm").write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize("machine", ["New", "Old"])
def test_what_an_element_needs_is_imported(
    files: Path, swarmc: Callable[..., Any], machine: str
) -> None:
    words = ["--part", "eye:Eye", "--behavior", machine, "--to", "Team=2"]
    ran = swarmc("add", "member", "Scout", *words)

    assert (ran.code, ran.err) == (0, "")
    imports = 'import "machines.swarm"\nimport "parts.swarm"\n'
    robots = (files / "robots.swarm").read_text(encoding="utf-8")
    assert robots.startswith(f"{imports}\n{ROBOTS}\nmember Scout {{\n  behavior {machine}\n")
    machines = (files / "machines.swarm").read_text(encoding="utf-8")
    assert ("statemachine New" in machines) is (machine == "New")
    assert "scout : Scout[2]" in (files / "main.swarm").read_text(encoding="utf-8")
    assert swarmc("check", "--allow", "warnings").code == 0


def test_a_machine_goes_where_it_can_be_imported_from(
    files: Path, swarmc: Callable[..., Any]
) -> None:
    """The file with the machines imports that of the robots, which thus cannot import it."""
    path = files / "machines.swarm"
    path.write_text(f'import "robots.swarm"\n{MACHINES}', encoding="utf-8")
    ran = swarmc("add", "member", "Scout", "--behavior", "New")

    assert (ran.code, ran.err) == (0, "")
    assert "statemachine New" in (files / "robots.swarm").read_text(encoding="utf-8")
    assert swarmc("check", "--allow", "warnings").code == 0


def test_documentation_stays_above_its_declaration(
    folder: Path, swarmc: Callable[..., Any]
) -> None:
    path = folder / "robots.swarm"
    path.write_text(ROBOTS, encoding="utf-8")
    assert swarmc("add", "event", "Go", "std_msgs/Empty").code == 0
    assert path.read_text(encoding="utf-8") == f"event Go : std_msgs/Empty\n\n{ROBOTS}"
