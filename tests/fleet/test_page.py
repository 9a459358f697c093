"""Pages of a fleet, and who may ask for them."""

from __future__ import annotations

import json
import struct
from array import array
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from http.client import HTTPConnection
from pathlib import Path
from socket import SO_LINGER, SOL_SOCKET, create_connection
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.ide.fleet.followed import follow_trace
from swarmdsl.ide.fleet.operator_events import OperatorEvent
from swarmdsl.ide.fleet.ros2_messages import fill
from swarmdsl.ide.fleet.serving import serving
from swarmdsl.ide.fleet.watch import NotSentError, Watch
from swarmdsl.ide.preview.local_server import LocalHandler
from swarmdsl.tools.player.record import record_nothing

from ..player.conftest import browser as browser

MODEL = """
message Place { x : float64; note : string }
/// Fly there.
swarm operator event Visit : Place
/// Land at once.
swarm operator event Abort : std_msgs/Empty
swarm event Found : std_msgs/Empty
statemachine Work {
  initial Off
  state Off { on Visit -> On; on Abort -> Down }
  state On { on Found -> Off; on Abort -> Down }
  final Down
}
member Robot { behavior Work }
swarm Crew {
  robot : Robot[2]
  heartbeat 1 s lost after 3 s
}
property Stays of Crew : never some robot in On
"""
NAMES = ("configuration", "entered", "exited", "taken", "started", "cancelled", "sent")
TOKEN = "let me in"


def line(time: int, member: str, event: str | None, *states: str, **more: Any) -> str:
    """A line of a trace; the robot is in these states after it."""
    lists: dict[str, Any] = {name: [] for name in NAMES}
    done = {"event": event, **lists, "configuration": [*states], "entered": [*states], **more}
    return json.dumps({"t": time, "member": member, **done})


@pytest.fixture(scope="module")
def crew(tmp_path_factory: pytest.TempPathFactory) -> Prepared:
    path = tmp_path_factory.mktemp("crew") / "model.swarm"
    path.write_text(MODEL, encoding="utf-8")
    report = Diagnostics()
    prepared = prepare(Request((path,)), report)
    assert prepared is not None, [each.message for each in report]
    return prepared


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


class Seen:
    """A watch over the crew, with a clock of its own, and what was sent."""

    def __init__(self, crew: Prepared) -> None:
        self.clock = Clock()
        self.told: list[str] = []
        self.sent: list[tuple[str, Mapping[str, Any]]] = []
        recording = record_nothing(crew, "crew")
        self.watch = Watch("crew", crew.subject, recording, self._tell, self.clock)

    def _tell(self, report: Diagnostics) -> None:
        self.told += [each.code for each in report]


@pytest.fixture
def seen(crew: Prepared) -> Seen:
    return Seen(crew)


def rows(watch: Watch) -> dict[str, Any]:
    return {row["robot"]: row for row in watch.head()["robots"]}


def statuses(watch: Watch) -> list[str]:
    return [row["status"] for row in watch.head()["robots"]]


def test_events_of_a_person_begin_with_those_that_abort(seen: Seen) -> None:
    heads = [each.head() for each in seen.watch.events]
    assert [(each["name"], each["urgent"], each["blank"]) for each in heads] == [
        ("Abort", True, {}),
        ("Visit", False, {"x": 0.0, "note": ""}),
    ]


def test_robots_come_go_and_come_again(seen: Seen) -> None:
    watch, clock = seen.watch, seen.clock
    assert statuses(watch) == ["expected", "expected"]
    watch.read([line(0, "robot[0]", None, "Off")])
    with watch.noting() as standing:
        standing.begin("robot[0]", "/crew/robot_0/work")
        standing.beat("robot[0]")
        standing.charge("robot[0]", 0.4)
    assert statuses(watch) == ["there", "expected"]
    clock.now = 3.5
    assert statuses(watch) == ["lost", "expected"]
    assert watch.head()["alarms"] == ["robot[0] is lost"]
    with watch.noting() as standing:
        standing.beat("robot[0]")
        standing.begin("robot[1].camera", "/crew/robot_1/camera/look")
    assert statuses(watch) == ["there", "there"]
    # A node that has left is lost at once; whoever has ended is not.
    with watch.noting() as standing:
        standing.end("/crew/robot_1/camera/look")
    assert statuses(watch) == ["there", "lost"]
    watch.read([line(9, "robot[0]", "Abort", "Down", ended=True)])
    with watch.noting() as standing:
        standing.end("/crew/robot_0/work")
    assert statuses(watch) == ["ended", "lost"]
    assert rows(watch)["robot[0]"]["battery"] == 0.4
    assert not seen.told


