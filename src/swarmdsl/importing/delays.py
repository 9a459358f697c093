"""Convert the delay of a `<send>`."""

from __future__ import annotations

import re

from swarmdsl.execution.scxml.attributes import delay_of
from swarmdsl.execution.scxml.document import Node
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.expressions import UnsupportedError
from swarmdsl.ir import Binary, Expression, Literal, Type
from swarmdsl.syntax.types import DURATION, INT

# Computed delays in the portable profile and in other documents.
_COMPUTED = re.compile(r'Math\.max\(0, Math\.ceil\((.*)\)\) \+ "ms"')
_WITH_UNIT = re.compile(r"""(.*)\+\s*(["'])(ms|s)\2\s*""")
_TEXT = re.compile(r"""\s*(["'])([^"']*)\1\s*""")


def read_delay(node: Node, data: MachineData, event: Type | None = None) -> Expression:
    """Return the delay of a `<send>`; `event` is the type of the current message.

    Raises UnsupportedError.
    """
    written = node.get("delay")
    text = _TEXT.fullmatch(node.get("delayexpr", ""))
    if written is not None or text is not None:
        length = delay_of(written if written is not None else text[2] if text else "")
        if length is None:
            raise UnsupportedError(f"`{written}` is not a delay")
        return Literal(length, DURATION)
    computed = _COMPUTED.fullmatch(node.get("delayexpr", ""))
    if computed is not None:
        return data.read(node, "delayexpr", computed[1], DURATION, event)
    with_unit = _WITH_UNIT.fullmatch(node.get("delayexpr", ""))
    if with_unit is None:
        raise UnsupportedError(f"`{node.get('delayexpr')}` is not a duration")
    unit = Literal(1_000_000 if with_unit[3] == "ms" else 1_000_000_000, DURATION)
    number = data.read(node, "delayexpr", with_unit[1], INT, event)
    return Binary("*", number, unit, DURATION)
