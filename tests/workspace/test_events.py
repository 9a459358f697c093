"""Edits of events alone: machines keep their trees, and all is said as by a first run."""

import gc
import random
import re
from pathlib import Path

import pytest

from swarmdsl import driver
from swarmdsl.analysis.checks import check_with_events
from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.workspace import Workspace
from swarmdsl.lowering import lower
from swarmdsl.syntax.ast import StateMachine

SETTINGS = Settings(levels={"unused-declaration": Level.WARN, "unsent-event": Level.WARN})
EVENTS = """\
package site.events
swarm event Start : std_msgs/Empty
swarm event Stop : std_msgs/Empty { best effort }
event Low : sensor_msgs/BatteryState
swarm event Found : geometry_msgs/PoseStamped
"""
MODEL = """\
package site
import "events.swarm"
/// Start is mentioned in this comment.
statemachine Noted { initial A; state A { on Start -> B } final B }
statemachine Tell {
  initial A
  state A { after 1 s / send Start, send Found -> B }
  state B { on Stop -> C; on Low [event.percentage < 0.5] -> C; after 5 s -> A }
  final C
}
statemachine Hear {
  param low : float64 = 1.0
  var x : float64 = 0.0
  initial A
  state A { defer Stop; on Start -> B; on site.events.Start -> C; on site.events.Stop -> C }
  state B { on Found / x = event.pose.position.x -> C; on Stop, Low -> C }
  final C
}
statemachine Around { initial A; state A = Hear(low = 2.0) { on done -> B; on Stop -> B } final B }
statemachine Wrong {
  initial A
  state A { on Sttart -> B; on Stop [nothing > 1] -> Nowhere; on Found [event.x > 1] -> B }
  final B
}
statemachine Plain { initial A; state A { on Stop -> B; on Strt -> B } final B }
member Teller { behavior Tell }
member Hearer { param low : float64 = 2.0; behavior Around }
member Other { behavior Plain }
swarm Site { teller : Teller[2]; hearer : Hearer[1]; other : Other[1] }
property Heard of Site : Stop leads to no teller in B within 5 s
"""
_DECLARATIONS = (
    *("swarm event Start : std_msgs/Empty\n", "event Start : std_msgs/String\n"),
    *("swarm event Sttart : std_msgs/Empty\n", "event Stop : site_msgs/Gone\n"),
    *("swarm event Strt : std_msgs/Empty { reliable }\n", "event Found : std_msgs/Empty\n"),
)


def edited(text: str, dice: random.Random) -> str:
    """Change the declaration of one event."""
    lines = text.splitlines(keepends=True)
    at = dice.randrange(1, len(lines)) if len(lines) > 1 else 1
    match dice.randrange(5):
        case 0:
            lines.insert(at, dice.choice(_DECLARATIONS))
        case 1 if len(lines) > 2:
            del lines[at]
        case 2:
            return EVENTS
        case _ if at < len(lines):
            words = ("Start", "Stop", "Low", "Found", "Startt", "Sto", "Strt", "A", "Hear")
            new = f"event {dice.choice(words)} "
            lines[at] = re.sub(r"event \w+ ", new, lines[at])
    return "".join(lines)


def plain(found) -> tuple[object, ...]:
    at = found.primary.span if found.primary is not None else None
    places = [(each.span.source.name, each.span.start, each.message) for each in found.related]
    where = (at.source.name, at.start, at.end) if at is not None else None
    return found.name, found.message, where, found.help, found.notes, places


@pytest.mark.parametrize("seed", range(2))
def test_same_diagnostics_as_a_first_run(seed: int, tmp_path: Path) -> None:
    dice = random.Random(seed)
    texts = {tmp_path / "events.swarm": EVENTS, tmp_path / "model.swarm": MODEL}
    if seed % 2:  # all in one file
        together = EVENTS.partition("\n")[2] + MODEL.partition("\n")[2].partition("\n")[2]
        texts = {tmp_path / "one.swarm": "package site\n" + together}
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    workspace = Workspace([tmp_path], SETTINGS)
    path, original = next(iter(texts.items()))
    head, _, rest = original.partition("/// Start is")
    text, kept = head, 0
    for _ in range(40):
        text = head if dice.random() < 0.1 else edited(text, dice)
        whole = text + ("/// Start is" + rest if rest else "")
        path.write_text(whole, encoding="utf-8")
        before = machines(workspace)
        workspace.update({path: whole})
        kept += len(before & machines(workspace))
        fresh = pipeline.check([tmp_path], SETTINGS)
        assert list(map(plain, workspace.report)) == list(map(plain, fresh.report)), whole
        if fresh.valid is not None:
            assert lower(workspace.project) == fresh.system
    assert kept > 80  # most edits do not read all machines again


def machines(workspace: Workspace) -> set[StateMachine]:
    found = (node for _, node in workspace.project.declarations())
    return {node for node in found if isinstance(node, StateMachine)}


def test_typed_name_keeps_machines_and_memory(tmp_path: Path) -> None:
    file = tmp_path / "model.swarm"
    machine = "statemachine M{0} {{ initial A; state A {{ on Start -> B }} final B }}\n"
    body = "".join(map(machine.format, range(60)))
    word = "swarm event Start"
    file.write_text(f"{word} : std_msgs/Empty\n{body}", encoding="utf-8")
    workspace = Workspace([file])
    first = machines(workspace)
    gc.collect()
    before = len(gc.get_objects())
    for _ in range(3):
        for end in (*range(len(word), 12, -1), *range(13, len(word) + 1)):
            workspace.update({file: f"{word[:end]} : std_msgs/Empty\n{body}"})
            wrong = [each.name for each in workspace.report]
            assert wrong == ["unresolved-name"] * (0 if end == len(word) else 60)
    assert machines(workspace) == first
    gc.collect()
    # What remains of 60 edits is less than a tenth of what one of them would leave.
    assert len(gc.get_objects()) - before < 600


DATA = "struct Data {{ x : {0} }}\n"
READER = """\
swarm event {0} : Data
statemachine M {{ initial A; state A {{ on Start [event.x > 1] -> B; on Start -> A }} final B }}
"""


def test_machine_is_checked_once_for_each_meaning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked: list[object] = []

    def counted(*given: object) -> None:
        checked.extend(each for each in given if isinstance(each, StateMachine))
        check_with_events(*given)  # type: ignore[arg-type]

    monkeypatch.setattr(driver.workspace, "check_with_events", counted)
    file = tmp_path / "model.swarm"
    file.write_text(DATA.format("float64") + READER.format("Start"), encoding="utf-8")
    workspace = Workspace([file])

    def after(name: str, type_: str = "float64") -> tuple[list[str], int]:
        checked.clear()
        workspace.update({file: DATA.format(type_) + READER.format(name)})
        return [each.name for each in workspace.report], len(checked)

    lost = ["unresolved-name"] * 2
    assert after("Star") == (lost, 1)
    assert after("Start") == ([], 0)
    assert after("Star") == (lost, 0)
    # What the event depends on is another one now.
    assert after("Star", "string")[0] == lost
    assert after("Start", "string") == (["bad-operand"], 1)
