"""Generate a large valid model: packages of about 300 lines that import each other.

Usage: `python benchmarks/workspace.py FOLDER [FILES]`

The same arguments give the same bytes. Each file resembles handwritten models: interfaces,
constants, components, members, machines of several shapes, and a swarm of all of them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

FILES = 334
LINES = 300
SEED = 7
# Returns a machine with a name, for package `number`, that uses declarations of package `used`.
Shape = Callable[[str, int, int], str]
# Maximum number of imported packages.
_IMPORTS = 3

_SHARED = """\
/// What all packages of the site use.
package site.interfaces

action site_msgs/Search {
  goal { distance : float64 }
  result {
    found : bool
    place : geometry_msgs/PoseStamped
  }
  feedback { progress : float64 }
}

action site_msgs/Drive {
  goal {
    distance : float64
    place    : geometry_msgs/PoseStamped
  }
}

message site_msgs/Finding {
  header : std_msgs/Header
  id     : string
  place  : geometry_msgs/PoseStamped
  weight : float64
}

message site_msgs/Battery {
  header    : std_msgs/Header
  /// State of charge, in percent.
  charge    : int32
  /// Minutes of work left.
  time_left : int32
}

service site_msgs/Reset { }

/// Charge below which a robot goes home, in percent.
const LOW_CHARGE : int32 = 20
const PATIENCE   : duration = 30 s
"""


def write(folder: Path, files: int = FILES, lines: int = LINES) -> int:
    """Write a model of `files` files, all but one of `lines` lines; return the number of lines."""
    random = Random(SEED)
    folder.mkdir(parents=True, exist_ok=True)
    texts = {"interfaces": _SHARED}
    for number in range(files - 1):
        texts[f"area{number}"] = _package(number, lines, random, _SHAPES)
    for name, text in texts.items():
        (folder / f"{name}.swarm").write_text(text, encoding="utf-8")
    return sum(text.count("\n") for text in texts.values())


def write_file(file: Path, lines: int, *, plain: bool = False) -> int:
    """Write a model of about `lines` lines in one file and its imports; return its lines.

    A `plain` model has only constructs that every target supports.
    """
    shapes = (_plain,) if plain else _SHAPES
    text = _package(0, lines, Random(SEED), shapes)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    (file.parent / "interfaces.swarm").write_text(_SHARED, encoding="utf-8")
    return text.count("\n")


def _package(number: int, lines: int, random: Random, shapes: Sequence[Shape]) -> str:
    """Return a package with as many machines as fit, filled up with messages."""
    earlier = sorted(random.sample(range(number), min(number, random.randrange(_IMPORTS + 1))))
    used = random.choice(earlier) if earlier else number
    parts = [_head(number, earlier)]
    left = lines - parts[0].count("\n")
    machines: list[str] = []
    while True:
        shape = random.choice(shapes)
        name = f"{shape.__name__.strip('_').title()}{number}x{len(machines)}"
        machine = f"\n{shape(name, number, used)}\n{_member(name, number, used)}"
        end = _swarm(number, [*machines, name])
        if machines and (machine + end).count("\n") > left:
            break
        parts.append(machine)
        left -= machine.count("\n")
        machines.append(name)
    parts.append(_swarm(number, machines))
    records = (left - parts[-1].count("\n")) // _record("").count("\n")
    return "".join(parts) + "".join(_record(f"{number}x{count}") for count in range(records))


def _head(number: int, earlier: list[int]) -> str:
    imports = "".join(f'import "area{other}.swarm"\n' for other in earlier)
    return f"""\
/// Area {number} of the site.
package site.area{number}

import "interfaces.swarm"
{imports}
swarm event Start{number} : std_msgs/Empty
swarm event Stop{number}  : std_msgs/Empty
swarm event Found{number} : site_msgs/Finding

const LIMIT_{number} : int32 = {number + 3}
const REACH_{number} : float64 = 2.5 * LIMIT_{number}

enum Mode{number} {{ IDLE, BUSY, FAULT }}

/// What is to be done in the area.
struct Job{number} {{
  mode  : Mode{number}
  id    : string
  place : geometry_msgs/PoseStamped
}}

/// Search the area.
function search_{number} : swarm {{
  action "cmd/search_{number}" : site_msgs/Search
  in  "pos_provider/pose" : geometry_msgs/PoseStamped
  param speed : float64 = 1.5
}}

/// Drive to a place.
function drive_{number} : abstraction {{
  action "cmd/drive_{number}" : site_msgs/Drive
}}

function reset_{number} : abstraction {{
  service "cmd/reset_{number}" : site_msgs/Reset
}}

sensor Camera{number} {{
  out finding : site_msgs/Finding on "finding"
  param rate : float64 = 5.0
}}

controller Pilot{number} {{
  in  finding  : site_msgs/Finding
  out velocity : geometry_msgs/Twist on "cmd_vel"
  param max_speed : float64 = 0.5
}}

controller CarefulPilot{number} extends Pilot{number} {{
  param margin : float64 = 0.5
}}

actuator Drive{number} {{
  in velocity : geometry_msgs/Twist
  /// Lift or lower what stands on it.
  operation lift(in up : bool, out lifted : bool)
}}
"""


def _plain(name: str, number: int, used: int) -> str:
    """Return a flat machine."""
    return f"""\
/// Search, and go back to what was found.
statemachine {name} {{
  param speed : float64 = 1.0
  var tries : int32 = 0
  var place : geometry_msgs/PoseStamped

  initial Idle

  state Idle {{
    on Start{number} -> Search
  }}
  state Search {{
    do search_{number}(distance = REACH_{used} * speed) gives (place => place)
    on succeeded -> Return
    on aborted [tries < LIMIT_{used}] / tries = tries + 1 -> Search
    on aborted -> Lost
    on Stop{number} -> Done
  }}
  state Return {{
    do drive_{used}(distance = 1.5, place = place)
    on succeeded -> Done
    on aborted   -> Search
  }}
  final Done
  final Lost
}}
"""


def _nested(name: str, number: int, used: int) -> str:
    """Return a machine with nested states, choices and a history."""
    return f"""\
