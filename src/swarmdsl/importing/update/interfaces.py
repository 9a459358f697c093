"""What an update changes in the messages, services and actions of a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from swarmdsl.importing.update.merging import Merge, written
from swarmdsl.syntax.ast import (
    ActionType,
    Constant,
    Field,
    Interface,
    MessageType,
    ServiceType,
    StructType,
)

_REMOVE = "remove it, if the interface does not have it any more"


def merge_interface(merge: Merge, old: Interface, new: Interface) -> None:
    """Add what the import knows of an interface, and change what it knows otherwise."""
    before, after = _parts(old), _parts(new)
    if not after.keys() <= before.keys():
        reason = "it is something else in what is imported"
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
            text = "\n".join([f"{part} {{", *map(written, fields), "}"])
            add = merge.inside(start) if end == start else partial(merge.edits.below, end)
            add(text)


def is_described(interface: Interface) -> bool:
    """Whether anything is said of what an interface carries."""
    constants = isinstance(interface, MessageType) and interface.constants
    return bool(constants) or any(_parts(interface).values())


def _parts(interface: Interface) -> Mapping[str, Sequence[Field]]:
    """The fields of each part of an interface, by the word for it; a message has one."""
    match interface:
        case MessageType(fields=fields) | StructType(fields=fields):
            return {"": fields}
        case ServiceType(request=request, response=response):
            return {"request": request, "response": response}
        case ActionType(goal=goal, result=result, feedback=feedback):
            return {"goal": goal, "result": result, "feedback": feedback}
    return {}


def _section(merge: Merge, interface: Interface, part: str) -> tuple[int, int] | None:
    """Where the part begins, before its brace, and where it ends; None where it is not there."""
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
    known, wanted = [_name_of(field) for field in old], [_name_of(field) for field in new]
    for field in old:
        if _name_of(field) not in wanted:
            reason = "it is not in what is imported"
            merge.kept(field.span, f"field `{field.name}`", reason, _REMOVE)
    common = [name for name in known if name in wanted]
    for name, other in zip(common, (name for name in wanted if name in known), strict=True):
        if name != other:
            field = old[known.index(name)]
            reason = f"`{other}` stands there in what is imported"
            merge.kept(field.span, f"the place of field `{name}`", reason)
            return


def _name_of(item: Field | Constant) -> str:
    return str(item.name)
