"""Content of the page generated from a model."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline
from swarmdsl.ir import Action, Message, Service, StateMachine, System
from swarmdsl.tools.document import document

from .conftest import MODELS, ROOT, SAR, Page, page_of, read


def own_states(machine: StateMachine) -> Iterator[tuple[str, str]]:
    """The states of a machine with their documentation, without those of machines it reuses."""
    ahead = list(machine.states)
    while ahead:
        state = ahead.pop()
        yield f"{machine.name}.{state.id}", state.doc
        ahead += state.states if state.submachine is None else ()


def described(system: System) -> Iterator[tuple[str, str]]:
    """The anchors that a page must have, each with what the model says of it."""
    for swarm in system.swarms:
        yield swarm.name, swarm.doc
        yield from ((f"{swarm.name}.{role.name}", role.doc) for role in swarm.roles)
    for owner in (*system.members, *system.components):
        yield owner.name, owner.doc
        if owner.base is None:
            inside = (*owner.ports, *owner.params, *getattr(owner, "parts", ()))
            yield from ((f"{owner.name}.{each.name}", each.doc) for each in inside)
    for machine in system.machines:
        yield machine.name, machine.doc
        yield from own_states(machine)
    for function in system.functions:
        if "/" not in function.communication.type.package and function.ports + function.params:
            yield function.name, function.doc
            yield from ((f"{function.name}.{each.name}", each.doc) for each in function.params)
    for others in (system.environments, system.fitness):
        yield from ((each.name, each.doc) for each in others)
    declared = [e for e in system.events if e.origin.text == e.name and not e.predefined]
    yield from ((each.name, each.doc) for each in declared)
    for interface in system.interfaces:
        name = str(interface.type) if interface.external else interface.type.name
        parts = {
            Message: ("fields", "constants"),
            Service: ("request", "response"),
            Action: ("goal", "result", "feedback"),
        }[type(interface)]
        if interface.origin.text != interface.type.name and not interface.external:
            continue  # the service that an operation is
        yield name, interface.doc
        for part in parts:
            within = f"{name}." if len(parts) == 2 and part[0] in "fc" else f"{name}.{part}."
            yield from ((within + each.name, each.doc) for each in getattr(interface, part))


def plain(text: str) -> str:
    """Words alone, as documentation is Markdown."""
    return " ".join(re.findall(r"\w+", text))


def test_every_element_is_there_with_what_is_said_of_it(page: Page) -> None:
    ids = {each.get("id"): each for each in page.tree.iter() if each.get("id")}
    wanted = dict(described(page.system))
    assert wanted.keys() - ids.keys() == set()
    for anchor, doc in wanted.items():
        assert plain(doc) in plain(ids[anchor].text_content()), anchor


def test_every_link_leads_somewhere(page: Page) -> None:
    ids = Counter(each.get("id") for each in page.tree.iter() if each.get("id"))
    assert [anchor for anchor, count in ids.items() if count > 1] == []
    assert set(page.links()) - ids.keys() == set()
    assert len(page.links()) > len(ids)


def test_it_has_nothing_from_elsewhere(page: Page) -> None:
    fetched = [link for element, name, link, _ in page.tree.iterlinks() if name != "href"]
    assert fetched == []
    assert [each.get("href") for each in page.tree.iter("link")] == ["data:,"]
    style = "".join(each.text for each in page.tree.iter("style"))
    assert "url(" not in style
    assert "@import" not in style


def test_every_table_has_as_many_cells_as_columns(page: Page) -> None:
    for table in page.tree.iter("table"):
        head, *rows = [len(row) for row in table.iter("tr")]
        assert rows
        assert set(rows) == {head}


def test_a_swarm_and_its_members(sar: Page) -> None:
    assert sar.table("SearchAndRescue", "Roles") == [
        ["role", "member", "multiplicity", "values"],
        ["uav", "Uav", "3", "in base"],
        ["rover", "Rover", "1 to 5", "in base"],
    ]
    assert sar.fact("SearchAndRescue", "environment") == "Field"
    assert sar.fact("Field", "size") == "100 m x 100 m"
    assert sar.fact("Field", "used by") == "SearchAndRescue"
    assert sar.fact("Uav", "behavior") == "UavSearch"
    assert ["pilot", "Autopilot", "frequency = 20.0"] in sar.table("Uav", "Parts")
    assert sar.table("Uav", "Connectors")[1] == [
        "camera.target",
        "pilot.target",
        "cpswarm_msgs/TargetPositionEvent",
    ]
    assert sar.table("Autopilot", "Ports")[3][1:3] == ["out", "geometry_msgs/Twist"]
    assert sar.fact("Autopilot", "used by") == "Uav.pilot, Rover.pilot"


def test_a_state_is_reached_by_transitions_only(tmp_path: Path) -> None:
    """A trigger that waits for its end names a state, too."""
    model = tmp_path / "model.swarm"
    model.write_text("""
      event Go : std_msgs/Empty
      statemachine Land {
        initial Down
        state Down { on Go -> Ok; after 5 s -> Bad }
        final Ok
        final Bad
      }
      statemachine Work {
        var n : int32 = 1
        initial Landing
        state Landing = Land { on done.Ok -> Next; on done.Bad -> Landing }
        state Next {
          initial In
          state In { after 1 s -> Out; on Go -> Pick }
          final Out
          on done.Out -> Pick
        }
        choice Pick { [n < 2] -> Next.In; else -> Stop }
        final Stop
      }
    """)
    shown = page_of(model)
    assert {
        name: shown.fact(name, "reached from")
        for name in (
            "Land.Ok",
            "Land.Bad",
            "Work.Next",
            "Work.Next.In",
            "Work.Next.Out",
            "Work.Stop",
        )
    } == {
        "Land.Ok": "Land.Down",
        "Land.Bad": "Land.Down",
        "Work.Next": "Work.Landing, Work.Pick",
        "Work.Next.In": "Work.Next, Work.Pick",
        "Work.Next.Out": "Work.Next.In",
        "Work.Stop": "Work.Pick",
    }


def test_a_state_machine(sar: Page) -> None:
    assert sar.fact("UavSearch", "initial state") == "Mission"
    assert sar.fact("UavSearch", "outcomes") == "none (endless)"
    assert sar.fact("RoverRescue", "outcomes") == "RoverRescue.Parked"
    assert sar.table("UavSearch", "Params")[1][:3] == ["altitude", "float64", "1.5"]
    coverage = "UavSearch.Mission.Coverage"
    assert sar.fact(coverage, "activity") == (
        "do uav_coverage(altitude = altitude)"
        " gives (target_id => target_id, target_pose => target_pose)"
    )
    assert sar.fact(coverage, "reached from") == (
        "UavSearch.Mission.TakeOff, UavSearch.Mission.Tracking, UavSearch.Mission.LocalCoverage"
    )
    assert sar.table(coverage, "Transitions") == [
        ["on", "to"],
        ["succeeded", "SelectRover"],
        ["aborted", "Abort"],
    ]
    assert sar.table("RoverRescue.Mission.Rescue.Ready", "Transitions")[1] == [
        "TargetFound",
        "task_id = event.id, task_pose = event.pose",
        "Bid",
    ]
    assert sar.at(coverage).find("h4/span[@class='place']").text == "behaviours.swarm:31"


def test_functions_as_an_api(sar: Page) -> None:
    assert sar.table("section-functions", "Function usage")[3] == [
        "uav_coverage",
        "swarm",
        "action",
        "uav_coverage",
        "cpswarm_msgs/Coverage",
        "UavSearch.Mission.Coverage",
    ]
    facts = {term: sar.fact("uav_mavros_takeoff", term) for term in ("category", "paradigm")}
    assert facts == {"category": "abstraction", "paradigm": "action"}
    assert sar.fact("uav_mavros_takeoff", "server") == "cmd/takeoff"
    assert sar.table("uav_mavros_takeoff", "Goal") == [["field", "type"], ["altitude", "float64"]]
    assert sar.table("uav_mavros_takeoff", "Topics")[1] == [
        "in",
        "mavros/state",
        "mavros_msgs/State",
    ]
    assert sar.table("uav_mavros_takeoff", "Params")[1] == ["pos_tolerance", "float64", "0.1"]
    assert ["task_id", "string", "ID of the task"] in sar.table("bid_action", "Result")
    assert sar.table("uav_tracking", "Used by")[1:] == [
        [
            "UavSearch.Mission.Tracking",
            "do uav_tracking(target = target_id, altitude = altitude)",
            "Coverage",
            "LocalCoverage",
        ]
    ]


def test_who_sends_and_who_handles_which_event() -> None:
    page = page_of(ROOT / "examples" / "cpswarm")
    head, *rows = page.table("section-events", "Senders and handlers of events")
    assert "UavSar of Uav" in head
    matrix = {
        (row[0], machine.partition(" of ")[0]): cell
        for row in rows
        for machine, cell in zip(head[1:], row[1:], strict=True)
    }
    for event in page.system.events:
        for machine in page.system.machines:
            told = matrix.get((event.name, machine.name), "")
            states = list(machine.walk())
            handled = any(
                getattr(trigger, "event", "") == event.name
                for state in states
                for transition in state.transitions
                for trigger in transition.triggers
            )
            effects = [
                effect
                for state in states
                for effect in (
                    *state.entry,
                    *state.exit,
                    *(effect for each in state.transitions for effect in each.effects),
                )
            ]
            sent = any(getattr(effect, "event", "") == event.name for effect in effects)
            assert ("handles" in told, "sends" in told) == (handled, sent), (event.name, machine)
    assert {"handles", "sends"} <= {word for cell in matrix.values() for word in cell.split()}


def test_many_state_machines_are_listed_by_event(tmp_path: Path) -> None:
    machines = "".join(
        f"statemachine M{number} {{\n  initial A\n"
        f"  state A {{ on E{number} / send E0 -> F }}\n  final F\n}}\n"
        for number in range(21)
    )
    events = "".join(f"event E{number} : std_msgs/Empty\n" for number in range(22))
    path = tmp_path / "many.swarm"
    path.write_text(f"package many\n{events}{machines}", encoding="utf-8")
    head, *rows = page_of(path).table("section-events", "Senders and handlers of events")
    assert head == ["event", "sent by", "handled by"]
    assert rows[0] == ["E0", ", ".join(f"M{number}" for number in range(21)), "M0"]
    assert rows[20:] == [["E20", "", "M20"], ["E21", "", ""]]


def test_diagrams_lead_to_what_they_show(sar: Page) -> None:
    def shown(anchor: str) -> dict[str, str]:
        picture = sar.at(anchor).find("figure")
        return {
            link[0].get("data-id"): link.get("href").removeprefix("#") for link in picture.iter("a")
        }

    around = {
        "role.uav": "Uav",
        "role.rover": "Rover",
        "environment": "Field",
        "fitness": "Rescued",
    }
    assert shown("SearchAndRescue") == around
    chart = shown("RoverRescue")
    assert chart["Mission.Rescue.Bid"] == "RoverRescue.Mission.Rescue.Bid"
    assert chart["Mission.Rescue.Bid->0"] == "RoverRescue.Mission.Rescue.Bid"
    assert shown("Uav")["camera"] == "Uav.camera"
    assert shown("Uav")["pilot:velocity"] == "Autopilot.velocity"


def test_a_page_is_the_same_from_everywhere(sar: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(SAR)
    checked = pipeline.check([Path()])
    assert checked.valid is not None
    assert document(checked.valid)[1] == sar.text


def test_of_libraries_what_is_used(tmp_path: Path) -> None:
    path = tmp_path / "mine.swarm"
    path.write_text(
        "package mine\nimport cpswarm.functions.*\n"
        "statemachine M { initial Up; state Up { do uav_mavros_takeoff(altitude = 2.0)\n"
        "on succeeded, aborted -> Done } final Done }\n"
    )
    used, all_of_it = page_of(path), page_of(path, libraries=True)
    for page in (used, all_of_it):
        entry = page.at("uav_mavros_takeoff")
        assert entry.find("h3/span[@class='note']").text == "library"
        assert entry.findtext("h3/span[@class='place']").startswith("cpswarm/functions/")
        assert "uav_mavros_takeoff" in page.links()
        assert set(page.links()) <= {each.get("id") for each in page.tree.iter()}
    ids = [{each.get("id") for each in page.tree.iter()} for page in (used, all_of_it)]
    assert "uav_mavros_land" not in ids[0]
    assert "uav_mavros_land" in ids[1]


ODD = """/// <script>alert(1)</script> & "quotes" ![x](http://example.org/a.png)
/// <img src=x onerror=alert(2)> [go](javascript:alert(3)) [there](https://example.org)
/// # No heading
package odd

