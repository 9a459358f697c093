"""Model of the README, which a new user types first."""

from __future__ import annotations

import re
from pathlib import Path

_README = Path(__file__).resolve().parents[2] / "README.md"
_BLOCK = re.compile(r"^```swarm file=patrol\.swarm\n(.*?)^```", re.MULTILINE | re.DOTALL)

[PATROL] = _BLOCK.findall(_README.read_text(encoding="utf-8"))
