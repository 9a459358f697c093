"""Write `parser/generated.py`: `python -m swarmdsl.syntax.pegen`, or `make parser`."""

from __future__ import annotations

from swarmdsl.syntax.pegen.metamodel import metamodel
from swarmdsl.syntax.pegen.swarm_actions import PATH, parser

if __name__ == "__main__":
    PATH.write_text(parser(metamodel()), encoding="utf-8")