/// </style></script><svg onload=alert(4)> `Odd` and `Work.Busy`, [here](#Odd), [away](#Nothing)
event Odd : std_msgs/Empty on "odd"
swarm event Told : std_msgs/String
/// | a | b |
/// |---|---|
/// | 1 | <b>2</b> |
endless statemachine Work {
  var text : string = "</script><script>alert(5)</script> // no /* comment"
  initial Busy
  state Busy {
    entry / send Told(data = "<b>\\"  two  spaces\\"</b>") // a comment
    on Odd [/* odd */ text == "<i>"] / text = "]]>" -> Busy
  }
}
"""


def test_text_of_a_model_is_no_markup(tmp_path: Path) -> None:
    path = tmp_path / "odd<b>.swarm"
    path.write_text(ODD)
    checked = pipeline.check([path])
    assert checked.valid is not None
    assert checked.system is not None
    page = read(document(checked.valid)[1], checked.system)

    assert len(list(page.tree.iter("script"))) == 1
    assert not list(page.tree.iter("img", "iframe", "object"))
    assert not [name for each in page.tree.iter() for name in each.attrib if name[:2] == "on"]
    assert [each for each in page.tree.iter("b") if each.getparent().tag != "a"] == []
    outward = {each.get("href") for each in page.tree.iter("a") if "#" not in each.get("href")}
    assert outward == {"http://example.org/a.png", "https://example.org"}
    assert "javascript:alert(3)" in page.told("page-overview")
    assert "<script>alert(1)</script>" in page.told("page-overview")
    assert [each.tag for each in page.at("page-overview").iter("h1", "h2")] == ["h1"]

    odd = page.at("Odd").find("div[@class='doc']")
    assert [link.get("href") for link in odd.iter("a")] == ["#Odd", "#Work.Busy", "#Odd"]
    assert [cell.text for cell in page.at("Work").iterfind("div/table/tbody/tr/td")][:2] == [
        "1",
        "<b>2</b>",
    ]
    assert page.fact("Work.Busy", "entry") == 'send Told(data = "<b>\\" two spaces\\"</b>")'
    assert '"&lt;b&gt;\\"  two  spaces\\"&lt;/b&gt;"' in page.text.replace("&#34;", '"')
    assert page.table("Work.Busy", "Transitions")[1] == [
        "Odd",
        'text == "<i>"',
        'text = "]]>"',
        "Busy",
    ]
    assert page.table("Work", "Variables")[1][2] == (
        '"</script><script>alert(5)</script> // no /* comment"'
    )
    assert page.at("Work").findtext("h3/span[@class='place']") == "odd<b>.swarm:12"


def test_a_brace_in_a_text_does_not_end_a_declaration(tmp_path: Path) -> None:
    model = tmp_path / "braces.swarm"
    model.write_text('package braces\nconst GREETING : string = "a{b"', encoding="utf-8")
    assert 'const GREETING : string = "a{b"' in page_of(model).told("GREETING")


def test_models_to_look_at() -> None:
    """None of the tests above would fail if nothing were found."""
    assert len(MODELS) > 8
