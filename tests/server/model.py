"""Models that are open in the editor during these tests."""

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.formatter import format_source

MODEL = """\
/// Robots that go round. 🤖
package patrol

/// Begin.
event Start : std_msgs/Empty on "start"
event Stop : std_msgs/Empty on "stop"

enum Mode {
  SLOW
  FAST
}

/// Drive around.
function go_round : abstraction { action "go" : patrol_msgs/GoRound }

/* 🤖🤖 */ statemachine Patrol {
  param limit : int32 = 3
  var rounds : int32 = 0
  var mode : Mode = Mode.SLOW
  initial Idle

  state Idle {
    on Start [mode == Mode.FAST] / rounds = rounds + 1 -> Round
  }
  state Round {
    do go_round
    on succeeded [rounds < limit] -> Round
    on succeeded -> Home
    on aborted -> Home
    on Stop -> Home
  }
  final Home
}
"""
# As formatted by `swarmc fmt`.
LAID_OUT = format_source(Source("patrol.swarm", MODEL), Diagnostics())
assert LAID_OUT != MODEL
ROVER = """\
package rover
import "patrol.swarm"
member Rover { behavior Patrol }
swarm Rovers { rover : Rover[2] }
"""
