"""Fields and constants of published ROS packages, in a form of our own.

`python -m tests.project.published_interfaces FOLDER NAME COMMIT ...` records the interfaces of the
package in FOLDER, a checkout of its repository, that the shipped library declares.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.loader import load
from swarmdsl.project.rosidl.interface_file import parse_interface
from swarmdsl.syntax.ast import ActionType, Constant, Field, MessageType, ServiceType

RECORDS = Path(__file__).with_name("published")
INTERFACES = {MessageType: "msg", ServiceType: "srv", ActionType: "action"}
PARTS = {
    "msg": ("constants", "fields"),
    "srv": ("request", "response"),
    "action": ("goal", "result", "feedback"),
}
OWN = "px4_offboard_msgs"
"""Package of actions that target `ros2` writes: nobody else publishes it."""
ABOUT = ("repository", "commit", "date", "distribution", "version", "license")
Outline = Mapping[str, list[str]]
AnyInterface = MessageType | ServiceType | ActionType


def outline(node: AnyInterface) -> Outline:
    """Return the parts of an interface, each a list of `type name` or `type name = value`."""
    parts = PARTS[INTERFACES[type(node)]]
    return {part: [_line(each) for each in getattr(node, part)] for part in parts}


def _line(node: Field | Constant) -> str:
    type_ = node.type
    text = f"{type_.name}{type_.bound or ''}{type_.array or ''} {node.name}"
    return f"{text} = {node.value.span.text.strip()}" if isinstance(node, Constant) else text


def shipped(library: str) -> Iterator[tuple[str, str, str, AnyInterface]]:
    """Yield package, kind and name of each published interface, and its declaration."""
    for _, node in load([resources.library() / library], Diagnostics()).declarations():
        if isinstance(node, (MessageType, ServiceType, ActionType)):
            package, _, name = str(node.name).partition("/")
            if package != OWN:
                yield package, INTERFACES[type(node)], name, node


def record(folder: Path, library: str, package: str, about: Mapping[str, str]) -> str:
    """Return the interfaces of a package that a library declares, as TOML."""
    lines = [f'{key} = "{about[key]}"' for key in ABOUT]
    for of, kind, name, declared in shipped(library):
        if of != package:
            continue
        path = next(iter(folder.rglob(f"{name}.{kind}")))
        source = Source(str(path), path.read_text(encoding="utf-8"), path)
        real = parse_interface(source, package, name, kind, Diagnostics()).declaration
        lines += ["", f"[{kind}.{name}]"]
        ours = outline(declared).get("constants", [])
        wanted = {each.partition(" =")[0] for each in ours}
        for part, all_entries in outline(real).items():
            # A package may have hundreds of constants: those that a library declares count.
            chosen = part != "constants"
            entries = [e for e in all_entries if chosen or e.partition(" =")[0] in wanted]
            written = "".join(f'\n  "{re.sub(" +", " ", each)}",' for each in entries)
            lines.append(f"{part} = [{written}\n]" if entries else f"{part} = []")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    place, library_name, package_name, *values = sys.argv[1:]
    known = dict(zip(ABOUT, values, strict=True))
    text = record(Path(place), library_name, package_name, known)
    (RECORDS / f"{package_name}.toml").write_text(text, encoding="utf-8")
