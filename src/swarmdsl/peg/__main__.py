"""Writes `swarm_parser.py`: `python -m swarmdsl.peg`, or `make parser`."""

from __future__ import annotations

from swarmdsl.peg.swarm import PATH, parser
from swarmdsl.textx_entry import metamodel

if __name__ == "__main__":
    PATH.write_text(parser(metamodel()), encoding="utf-8")