/// Work until the battery is low, and go on where it was left.
statemachine {name} {{
  param share : float64 = 0.5
  var weight : float64 = 0.0
  var count  : int32 = 0
  var last   : Mode{used} = Mode{used}.IDLE
  var place  : geometry_msgs/PoseStamped

  initial Idle

  state Idle {{
    on Start{number} -> Mission
  }}
  state Mission {{
    initial Look
    history Before -> Look

    state Look {{
      entry / last = Mode{used}.BUSY
      do search_{used}(distance = min(REACH_{used}, 50.0) / 2)
        gives (place => place)
      on succeeded -> Weigh
      on aborted   -> Look
      exit / count = count + 1
    }}
    choice Weigh {{
      [weight > share and count < LIMIT_{used}] -> Look
      [last == Mode{used}.FAULT or not (count >= 1)] / count = 0 -> Look
      else / send Found{number}(id = "found", place = place, weight = weight) -> Carry
    }}
    state Carry {{
      initial Grasp

      state Grasp {{
        do Drive{number}.lift(up = true)
        on succeeded / weight = weight + 0.5 -> Move
        on aborted   -> Grasp
      }}
      state Move {{
        do drive_{number}(distance = 2.0, place = place)
        on succeeded -> Put
        on aborted   -> Grasp
      }}
      final Put

      on done -> Look
      after PATIENCE -> Look
    }}

    monitor "battery" : site_msgs/Battery [event.charge < LOW_CHARGE] -> Charge
    on Stop{number} -> Done
  }}
  state Charge {{
    do reset_{number}
    on succeeded -> Mission.Before
    on aborted   -> Charge
  }}
  final Done
}}
"""


def _parallel(name: str, number: int, used: int) -> str:
    """Return a machine with parallel regions, one of which runs another machine."""
    return f"""\
statemachine Fetch{name} {{
  param goal  : geometry_msgs/PoseStamped
  param limit : int32 = 3
  var tries : int32 = 0

  initial Go

  state Go {{
    do drive_{used}(distance = 1.0, place = goal)
    on succeeded -> There
    on aborted [tries < limit] / tries = tries + 1 -> Go
    on aborted -> Lost
  }}
  final There
  final Lost
}}

/// Fetch what others find, and watch the battery meanwhile.
statemachine {name} {{
  var place : geometry_msgs/PoseStamped
  var id    : string = ""

  initial Idle

  state Idle {{
    on Start{number} -> Shift
  }}
  parallel state Shift {{
    region Work {{
      initial Ready

      state Ready {{
        on Found{number} [event.weight < 2.0 * REACH_{used} and event.id != id]
          / id = event.id, place = event.place -> Fetch
      }}
      state Fetch = Fetch{name}(goal = place, limit = LIMIT_{used}) {{
        on done.There -> Ready
        on done.Lost / id = "" -> Ready
        after 2 min -> Ready
      }}
    }}
    region Watch {{
      initial Enough

      state Enough {{
        monitor "battery" : site_msgs/Battery
          [event.charge < LOW_CHARGE and event.time_left <= 5] -> Low
      }}
      final Low
    }}

    on Watch.done   -> Parked
    on Stop{number} -> Parked
  }}
  final Parked
}}
"""


_SHAPES = (_plain, _nested, _parallel)


def _member(name: str, number: int, used: int) -> str:
    """Return a member that runs a machine."""
    return f"""\
member Robot{name} {{
  behavior {name}

  camera : Camera{used} {{ rate = 10.0 }}
  pilot  : CarefulPilot{number} {{ margin = 1.0, max_speed = 2.0 }}
  drive  : Drive{number}

  connect camera.finding -> pilot.finding
  connect pilot.velocity -> drive.velocity
}}
"""


def _swarm(number: int, machines: list[str]) -> str:
    """Return a swarm of all members, and one more that directs them."""
    roles = "".join(
        f"  robot_{count} : Robot{machine}[1..{count + 2}]\n"
        for count, machine in enumerate(machines)
    )
    return f"""
/// Starts the others, and ends it when enough was found.
statemachine Director{number} {{
  var found : int32 = 0

  initial Ready

  state Ready {{
    after 5 s / send Start{number} -> Busy
  }}
  state Busy {{
    on Found{number} [found < LIMIT_{number}] / found = found + 1
    on Found{number} -> Over
    after 1 h -> Over
  }}
  state Over {{
    entry / send Stop{number}
    on done / send Found{number}(id = "last", weight = 0.5) -> Ended
  }}
  final Ended
}}

member Base{number} {{
  behavior Director{number}
  param jobs : int32 = 5
}}

environment Area{number} {{
  world "area{number}.world"
  size 40 m x 25 m
}}

fitness Yield{number} {{
  in found   : uint32
  in elapsed : duration
  param shift : duration = 30 min
  maximize found * (shift / elapsed)
}}

swarm Site{number} {{
  base : Base{number}
{roles}  environment Area{number}
  fitness Yield{number}
}}

optimize Site{number} {{
  evaluations 40
  base.jobs in 1 .. 9 step 2
}}
"""


def _record(name: str) -> str:
    """Return a message with a few fields."""
    return f"""
message Record{name} {{
  at     : time
  names  : string[]
  values : float64[<=16]
}}
"""


if __name__ == "__main__":
    count = int(sys.argv[2]) if len(sys.argv) > 2 else FILES
    print(write(Path(sys.argv[1]), count), "lines")
