"""`swarmc rename`: another name wherever something is named, and nowhere else."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PARTS = """package parts
sensor Camera {   // of Camera & Sons
  out image : sensor_msgs/Image
  param rate : float64 = 30.0
}
"""
MODEL = """package yard
import "parts.swarm"
import cpswarm.events.*

/// The Camera is in front.
member Cart {
  behavior Going
  param speed : float64 = 1.0
  camera : Camera { rate = 5.0 }
}

statemachine Going {
  param speed : float64
  var camera : float64 = 0.0
  initial Idle
  state Idle { on MissionStart [speed > camera] / camera = speed -> Busy.Drive }
  state Busy {
    initial Drive
    state Drive { on MissionAbort -> Idle }
    on done -> Done
    final Over
  }
  final Done
}

statemachine Other { initial Idle; state Idle { after 1 s -> Done }  final Done }
"""


@pytest.fixture
def yard(folder: Path) -> Path:
    (folder / "parts.swarm").write_bytes(PARTS.replace("\n", "\r\n").encode())
    (folder / "yard.swarm").write_text(MODEL, encoding="utf-8")
    return folder


CASES = [
    ("Camera", "Eye", [("sensor Camera", "sensor Eye")], [("camera : Camera {", "camera : Eye {")]),
    ("Camera.rate", "hz", [("param rate", "param hz")], [("{ rate =", "{ hz =")]),
    ("Cart.camera", "front", [], [("  camera : Camera", "  front : Camera")]),
    (
        "Going.camera",
        "seen",
        [],
        [("var camera", "var seen"), ("speed > camera] / camera =", "speed > seen] / seen =")],
    ),
    (
        "Going.Busy.Drive",
        "Roll",
        [],
        [
            ("Busy.Drive", "Busy.Roll"),
            ("initial Drive", "initial Roll"),
            ("state Drive", "state Roll"),
        ],
    ),
    ("Busy", "Work", [], [("-> Busy.", "-> Work."), ("state Busy", "state Work")]),
    (
        "Going.Idle",
        "Still",
        [],
        [
            ("initial Idle\n  state Idle {", "initial Still\n  state Still {"),
            ("-> Idle }", "-> Still }"),
        ],
    ),
    *(
        (
            old,
            "pace",
            [],
            [
                ("param speed : float64 = 1.0", "param pace : float64 = 1.0"),
                ("param speed : float64\n", "param pace : float64\n"),
                ("[speed >", "[pace >"),
                ("camera = speed", "camera = pace"),
            ],
        )
        for old in ("Cart.speed", "Going.speed")
    ),
    ("yard.Cart", "Van", [], [("member Cart", "member Van")]),
]


@pytest.mark.parametrize(("old", "new", "parts", "model"), CASES)
def test_it_is_called_otherwise_wherever_it_is_named(old, new, parts, model, swarmc, yard) -> None:
    wanted = {"parts.swarm": PARTS, "yard.swarm": MODEL}
    for name, changes in (("parts.swarm", parts), ("yard.swarm", model)):
        for before, after in changes:
            assert before in wanted[name]
            wanted[name] = wanted[name].replace(before, after, 1)
    shown = swarmc("rename", old, new, "--dry-run")
    assert (yard / "yard.swarm").read_text() == MODEL
    assert shown.out.count("--- ") == bool(parts) + bool(model)
    ran = swarmc("rename", old, new)

    assert (ran.code, ran.out) == (0, ""), ran.err
    assert "changed" in ran.err
    assert (yard / "parts.swarm").read_bytes() == wanted["parts.swarm"].replace(
        "\n", "\r\n"
    ).encode()
    assert (yard / "yard.swarm").read_text() == wanted["yard.swarm"]
    assert swarmc("check").code == 0


@pytest.mark.parametrize(
    ("old", "new", "code", "said"),
    [
        ("Camra", "Eye", "SW1503", "did you mean `Camera`?"),
        ("MissionStart", "Go", "SW1503", "a library declares it, and libraries cannot be changed"),
        ("geometry_msgs/Twist.linear", "x", "SW1503", "ROS declares it, and its interfaces cannot"),
        ("Idle", "Still", "SW1504", "qualify it, such as `Going.Idle`"),
        ("Camera", "on", "SW1505", "is a keyword"),
        ("Camera", "My-Eye", "SW1505", "is not a valid name"),
        ("Going.Busy.Drive", "Going.Busy.Roll", "SW1505", "give the unqualified name: `Roll`"),
        ("Cart.camera", "camera", "SW1505", "it has this name already"),
        ("Camera", "Cart", "SW1505", "cannot rename"),
        ("Going.Done", "Idle", "SW1505", "cannot rename"),
    ],
)
def test_what_cannot_be_renamed(old, new, code, said, swarmc, yard) -> None:
    ran = swarmc("rename", old, new)

    assert (ran.code, ran.out) == (1, "")
    assert code in ran.err
    assert said in ran.err
    assert (yard / "yard.swarm").read_text() == MODEL


def test_params_bound_by_name_have_one_name(swarmc, yard) -> None:
    model = """endless statemachine Going {
  param speed : float64
  initial Idle
  state Idle { after 1 s [speed > 2] -> Idle }
}

