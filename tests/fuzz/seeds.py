"""Correct documents of all kinds, about one small model."""

from __future__ import annotations

MODEL = """package sar
import ros "lamp_msgs"
message lamps/Level { value : float64, names : string[] }
enum Mode : int32 { OFF = 1, ON }
event Go : lamps/Level
event Stop : std_msgs/Empty
event Back : std_msgs/Empty
const LIMIT : float64 = 2.5
function blink : abstraction { action "cmd/blink" : lamp_msgs/Blink }
statemachine Blinking {
  param count : int32 = 3
  var level : float64 = 0.5
  initial Off
  state Off { on Go [level < LIMIT] / level = event.value -> Blink }
  state Blink {
    do blink(times = count)
    after 2 s -> Off
    on succeeded -> Off
    on aborted -> End
    on Stop -> End
  }
  final End
}
member Blinker { behavior Blinking }
swarm Lamps { lamp : Blinker[3] }
"""
PROJECT = """[project]
name = "lamps"
sources = ["model.swarm"]
libraries = ["lamp_msgs"]

[targets.scxml]
profile = "portable"

[targets.smach]

[lint]
warn = ["unused-declaration"]
allow = ["naming-style"]

[build]
out = "out"
"""
SCENARIO = """seed = 7
until = "5 s"

[network]
latency = { uniform = ["1 ms", "20 ms"] }
loss = 0.1

[functions.blink]
duration = { normal = ["2 s", "500 ms"] }
aborted = 0.25
results = [{}]

[[messages]]
event = "Go"
at = "1 s"
every = "2 s"
data = { value = 1.5, names = ["a"] }

[[faults]]
at = "3 s"
lost = "lamp[1]"
"""
TESTS = """swarm = "Lamps"

[[test]]
name = "blinks"
seeds = 2
steps = [
  { send = "Go", data = { value = 1.0 } },
  { in = "Blink", within = "1 s" },
  { pass = "2 s" },
  { in = "Off", within = "1 s" },
  { no = "lamp", starts = "blink" },
]
"""
SCXML = """<?xml version="1.0" encoding="UTF-8"?>
<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript" initial="A">
  <datamodel>
    <data id="x" expr="0"/><data id="s" expr="'a'"/><data id="l" expr="[1, 2]"/>
  </datamodel>
  <state id="A" initial="A1">
    <onentry>
      <assign location="x" expr="x + 1"/>
      <send event="tick" delay="500ms" id="t"><param name="p" expr="x"/></send>
      <if cond="x &lt; 5"><raise event="low"/><elseif cond="x == 7"/><log expr="s"/><else/>
      <foreach array="l" item="i" index="n"><assign location="x" expr="x + i"/></foreach></if>
    </onentry>
    <state id="A1"><transition event="tick" cond="x &lt; 9" target="A2"/></state>
    <state id="A2">
      <transition event="low" target="A1"/><transition event="tick" target="P"/>
    </state>
    <history id="H" type="deep"><transition target="A1"/></history>
    <transition event="error.*" target="F"/>
  </state>
  <parallel id="P">
    <state id="P1"><onexit><cancel sendid="t"/></onexit></state>
    <state id="P2"><transition event="tick" target="H"/></state>
    <transition event="stop" target="F"><script>x = 3</script></transition>
  </parallel>
  <final id="F"><donedata><content expr="x"/></donedata></final>
</scxml>
"""
OLD_SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="Idle">
  <datamodel><data id="adf"><path>blink.json</path></data></datamodel>
  <state id="Idle"><transition event="missionStart" target="Blink"/></state>
  <state id="Blink">
    <datamodel><data id="type">abstraction</data></datamodel>
    <invoke id="blink" type="ROS_ACTION" src="blink">
      <param name="id" expr="_event.data.id"/>
      <content><goal><int32 name="n">3</int32></goal></content>
    </invoke>
    <transition event="blink.succeeded" target="Idle"/>
    <transition event="blink.aborted" target="End"/>
  </state>
  <final id="End"/>
</scxml>
"""
ADF = """{"functions": [{"name": "blink", "description": "Blink", "category": "abs",
 "api": {"comm_model": {"paradigm": "rosaction", "definition": {"name": "cmd/blink",
  "class": "lamp_msgs/Blink", "goal": {"fields": [{"name": "times", "class": "int32"}]},
  "result": {"fields": []}, "feedback": {"fields": [{"name": "level", "class": "float32[3]"}]}}},
  "inputs": [{"topic": "power", "msg": {"class": "std_msgs/Bool", "fields": [],
   "constants": [{"name": "ON", "class": "bool", "value": true}]}}],
  "outputs": [{"topic": "light", "msg": {"class": "lamps/Level"}}],
  "dependencies": [{"topic": "pose", "msg": {"class": "Pose"}}]},
 "param_list": [{"name": "rate", "class": "number", "value": 1.5, "description": "Hz"}]}],
 "sensors/actuators": [{"name": "eye", "category": "sensor", "api": {"services": [],
  "outputs": [{"topic": "image", "msg": {"class": "sensor_msgs/Image"}}]}}]}
"""
EVENTS = """{"event": "Go", "after": 100, "data": {"value": 1.5, "names": ["a"]}}
{"event": "Go"}
{"event": "Stop", "after": 300, "member": "lamp[0]"}
"""
TRACE = """{"t": 0, "member": null, "event": null, "taken": [], "exited": [], "entered": ["Off"], \
"started": [], "cancelled": [], "sent": [], "configuration": ["Off"]}
{"t": 100, "member": null, "event": "Go", "data": {"value": 1.5, "names": []}, "taken": ["Off.1"], \
"exited": ["Off"], "entered": ["Blink"], "started": ["blink"], "cancelled": [], "sent": [], \
"configuration": ["Blink"]}
"""
PARAMETERS = """# Settings.

rate: 10.5  # in Hz
name: 'lamp'
modes: [1, 2, 3]
pid: {p: 1.0, i: 0.5, d: -2e-3}
limits:
  low: 0
  high: 0x1F
/**:
  ros__parameters:
    use_sim_time: true
    when: 2001-01-01
text: |
  some
  lines
other: "a \\u00e9 b"
"""
MESSAGE = """# A level.
uint8 OFF=0
string NAME="lamp"  # quoted
std_msgs/Header header
float64 value 1.5  # the value
int32[<=4] numbers [1, 2]
string<=10 name "a"
"""
SERVICE = "int32 a\n---\nbool ok\nstring reason\n"
ACTION = "int32 times\n---\nbool ok\n---\nfloat32 level\n"
MANIFEST = '<?xml version="1.0"?>\n<package format="3"><name>lamp_msgs</name></package>\n'

FILES = {
    "model.swarm": MODEL,
    "swarm.toml": PROJECT,
    "scenario.toml": SCENARIO,
    "lamps.swarmtest.toml": TESTS,
    "machine.scxml": SCXML,
    "old.xml": OLD_SCXML,
    "blink.json": ADF,
    "events.jsonl": EVENTS,
    "trace.jsonl": TRACE,
    "lamp_msgs/package.xml": MANIFEST,
    "lamp_msgs/config/lamp.yaml": PARAMETERS,
    "lamp_msgs/msg/Level.msg": MESSAGE,
    "lamp_msgs/srv/Ask.srv": SERVICE,
    "lamp_msgs/action/Blink.action": ACTION,
}
