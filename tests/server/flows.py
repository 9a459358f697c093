"""Model as a user types it: `«typed|completed»` marks where a list helps."""

from __future__ import annotations

import re
from typing import NamedTuple

FUNCTIONS = """\
package patrol.flying

/// Rise to a height.
function take_off : abstraction { action "take_off" : patrol_msgs/TakeOff }
action patrol_msgs/TakeOff { goal { altitude : float64 } result { reached : bool } }
function land : abstraction { service "land" : std_srvs/Empty }
function tidy : abstraction { service "tidy" : std_srvs/Empty }
"""
MARKED = """\
package patrol
«import cpswarm.e|vents.*»
«import "f|lying.swarm»"

enum Mode {
  SLOW
  FAST
}
const DEFAULT_HEIGHT : float64 = 2.5
event Start : std_msgs/Empty on "start"
event Stop «: s|td_msgs/Empty» on "stop"
event TargetSeen : std_msgs/String on "seen"
swarm event MissionDone : std_msgs/Empty

sensor Camera {
  out image : sensor_msgs/Image
}
controller Tracker {
  in picture : sensor_msgs/Image
}

statemachine Patrol {
  param height : float64 «= D|EFAULT_HEIGHT»
  var mode «: M|ode» = Mode.SLOW
  var seen : string
  var high : bool
  «initial I|dle»

  state Idle {
    «on S|tart» -> Rise
  }
  state Rise {
    «do ta|ke_off»(altitude = height) gives (reached => high)
    «on su|cceeded» -> Watch
    on aborted «-> H|ome»
  }
  state Watch {
    «do l|and»
    on TargetSeen [seen == ""] / mode «= M|ode.FAST» -> Dock
    «on T|argetSeen» / seen = event.data
    on Start«, M|issionDone» -> Home
    on succeeded «[h|igh»] -> Dock
    on succeeded, aborted -> Home
    on Stop / «send M|issionDone» -> Home
    «after 5 m|in» -> Home
  }
  «state D|ock»
  {
    on Start -> Home
  }
  final Home
}

member Rover {
  camera : Camera
  tracker «: T|racker»
  «behavior P|atrol»
  connect «camera.i|mage» -> tracker.picture
}
swarm Rovers {
  rover «: R|over»[2]
}
"""
_MARK = re.compile(r"«(.*?)\|(.*?)»(.*)")


class Flow(NamedTuple):
    """Typing on a line; after the choice from the list, `then` is typed."""

    line: int
    typed: str
    wanted: str
    chosen: str
    then: str


def flows() -> list[Flow]:
    """Return what a user types, from the top to the bottom."""
    found = []
    for line, text in enumerate(MARKED.split("\n"), 1):
        mark = _MARK.search(text)
        if mark is not None:
            typed, completed, then = mark.groups()
            wanted = re.split(r'[ "(\[]', typed)[-1]
            wanted = wanted.removeprefix("camera.")  # the list has ports alone
            found.append(Flow(line, typed, wanted + completed, typed + completed, then))
    return found


# Without the parts that are typed; nothing is missing at the end.
GIVEN = _MARK.sub("", MARKED)
MODEL = _MARK.sub(r"\1\2\3", MARKED)
