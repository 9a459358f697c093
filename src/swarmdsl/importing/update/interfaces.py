"""Update messages, services and actions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from swarmdsl.importing.update.merging import Merge, node_text
from swarmdsl.syntax.ast import (
    ActionType,
    Constant,
    Field,
    Interface,
    MessageType,
    ServiceType,
    StructType,
)

_REMOVE = "remove it if the interface no longer has it"


def merge_interface(merge: Merge, old: Interface, new: Interface) -> None:
    """Add new fields and constants of an interface and update changed ones."""
    before, after = _parts(old), _parts(new)
    if not after.keys() <= before.keys():
        reason = "it has another kind in the import"
        merge.kept(old.name.span, f"`{old.name}`", reason)
        return
    merge.documentation(old, new)
    start = end = old.name.span.end
    constants: Sequence[Constant] = ()
    if isinstance(old, MessageType) and isinstance(new, MessageType):
        constants = old.constants
        merge.items(constants, new.constants, _name_of, merge.default, merge.inside(start))
    for part, fields in after.items():
        section = (start, old.span.end) if not part else _section(merge, old, part)
        if section is not None:
            begin, end = section
            _merge_fields(merge, before[part], fields, merge.last(constants, begin))
        elif fields:
            text = "\n".join([f"{part} {{", *map(node_text, fields), "}"])
            add = merge.inside(start) if end == start else partial(merge.edits.below, end)
            add(text)


def is_described(interface: Interface) -> bool:
    """Return True if the interface has fields or constants."""
    constants = isinstance(interface, MessageType) and interface.constants
    return bool(constants) or any(_parts(interface).values())


def _parts(interface: Interface) -> Mapping[str, Sequence[Field]]:
    """Fields of each part of an interface by keyword; "" for those of a message."""
    match interface:
        case MessageType(fields=fields) | StructType(fields=fields):
            return {"": fields}
        case ServiceType(request=request, response=response):
            return {"request": request, "response": response}
        case ActionType(goal=goal, result=result, feedback=feedback):
            return {"goal": goal, "result": result, "feedback": feedback}
    return {}


def _section(merge: Merge, interface: Interface, part: str) -> tuple[int, int] | None:
    """Range of a part from its keyword to its brace; None if it is missing."""
    start, end = interface.name.span.end, interface.span.end
    depth = 0
    begin: int | None = None
    for token in merge.tokens.code(start, end - start):
        depth += {"{": 1, "}": -1}.get(token.text, 0)
        if token.text == part and depth == 1:
            begin = token.start
        elif begin is not None and token.text == "}":
            return begin, token.start + 1
        if token.start >= end:
            break
    return None


def _merge_fields(
    merge: Merge, old: Sequence[Field], new: Sequence[Field], first: Callable[[str], None]
) -> None:
    merge.items(old, new, _name_of, lambda one, other: merge.type(one.type, other.type), first)
    if not new:
        return
    known, imported = [_name_of(field) for field in old], [_name_of(field) for field in new]
    for field in old:
        if _name_of(field) not in imported:
            reason = "it is missing in the import"
            merge.kept(field.span, f"field `{field.name}`", reason, _REMOVE)
    common = [name for name in known if name in imported]
    for name, other in zip(common, (name for name in imported if name in known), strict=True):
        if name != other:
            field = old[known.index(name)]
            reason = f"the import has `{other}` there"
            merge.kept(field.span, f"the position of field `{name}`", reason)
            return


def _name_of(item: Field | Constant) -> str:
    return str(item.name)
