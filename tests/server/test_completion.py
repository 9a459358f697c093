"""Tests of completion, mostly in incomplete text."""

import pytest

from swarmdsl.ide.server.completion import completions
from swarmdsl.ide.server.models import Models

HEAD = """\
package here

enum Mode {
  SLOW
  FAST
}
const MOST : int32 = 5
event Low : std_msgs/Empty on "low"
event High : std_msgs/Empty on "high"
function go : abstraction { action "go" : some_msgs/Go }
sensor Camera {
  out image : sensor_msgs/Image on "image"
  param rate : float64 = 1.0
}
controller Tracker {
  in picture : sensor_msgs/Image
}
statemachine Other {
  param speed : float64
  initial Only
  state Only { do go; on succeeded -> End }
  final End
}
"""
WORK = """\
action here_msgs/Sweep {
  goal { speed : float64 area : geometry_msgs/Pose }
  result { found : bool place : geometry_msgs/Point }
}
message here_msgs/Seen { id : string place : geometry_msgs/Point }
struct Spot { x : float64 y : float64 }
event Seen : here_msgs/Seen
function sweep : abstraction { action "sweep" : here_msgs/Sweep }
actuator Arm {
  param force : float64
  param reach : float64
  operation grip(in width : float64, out held : bool)
}
member Robot { arm : Arm behavior Worker }
statemachine Worker {
  var spot : Spot
  var seen : bool
  initial Work
  state Work {
    do sweep(speed = 1.0, area = nothing)
    on succeeded [seen] -> Over
    on aborted -> Over
    HERE
  }
  final Over
}
"""
STATES = """\
statemachine Machine {
  param limit : int32 = 3
  var count : int32 = 0
  initial First
  state First {
    initial Inner
    state Inner { on Low -> Done }
    final Done
    HERE
  }
  parallel state Both {
    region Left { initial L; state L { on Low -> Ready } final Ready }
    region Right { initial R; state R { on High -> Set } final Set }
    on done -> Last
  }
  final Last
}
"""
VERTICES = {"First", "Both", "Last", "Inner", "Done"}
ITEMS = {"do", "on", "after", "state", "entry", "exit", "final", "choice", "history", "initial"}
DECLARATIONS = {"event", "statemachine", "member", "swarm", "enum", "function", "sensor"}


def state(line):
    return HEAD + STATES.replace("HERE", line)


def work(line, instead="HERE"):
    return HEAD + WORK.replace(instead, line).replace("HERE", "")


FITNESS = """\
member Car { param speed : float64 = 1.0; behavior Other }
swarm S { car : Car[2]; fitness F }
fitness F {
  """