member Base { param speed : float64 = 1.0 }

member Cart extends Base { behavior Going }

member Van extends Base {
  param speed : float64 = 2.0
  behavior Going
}

member Other { param speed : float64 = 1.0 }

swarm Yard { cart : Cart { speed = 3.0 } }
"""
    other = "member Other { param speed"
    for old in ("Going.speed", "Base.speed", "Van.speed"):
        (yard / "yard.swarm").write_text(model)
        ran = swarmc("rename", old, "pace")

        assert ran.code == 0, ran.err
        renamed = model.replace("speed", "pace").replace(other.replace("speed", "pace"), other)
        assert (yard / "yard.swarm").read_text() == renamed


def test_a_param_bound_to_one_of_a_library_keeps_its_name(swarmc, yard) -> None:
    model = """import cpswarm.behaviours.SearchOnce

member Cart {
  behavior SearchOnce
  param altitude : float64 = 1.0
}
"""
    (yard / "yard.swarm").write_text(model)
    ran = swarmc("rename", "Cart.altitude", "height")

    assert ran.code == 1
    assert "`altitude` is bound to a param of a library by its name" in ran.err
    assert (yard / "yard.swarm").read_text() == model


def test_a_port_can_have_any_word_as_its_name(swarmc, yard) -> None:
    model = """sensor Camera { out seen : std_msgs/Empty }

member Cart {
  out shown : std_msgs/Empty
  camera : Camera
  connect camera.seen -> shown
}
"""
    (yard / "yard.swarm").write_text(model)
    for old, new in (("Camera.seen", "state"), ("Cart.shown", "event")):
        ran = swarmc("rename", old, new)
        assert ran.code == 0, ran.err

    renamed = model.replace("seen", "state").replace("shown", "event")
    assert (yard / "yard.swarm").read_text() == renamed
    assert swarmc("check").code == 0
    assert swarmc("fmt", "--check", "yard.swarm").code == 0
    refused = swarmc("rename", "Cart.camera", "sensor")
    assert "is a keyword" in refused.err


def test_roles_and_their_params(swarmc, yard) -> None:
    model = """member Cart { param speed : float64 = 1.0 }
swarm Yard {
  cart : Cart[2] { speed = 2.0 }
  cart[1] { speed = 3.0 }
}
"""
    (yard / "yard.swarm").write_text(model)
    assert swarmc("rename", "Yard.cart", "van").code == 0
    assert swarmc("rename", "Cart.speed", "pace").code == 0
    model = model.replace("cart :", "van :").replace("cart[1]", "van[1]").replace("speed", "pace")
    assert (yard / "yard.swarm").read_text() == model


ADDRESSED = """swarm event Go : std_msgs/Empty

endless statemachine Roll {
  initial A
  state A {
    on Go / send Go to cart, send Go to cart[0], send Go to event.sender
    after 2 s / send Go to "cart[1]" -> A
  }
}

member Cart { behavior Roll }

swarm Yard { cart : Cart[2] }
"""


def test_a_role_in_addresses(swarmc, yard) -> None:
    (yard / "yard.swarm").write_text(ADDRESSED)
    assert swarmc("rename", "Yard.cart", "van").code == 0
    wanted = ADDRESSED
    for before in ("to cart", '"cart', "{ cart"):
        wanted = wanted.replace(before, before.replace("cart", "van"))
    assert (yard / "yard.swarm").read_text() == wanted
    assert swarmc("check").code == 0


def test_a_role_in_the_steps_of_a_test(swarmc, yard) -> None:
    (yard / "yard.swarm").write_text(ADDRESSED)
    text = """swarm = "Yard"

[[test]]
name  = "a cart calls"  # sent by a cart
steps = [
  { send = "Go", to = "cart[0]", sender = "cart[1]" },
  { who = "cart[0]", sends = "Go", to = "cart" },
]
"""
    file = yard / "yard.swarmtest.toml"
    file.write_text(text)
    ran = swarmc("rename", "Yard.cart", "van")
    assert ran.code == 0
    assert file.read_text() == text.replace('"cart', '"van')


def test_a_role_that_another_swarm_has_too(swarmc, yard) -> None:
    """The machine would name a role that the other swarm does not have."""
    model = ADDRESSED + "\nswarm Farm { cart : Cart[3] }\n"
    (yard / "yard.swarm").write_text(model)
    ran = swarmc("rename", "Yard.cart", "van")
    assert (ran.code, "SW1505" in ran.err) == (1, True)
    assert "it is also a role of another swarm that runs `Roll`" in ran.err
    assert (yard / "yard.swarm").read_text() == model


def test_a_file_that_is_not_there(swarmc, yard) -> None:
    for command in (["rename", "Camera", "Eye", "yrd.swarm"], ["add", "member", "X"]):
        more = ["--model", "yrd.swarm"] if command[0] == "add" else []
        ran = swarmc(*command, *more)

        assert (ran.code, ran.out) == (1, "")
        assert "error[SW0001]" in ran.err
        assert "did you mean `yard.swarm`?" in ran.err


TESTS = """# Going goes to Drive.
machine = "Going"

