"""Model of the README, as a new user types it: `«typed|completed»` marks where a list helps."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

_README = Path(__file__).resolve().parents[2] / "README.md"
_BLOCK = re.compile(r"^```swarm file=patrol\.swarm\n(.*?)^```", re.MULTILINE | re.DOTALL)
_MARKED = """\
«pac|kage» patrol

«sw|arm» «ev|ent» Start : «std|_msgs/Empty»
«sw|arm» «ev|ent» Stop  : «std|_msgs/Empty»

/// Drive around the area once.
«func|tion» go_round : «ab|straction» {
  «ac|tion» "cmd/go_round" : patrol_msgs/GoRound
}

«statem|achine» Patrol {
  «in|itial» Idle

  «st|ate» «I|dle» {
    on «St|art» -> Round
  }
  «st|ate» «R|ound» {
    do «g|o_round»
    on «su|cceeded» -> «R|ound»
    on «a|borted»   -> Home
    on «Sto|p»      -> Home
  }
  «fi|nal» «H|ome»
}

«mem|ber» Rover { «b|ehavior» «P|atrol» }

«sw|arm» Patrols { rover : «R|over»[3] }
"""

[PATROL] = _BLOCK.findall(_README.read_text(encoding="utf-8"))


class Piece(NamedTuple):
    """Text that is typed, and how the first item of the list completes it, if at all."""

    typed: str
    completed: str = ""

    @property
    def text(self) -> str:
        return self.typed + self.completed


def lines() -> list[list[Piece]]:
    """Return the pieces of each line, without its indentation."""
    return [
        [Piece(plain or typed, completed) for typed, completed, plain in _pieces(line.strip())]
        for line in _MARKED.splitlines()
    ]


def _pieces(line: str) -> list[tuple[str, str, str]]:
    return re.findall(r"«(.*?)\|(.*?)»|([^«]+)", line)