def test_what_is_wrong_is_an_alarm(seen: Seen) -> None:
    violated = {"violations": [{"robot": "robot[1]", "t": 3}], "conditions": []}
    seen.watch.read([json.dumps({"t": 4, "property": "Stays", "verdict": "false", **violated})])
    with seen.watch.noting() as standing:
        standing.tell_model("robot[0]", "/crew/robot_0/work", "crew 1.0 (aa)")
        standing.tell_model("robot[1]", "/crew/robot_1/work", "crew 1.1 (bb)")
    head = seen.watch.head()
    assert head["verdicts"] == {"Stays": "false"}
    assert head["alarms"] == [
        "property Stays is violated",
        "robots have different models: crew 1.0 (aa), crew 1.1 (bb)",
    ]


def test_a_state_that_the_model_does_not_have_is_told(seen: Seen) -> None:
    seen.watch.read([line(0, "robot[0]", None, "Off"), line(1, "robot[1]", None, "Nowhere")])
    seen.watch.read([line(2, "robot[1]", "Visit", "Nowhere")])
    assert seen.told == ["SW1010"]
    assert rows(seen.watch)["robot[1]"]["machines"][0]["states"] == ["Nowhere"]


def ask(
    address: str, method: str, path: str, body: object = None, **headers: str
) -> tuple[int, str]:
    """Status and text of the answer of a server."""
    port = int(address.split(":")[2].partition("/")[0])
    connection = HTTPConnection("127.0.0.1", port, timeout=20)
    text = None if body is None else json.dumps(body)
    kind = {} if body is None else {"Content-Type": "application/json"}
    connection.request(method, path, text, {**kind, **headers})
    answer = connection.getresponse()
    found = answer.read().decode()
    connection.close()
    return answer.status, found if answer.status != 303 else answer.headers["Set-Cookie"]


def test_only_pages_of_this_computer_are_answered(seen: Seen) -> None:
    seen.watch.send_with(lambda event, fields: 2)
    with serving(seen.watch, "127.0.0.1", 0, None) as address:
        own = address.removesuffix("/")
        abort = {"event": "Abort"}
        assert ask(address, "GET", "/")[0] == 200
        assert ask(address, "POST", "/send", abort, Origin=own) == (200, '{"heard": 2, "lost": []}')
        for wrong in (
            {"Origin": "https://example.org"},
            {"Origin": "null"},
            {"Origin": own.replace("http:", "https:")},
            {"Host": "example.org"},
        ):
            assert ask(address, "GET", "/", None, **wrong)[0] == 403, wrong
            assert ask(address, "POST", "/send", abort, **wrong)[0] == 403, wrong
        # A form of another page sends no JSON.
        sent = ask(address, "POST", "/send", abort, **{"Content-Type": "text/plain"})
        assert sent[0] == 403
        assert ask(address, "POST", "/open", abort)[0] == 403
    assert [each["heard"] for each in seen.watch.head()["sent"]] == [2]


def test_others_need_the_token(seen: Seen) -> None:
    seen.watch.send_with(lambda event, fields: 1)
    with serving(seen.watch, "127.0.0.1", 0, TOKEN.replace(" ", "-")) as address:
        path = f"/{address.rpartition('/')[2]}"
        elsewhere = {"Host": "robots.example.org"}
        for way in ({}, elsewhere, {"Authorization": "Bearer other"}, {"Cookie": "x=let-me-in"}):
            assert ask(address, "GET", "/", None, **way)[0] == 403, way
            assert ask(address, "GET", "/events", None, **way)[0] == 403, way
            assert ask(address, "POST", "/send", {"event": "Abort"}, **way)[0] == 403, way
        status, cookie = ask(address, "GET", path, None, **elsewhere)
        assert status == 303
        assert "HttpOnly; SameSite=Strict" in cookie
        known = {**elsewhere, "Cookie": cookie.partition(";")[0]}
        assert ask(address, "GET", "/", None, **known)[0] == 200
        answer = ask(address, "POST", "/send", {"event": "Abort"}, **known)
        assert answer == (200, '{"heard": 1, "lost": []}')
        foreign = {**known, "Origin": "http://example.org"}
        assert ask(address, "POST", "/send", {"event": "Abort"}, **foreign)[0] == 403
        bearer = {"Authorization": "Bearer let-me-in"}
        assert ask(address, "GET", "/", None, **bearer)[0] == 200