[[test]]
name  = "Drive"   # Drive
scenario = { params = { speed = 1.0 } }
steps = [
  { send = "MissionStart" },
  { in = "Drive" },
  { in = ["Busy.Drive", "Drive"] },
  { has = { camera = 1.0 } },
]
[[test]]
name    = "other"
machine = "Other"
steps   = [{ in = "Idle" }, { in = "Drive" }]
"""
EVENT = """event Start : std_msgs/Empty on "start"
event MissionAbort : std_msgs/Empty on "abort"
"""
SWARM = "swarm Yard { cart : Cart[1..3] }\n"


@pytest.mark.parametrize(
    ("old", "new", "changes", "told"),
    [
        (
            "Going.Busy.Drive",
            "Roll",
            [
                ('in = "Drive" },\n', 'in = "Roll" },\n'),
                ('["Busy.Drive", "Drive"]', '["Busy.Roll", "Roll"]'),
            ],
            # The comments, the name of a test, and a mistake that was one before.
            [(1, 17), (5, 10), (5, 21), (16, 37)],
        ),
        ("Busy", "Work", [('"Busy.', '"Work.')], []),
        ("Going", "Roaming", [('machine = "Going"', 'machine = "Roaming"')], [(1, 3)]),
        ("Going.camera", "seen", [("{ camera =", "{ seen =")], []),
        # Nothing here means this one.
        ("Other.Idle", "Still", [('[{ in = "Idle"', '[{ in = "Still"')], []),
        ("Going.Idle", "Still", [], []),
    ],
)
def test_tests_follow(old, new, changes, told, swarmc, yard) -> None:
    file = yard / "yard.swarmtest.toml"
    file.write_bytes(TESTS.replace("\n", "\r\n").encode())
    wanted = TESTS
    for before, after in changes:
        assert before in wanted
        wanted = wanted.replace(before, after)
    shown = swarmc("rename", old, new, "--dry-run")
    assert ("+++ yard.swarmtest.toml" in shown.out) == bool(changes)
    ran = swarmc("rename", old, new, "--format", "concise")

    assert ran.code == 0, ran.err
    assert file.read_bytes().decode() == wanted.replace("\n", "\r\n")
    found = re.findall(r"yard.swarmtest.toml:(\d+):(\d+): warning\[SW1506\]", ran.err)
    assert [(int(line), int(column)) for line, column in found] == told


def test_scenarios_follow(swarmc, yard) -> None:
    model = MODEL.replace("import cpswarm.events.*", EVENT).replace("MissionStart", "Start")
    (yard / "yard.swarm").write_text(model + SWARM)
    scenario = """# Start is called by the Cart.
count.cart = 2
[params.cart]
speed = 2.0
[[messages]]
event = "Start"   # Start
to    = ["cart[1]", "Cart"]
at    = "1 s"
[[faults]]
at   = "3 s"
lost = "cart[0]"
"""
    (yard / "mission.toml").write_text(scenario)
    (yard / "other.toml").write_text('text = "Start"\n')
    for old, new in (("Start", "Go"), ("Yard.cart", "van"), ("Cart", "Van")):
        assert swarmc("rename", old, new).code == 0

    wanted = scenario.replace('"Start"', '"Go"').replace("cart", "van").replace('"Cart"', '"Van"')
    assert (yard / "mission.toml").read_text() == wanted
    assert (yard / "other.toml").read_text() == 'text = "Start"\n'
    ran = swarmc("simulate", "--scenario", "mission.toml", "--trace", "text")
    assert (ran.code, "Go -> Busy.Drive" in ran.out) == (0, True), ran.err


def test_a_scenario_that_more_than_one_swarm_can_have_is_told(swarmc, yard) -> None:
    (yard / "yard.swarm").write_text(MODEL + SWARM + SWARM.replace("Yard", "Barn"))
    (yard / "mission.toml").write_text("count.cart = 2\n")
    ran = swarmc("rename", "Barn.cart", "van", "--format", "concise")

    assert ran.code == 0
    assert "mission.toml:1:7: warning[SW1506] the old name `cart` is still used here" in ran.err
    assert (yard / "mission.toml").read_text() == "count.cart = 2\n"


def test_the_style_of_a_name_is_looked_at(swarmc, yard) -> None:
    ran = swarmc("rename", "Cart.camera", "Front", "--format", "concise")

    assert ran.code == 0
    assert "warning[SW0206] part `Front` is not in snake_case" in ran.err
    assert "SW0206" not in swarmc("rename", "Cart.Front", "front").err


def test_what_stays_where_nothing_says_what_it_means(swarmc, yard) -> None:
    (yard / "yard.swarmtest.toml").write_text('[[test]]\nname = "x"\nsteps = [{ in = "Drive" }]\n')
    (yard / "other.toml").write_text('text = "Driver"\n')
    ran = swarmc("rename", "Going.Busy.Drive", "Roll", "--format", "concise")

    assert ran.code == 0
    assert (
        "yard.swarmtest.toml:3:18: warning[SW1506] the old name `Drive` is still used here"
        in ran.err
    )
    assert "other.toml" not in ran.err
    assert "keeps this name" not in ran.err


IDENTIFIED = """endless statemachine Watching {
  var last : string = "cart[0]"
  initial A
  state A {
    on member_lost [event.role == "cart" and present(cart) < 2 or event.id == "cart[1]"] -> A
    after 2 s [self.role != "cart"] -> A
    after 3 s [last == "cart[1]"] -> A
  }
}