FOUND = HEAD + "message Seen { x : float64, mode : Mode }\nswarm event Found : Seen\n"
DO = "do sweep(speed = 1.0, area = nothing)"
SPACE = """\
environment Field {
  area meadow : (0 m, 0 m) .. (5 m, 5 m)
  target person at random in meadow
}
environment Town { area square : (0 m, 0 m) .. (5 m, 5 m) }
action Fly { goal { height : float64 in m } }
"""
PLACES = {
    "area where a role starts": (
        HEAD + SPACE + "member Car { } swarm S { environment Field car : Car in | }",
        {"meadow"},
        {"square", "person", "Field"},
    ),
    "area of targets": (
        HEAD + SPACE + "environment Here { area yard : (0 m, 0 m) .. (5 m, 5 m)\n"
        "target dog at random in | }",
        {"yard"},
        {"square", "meadow"},
    ),
    "target of a sensor": (
        HEAD + SPACE + "sensor Eye { senses | { range = 5 m } }",
        {"person"},
        {"meadow"},
    ),
    "setting of a sensor": (
        HEAD + SPACE + "sensor Eye { senses person { range = 5 m, | } }",
        {"view", "miss"},
        {"range", "mass"},
    ),
    "setting of a body": (HEAD + "member Car { body { | } }", {"mass", "speed"}, {"range"}),
    "model of a function": (
        HEAD + SPACE + "function fly : swarm { action \"fly\" : Fly\nmodel | }",
        {"go_to", "coverage"},
        {"height"},
    ),
    "argument of a model": (
        HEAD + SPACE + "function fly : swarm { action \"fly\" : Fly\nmodel coverage(|) }",
        {"height", "width"},
        {"coverage"},
    ),
    "value of an argument of a model": (
        HEAD + SPACE + "function fly : swarm { action \"fly\" : Fly\nmodel coverage(width = |) }",
        {"height", "MOST"},
        {"meadow"},
    ),
    "role of a measure in space": (
        HEAD + SPACE + "member Car { } swarm S { car : Car  fitness F }\n"
        "fitness F { in way : float64 in m = distance(|) }",
        {"car"},
        {"person"},
    ),
    "target of a measure in space": (
        HEAD + SPACE + "member Car { } swarm S { car : Car  fitness F }\n"
        "fitness F { in seen : uint32 = found(|) }",
        {"person"},
        {"car"},
    ),
    "param of a role": (
        HEAD + WORK + "member Car { param length : int32 } swarm S { car : Car { | } }",
        {"length"},
        {"force", "car"},
    ),
    "param of a robot": (
        HEAD + WORK + "member Car { param length : int32 } swarm S { car : Car  car[0] { | } }",
        {"length"},
        {"force", "car"},
    ),
    "field of a goal": (work("do sweep(|)", DO), {"speed", "area", "by"}, {"found", "spot"}),
    "field that is left": (work("do sweep(speed = 1.0, |", DO), {"area"}, {"speed", "found"}),
    "field before another": (work("do sweep(| area = nothing)", DO), {"speed"}, {"area", "found"}),
    "half a field": (work("do sweep(sp|)", DO), {"speed", "area"}, {"found"}),
    "value of a field": (work("do sweep(speed = |)", DO), {"spot", "seen"}, {"area", "sweep"}),
    "field of a result": (work("do sweep gives (|)", DO), {"found", "place"}, {"speed", "spot"}),
    "where a result goes": (work("do sweep gives (found => |)", DO), {"seen"}, {"found", "place"}),
    "operation of a part": (work("do arm.|", DO), {"grip"}, {"sweep", "arm", "force"}),
    "parameter of an operation": (work("do arm.grip(|)", DO), {"width"}, {"held", "force"}),
    "function or part": (work("do |", DO), {"go", "sweep", "arm"}, {"grip", "Work"}),
    "outcomes that are left": (work("on |"), {"succeeded", "preempted", "Low"}, {"aborted"}),
    "field of an event": (work("on Seen [event.|"), {"id", "place"}, {"spot", "x"}),
    "field of self": (
        work("on Seen [self.|"), {"id", "role", "index", "count"}, {"spot", "place"},
    ),
    "field of a swarm event": (
        work("on Seen [event.|").replace("event Seen", "swarm event Seen"),
        {"id", "place", "sender", "sent"}, {"spot", "x"},
    ),
    "field of a robot's event": (work("on Seen [event.|"), {"id"}, {"sender", "sent"}),
    "address": (
        work("on Low / send Seen to |") + "swarm S { lead : Robot; rest : Robot[2] }",
        {"lead", "rest", "spot"}, {"Robot", "Work"},
    ),
    "address in a swarm that runs it": (
        work("on Low / send Seen(id = \"a\") to r|")
        + "member Other { }  swarm T { base : Other }  swarm S { rest : Robot[2] }",
        {"rest"}, {"base"},
    ),
    "role of one robot": (
        work("on Low / send Seen to |[0]") + "swarm S { rest : Robot[2] }", {"rest"}, {"Low"},
    ),
    "counted role": (
        work("on Low [present(|) > 1]") + "swarm S { lead : Robot; rest : Robot[2] }",
        {"lead", "rest"}, {"spot", "Low"},
    ),
    "event of members": (work("on |"), {"Seen", "Low", "member_lost", "member_joined"}, {"spot"}),
    "deferred event of members": (work("defer me|"), {"Seen", "member_lost"}, {"spot"}),
    "declared event of members": (
        work("on member|") + "event member_lost : std_msgs/Empty", {"member_lost"}, {"spot"},
    ),
    "behind an event to send": (work("on Low / send Seen |"), {"to"}, {"spot"}),
    "self": (work("on Seen [|"), {"self", "event"}, {"id"}),
    "field of a field": (work("on Seen [event.place.|] -> Over"), {"x", "y", "z"}, {"id"}),
    "field of a struct": (work("on Low / spot.|"), {"x", "y"}, {"z", "id"}),
    "field of a sent event": (work("on Low / send Seen(|)"), {"id", "place"}, {"spot"}),
    "param of a machine": (
        HEAD + STATES.replace("HERE", "state Sub = Other(|)"), {"speed"}, {"Low"},
    ),
    "param of a part": (
        HEAD + WORK.replace("arm : Arm", "arm : Arm { | }"), {"force", "reach"}, {"Arm"},
    ),
    "param that is left": (
        HEAD + WORK.replace("arm : Arm", "arm : Arm { force = 1.0 | }"), {"reach"}, {"force"},
    ),
    "param before another": (
        HEAD + WORK.replace("arm : Arm", "arm : Arm { | force = 1.0 }"), {"reach"}, {"force"},
    ),
    "action": (
        HEAD + 'function f : swarm { action "x" : |', {"tf2_msgs/LookupTransform"}, {"Mode"},
    ),
    "type of a package": (HEAD + "event E : geometry_msgs/|", {"Pose", "Twist"}, {"Mode", "int32"}),
    "type of ROS": (HEAD + "event E : |", {"geometry_msgs/Pose"}, {"std_srvs/Empty", "string"}),
    "nothing": ("|", {"package", "import", *DECLARATIONS}, {"on"}),
    "half a declaration": ("sta|", {"statemachine"}, {"on"}),
    "below the package": ("package p\n|", {"import", *DECLARATIONS}, set()),
    "behind declarations": (HEAD + "|", DECLARATIONS, {"package", "import", "on"}),
    "between declarations": (HEAD.replace("event High", "|\nevent High"), DECLARATIONS, {"on"}),
    "type of an event": (
        HEAD + "struct Spot { x : float64 }\nevent E : |", {"Spot"}, {"Mode", "int32", "on"},
    ),
    "half a type": (HEAD + "const E : Mo|", {"Mode"}, {"Low"}),
    "behind a type": (HEAD + "event E : Mode |", {"on"}, {"Mode"}),
    "category": (HEAD + "function f : |", {"abstraction", "swarm"}, {"Low"}),
    "in a function": (HEAD + "function f : abstraction { | }", {"action", "param"}, {"on"}),
    "in a component": (HEAD + "sensor S {\n  |\n}", {"in", "out", "param", "operation"}, {"on"}),
    "base": (HEAD + "sensor S extends | {\n}", {"Camera", "Tracker"}, {"Low"}),
    "in a member": (HEAD + "member M {\n  |\n}", {"behavior", "connect", "param"}, {"on"}),
    "behavior": (HEAD + "member M { behavior | }", {"Other"}, {"Camera", "Low"}),
    "behavior, nothing closed": (HEAD + "member M { behavior |", {"Other"}, {"Camera"}),
    "component of a part": (HEAD + "member M { cam : | }", {"Camera", "Tracker"}, {"Other"}),
    "source of a connector": (
        HEAD + "member M { cam : Camera t : Tracker\n  connect | }", {"cam", "t"}, {"Camera"},
    ),
    "port of a part": (
        HEAD + "member M { cam : Camera t : Tracker\n  connect cam.| }", {"image"}, {"cam", "rate"},
    ),
    "target of a connector": (
        HEAD + "member M { cam : Camera t : Tracker\n  connect cam.image -> t.| }",
        {"picture"}, {"image"},
    ),
    "role": (HEAD + "member M { behavior Other }\nswarm S { r : | }", {"M"}, {"Other"}),
    "in a swarm": (HEAD + "swarm S {\n  |\n}", {"environment", "fitness"}, {"on"}),
    "in a state machine": (
        HEAD + "statemachine M {\n  |\n}", {"param", "var", "initial", "state", "final"}, {"on"},
    ),
    "initial": (HEAD + STATES.replace("initial First", "initial |"), {"First", "Both"}, {"Inner"}),
    "in a state": (state("|"), ITEMS, {"param", "Low"}),
    "half a keyword": (state("o|"), {"on"}, {"Low"}),
    "region that ends": (
        state("").replace("on done -> Last", "on |.done -> Last"),
        {"Left", "Right"}, {"Low", "First"},
    ),
    "behind a region": (
        state("").replace("on done -> Last", "on Left.| -> Last"), {"done"}, {"Low", "Left"},
    ),
    "in a number": (state("on Low / count = 1.|5"), set(), {"count"}),
    "trigger": (state("on |"), {"Low", "High", "done"}, {"on", "go", "First", "succeeded"}),
    "half a trigger": (state("on Lo|"), {"Low"}, {"First"}),
    "behind a trigger": (state("on Low |"), set(), {"Low", "First"}),
    "second trigger": (state("on Low, |"), {"High", "done"}, {"First"}),
    "target": (state("on Low -> |"), VERTICES, {"Low", "on", "L"}),
    "half a target": (state("on Low -> La|"), VERTICES, {"Low", "on"}),
    "target of a path": (state("on Low -> First.|"), {"Inner", "Done"}, {"First", "Low"}),
    "guard": (
        state("on Low [| ] -> Last"), {"count", "MOST", "Mode", "not", "round"}, {"Low", "go"},
    ),
    "open guard": (state("on Low [|"), {"count", "limit", "MOST", "Mode", "not"}, {"Low", "go"}),
    "value of an enum": (state("on Low [Mode.|"), {"SLOW", "FAST"}, {"count", "Low"}),
    "behind an operand": (state("on Low [count |"), {"and", "or"}, {"count"}),
    "second operand": (state("on Low [count < |"), {"limit", "MOST"}, {"Low"}),
    "effect": (state("on Low / |"), {"send", "count"}, {"Low", "First", "round"}),
    "assigned value": (state("on Low / count = | -> Last"), {"count", "limit"}, {"Low"}),
    "second effect": (state("on Low / count = 1,\n      | -> Last"), {"count"}, {"Low", "First"}),
    "effect on a line of its own": (state("entry / count = 1,\n      |"), {"count"}, {"Low"}),
    "sent event": (state("on Low / send |"), {"Low", "High"}, {"count", "First"}),
    "function": (state("do |"), {"go"}, {"Low", "Other"}),
    "final state": (state("on done.|"), {"Done"}, {"Last", "Low"}),
    "machine that is reused": (state("state Sub = |"), {"Other"}, {"First", "Low"}),
    "target in a broken file": (
        HEAD.replace("abstraction {", "abstraction [") + STATES.replace("HERE", "on Low -> |"),
        {"First", "Last"}, {"Low"},
    ),
    "target below another mistake": (
        state("on on on\n    on Low -> |"), {"First", "Last"}, {"Low", "on"},
    ),
    "tested state": (state("on Low [in(|)] -> Last"), {"First", "Inner"}, {"Low", "limit"}),
    "tested state inside": (state("on Low [not in(First.|"), {"Inner", "Done"}, {"Last", "count"}),
    "role of a measure": (HEAD + FITNESS + "in x : uint32 = count(|) }", {"car"}, {"Only", "go"}),
    "state of a measure": (
        HEAD + FITNESS + "in x : uint32 = count(car in |) }", {"Only", "End"}, {"car", "go"},
    ),
    "state of a measure of each robot": (
        HEAD + FITNESS + "in x : duration = max each car : time(in |) }", {"Only"}, {"car"},
    ),
    "event of a measure": (
        HEAD + FITNESS + "in x : uint32 = total(car sends |) }", {"Low", "High"}, {"car", "Only"},
    ),
    "measure": (
        HEAD + FITNESS + "in x : uint32 = | }",
        {"count", "total", "time", "mean", "min", "max", "sum"}, {"maximize"},
    ),
    "swarm of a fitness": (HEAD + FITNESS + "} fitness G of |", {"S"}, {"Other"}),
    "role of a property": (HEAD + FITNESS + "} property P : no |", {"car"}, {"Only"}),
    "function of a property": (
        HEAD + FITNESS + "} function dig : abstraction {} property P : each car : never ends |",
        {"dig"}, {"Only", "car", "succeeded"},
    ),
    "outcome of a property": (
        HEAD + FITNESS + "} property P : each car : never ends dig as |",
        {"succeeded", "aborted", "preempted"}, {"Only", "car"},
    ),
    "state of a property": (
        HEAD + FITNESS + "} property P : each car : never in |", {"Only", "End"}, {"car"},
    ),
    "condition on a message": (
        FOUND + FITNESS + "} property P : each car : hears Found [|", {"event", "speed", "MOST"},
        {"Only", "Found"},
    ),
    "field of a message in a property": (
        FOUND + FITNESS + "} property P : some car sends Found [event.|",
        {"x", "mode"}, {"car", "sender", "MOST"},
    ),
    "field of a heard message": (
        FOUND + FITNESS + "} property P : each car : never hears Found [event.x > 3 and event.|",
        {"x", "mode", "sender", "sent"}, {"car", "speed"},
    ),
    "field of a message in a measure": (
        FOUND + FITNESS + "in x : uint32 = total(car hears Found [event.|]) }",
        {"x", "mode", "sender"}, {"car", "Low"},
    ),
    "below a mistake": (state("on on on\n    |"), ITEMS, {"event", "statemachine"}),
    "field behind a mistake": (
        work("on Low -> Overdo sweep(|)", DO), {"speed"}, {"action", "state", "on"},
    ),
    "comment": (state("// on |"), set(), {"on", "Low", "First"}),
    "text": (HEAD + 'event E : Mode on "|', set(), {"on", "Mode"}),
    "documentation": (HEAD + "/// sta|", set(), {"statemachine"}),
}  # fmt: skip


@pytest.mark.parametrize("place", PLACES)
def test_completions(place, tmp_path):
    text, wanted, unwanted = PLACES[place]
    offset = text.index("|")
    path = tmp_path / "model.swarm"
    models = Models([tmp_path])
    models.edit(path, text.replace("|", "", 1))
    workspace, file = models.file(path)
    found = [each.word for each in completions(workspace, file, offset)]
    assert len(found) == len(set(found))
    assert wanted - set(found) == set()
    assert unwanted & set(found) == set()
    if not wanted:
        assert found == []