def test_a_client_that_asks_for_nothing_is_left(
    seen: Seen, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(LocalHandler, "timeout", 0.1)
    with serving(seen.watch, "127.0.0.1", 0, "secret") as address:
        port = int(address.split(":")[2].partition("/")[0])
        with create_connection(("127.0.0.1", port), 20) as silent:
            silent.sendall(b"POST /send HTTP/1.1")
            assert silent.recv(1) == b""


def test_clients_that_leave_or_wait_disturb_nobody(
    seen: Seen, capsys: pytest.CaptureFixture[str]
) -> None:
    with serving(seen.watch, "127.0.0.1", 0, "secret") as address, ExitStack() as waiting:
        port = int(address.split(":")[2].partition("/")[0])
        for _ in range(60):
            waiting.enter_context(create_connection(("127.0.0.1", port), 20))
        for _ in range(5):
            leaving = create_connection(("127.0.0.1", port), 20)
            leaving.setsockopt(SOL_SOCKET, SO_LINGER, struct.pack("ii", 1, 0))
            leaving.sendall(b"GET / HTTP/1.1\r\n")
            leaving.close()
        assert ask(address, "GET", "/", None, Authorization="Bearer secret")[0] == 200
    assert capsys.readouterr().err == ""


class Shape:
    """A message as ROS makes them: numbers are kept in an array, and each is checked."""

    def __init__(self) -> None:
        self._sides = array("d")

    def get_fields_and_field_types(self) -> dict[str, str]:
        return {"sides": "sequence<double>"}

    @property
    def sides(self) -> Any:
        return self._sides

    @sides.setter
    def sides(self, value: Any) -> None:
        assert all(isinstance(each, float) for each in value)
        self._sides = array("d", value)


def test_arrays_of_numbers_are_filled() -> None:
    assert fill(Shape(), {"sides": []}).sides == array("d")
    assert fill(Shape(), {"sides": [1, 2.5]}).sides == array("d", [1.0, 2.5])
    for wrong in (["one"], "one", 1):
        with pytest.raises(ValueError, match="sequence<double>"):
            fill(Shape(), {"sides": wrong})


def test_what_cannot_be_sent_is_told(seen: Seen) -> None:
    watch = seen.watch
    with pytest.raises(NotSentError, match="robots of a trace hear nothing"):
        watch.send("Abort", {})

    def refuse(event: OperatorEvent, fields: Mapping[str, Any]) -> int:
        raise NotSentError(f"no node listens to `{event.name}`")

    watch.send_with(refuse)
    with serving(watch, "127.0.0.1", 0, None) as address:
        for asked, reason in (
            ({"event": "Found"}, "no person may send `Found`"),
            ({"event": "Abort"}, "no node listens to `Abort`"),
            ({"event": "Visit", "data": 3}, "`data` has the fields of a message"),
            ([], "this is no event"),
        ):
            status, answer = ask(address, "POST", "/send", asked)
            assert status == 200
            assert reason in json.loads(answer)["failed"]
    assert watch.head()["sent"] == []


@pytest.fixture
def page(browser: Any) -> Iterator[Any]:
    """A tab, in which nothing may go wrong."""
    page = browser.new_page()
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("console", lambda message: wrong.append(message.text))
    yield page
    page.close()
    assert wrong == []


def test_a_person_sees_robots_and_steers_them(seen: Seen, page: Any, tmp_path: Path) -> None:
    def send(event: OperatorEvent, fields: Mapping[str, Any]) -> int:
        seen.sent.append((event.name, fields))
        return 2

    seen.watch.send_with(send)
    trace = tmp_path / "run.jsonl"
    trace.touch()
    follow_trace(str(trace), seen.watch, lambda report: None)
    with serving(seen.watch, "127.0.0.1", 0, "secret") as address:
        page.goto(address)
        page.wait_for_selector("html[data-ready]", state="attached")
        assert "secret" not in page.url
        page.locator("tr.expected", has_text="robot[1]not seen yet").wait_for()
        buttons = page.locator("#operate button")
        assert buttons.all_text_contents() == ["Abort", "Visit"]
        assert buttons.nth(0).get_attribute("title") == "Land at once."
        lines = (
            line(0, "robot[0]", None, "Off"),
            line(2000, "robot[0]", "Visit", "On", taken=["Off->0"], exited=["Off"]),
        )
        with trace.open("a", encoding="utf-8") as file:
            file.writelines(f"{each}\n" for each in lines)
        row = page.locator("tr.there[data-robot='robot[0]']")
        row.get_by_text("0:02.000 Visit").wait_for()
        assert row.get_by_text("On").count() == 1
        # The place of the transition is in the model, which is shown.
        row.get_by_role("button", name="model.swarm:10").click()
        page.locator(".text .marked", has_text="on Visit -> On").wait_for()
        page.get_by_label("message of Visit").fill('{"x": 2.5, "note": "north"}')
        buttons.nth(1).click()
        page.get_by_text("Visit: sent to 2 nodes").wait_for()
        buttons.nth(0).click()
        page.get_by_text("Abort: sent to 2 nodes").wait_for()
        assert seen.sent == [("Visit", {"x": 2.5, "note": "north"}), ("Abort", {})]
        seen.clock.now = 1.0
        with seen.watch.noting() as standing:
            standing.beat("robot[0]")
        seen.clock.now = 9.0
        with seen.watch.noting():
            pass
        page.locator("tr.lost[data-robot='robot[0]']").wait_for()
        page.get_by_role("alert").get_by_text("robot[0] is lost").wait_for()
        # The lane says that the state is the last one known.
        lane = page.get_by_role("button", name="robot[0] lost, was in On")
        lane.wait_for(state="attached")
        with seen.watch.noting() as standing:
            standing.beat("robot[0]")
        page.get_by_role("button", name="robot[0] On", exact=True).wait_for(state="attached")