member Cart { behavior Watching }

swarm Yard {
  heartbeat 1 s lost after 5 s
  cart : Cart[2]
}

property Stays of Yard : each cart : never hears member_lost [event.id == "cart[1]"]
"""


def test_a_role_in_comparisons(swarmc, yard) -> None:
    """Strings that may mean something else are told."""
    (yard / "yard.swarm").write_text(IDENTIFIED)
    ran = swarmc("rename", "Yard.cart", "van")
    lines = IDENTIFIED.splitlines()
    for number in (4, 5, 14, 17):
        lines[number] = lines[number].replace("cart", "van")
    assert (yard / "yard.swarm").read_text().splitlines() == lines
    assert [line for line in ran.err.splitlines() if "-->" in line] == [
        " --> yard.swarm:2:23",
        " --> yard.swarm:7:24",
    ]


def test_a_role_in_comparisons_of_two_swarms(swarmc, yard) -> None:
    """The comparison would be with a role that the other swarm does not have."""
    model = IDENTIFIED.replace(" and present(cart) < 2", "")
    model += "swarm Farm { heartbeat 1 s lost after 5 s; cart : Cart }\n"
    (yard / "yard.swarm").write_text(model)
    ran = swarmc("rename", "Yard.cart", "van")
    assert ran.code == 1
    assert "it is also a role of another swarm that runs `Watching`" in ran.err
    assert (yard / "yard.swarm").read_text() == model


def test_targets_of_one_kind_have_one_name_and_areas_their_own(swarmc, folder: Path) -> None:
    (folder / "fields.swarm").write_text(
        """environment Field {
  area meadow : (0 m, 0 m) .. (5 m, 5 m)
  target person at random in meadow
}
environment Town {
  area meadow : (0 m, 0 m) .. (5 m, 5 m)
  target person at (1 m, 1 m)
}
sensor Eye { senses person { range = 5 m } }
member Car { eye : Eye }
swarm S {
  environment Field
  car : Car in meadow
}
""",
        encoding="utf-8",
    )
    assert swarmc("rename", "Field.person", "walker", folder).code == 0
    assert swarmc("rename", "Field.meadow", "pasture", folder).code == 0

    text = (folder / "fields.swarm").read_text(encoding="utf-8")
    assert (text.count("walker"), text.count("person")) == (3, 0)
    assert "target walker at random in pasture" in text
    assert "car : Car in pasture" in text
    assert "area meadow" in text.partition("environment Town")[2]


def test_fields(swarmc, tmp_path):
    path = tmp_path / "dive.swarm"
    path.write_text(
        """action Dive {
  goal   { depth : float64 }
  result { depth : float64 }
}

function dive : abstraction {
  action "dive" : dive/Dive
}

statemachine Diver {
  var reached : float64 = 0.0

  initial Down

  state Down {
    do dive(depth = 3.0) gives (depth => reached)
    on succeeded [reached > 3.0] -> Done
    on succeeded, aborted -> Done
  }

  final Done
}
"""
    )
    assert "did you mean `Dive.goal.depth`" in swarmc("rename", "Dive.depth", "deep", path).err
    assert "such as `Dive.goal.depth`" in swarmc("rename", "depth", "deep", path).err
    assert swarmc("rename", "Dive.result.depth", "deep", path).code == 0
    text = path.read_text()
    assert "goal { depth :" in " ".join(text.split())
    assert "do dive(depth = 3.0) gives (deep => reached)" in text
