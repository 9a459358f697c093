"""Registry of targets: built-in ones, and third-party ones by entry points."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, get_type_hints

from swarmdsl.base.errors import describe_exception
from swarmdsl.base.records import dataclass, fields_of, is_dataclass
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.api import API_VERSION, Generator

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

BUILT_IN = {
    "scxml": "swarmdsl.codegen.exchange.scxml:generator",
    "adf": "swarmdsl.codegen.exchange.adf:generator",
    "smach": "swarmdsl.codegen.bundled.smach:generator",
    "ros2": "swarmdsl.codegen.bundled.ros2:generator",
    "skeleton": "swarmdsl.codegen.bundled.skeleton:generator",
    "yasmin": "swarmdsl.codegen.bundled.yasmin:generator",
    "amf": "swarmdsl.codegen.exchange.amf:generator",
    "swarmros": "swarmdsl.codegen.exchange.swarmros:generator",
    "parameters": "swarmdsl.codegen.exchange.parameters:generator",
    "fitness": "swarmdsl.codegen.exchange.fitness:generator",
    "composition": "swarmdsl.codegen.exchange.composition:generator",
    "frevo": "swarmdsl.codegen.exchange.frevo:generator",
    "promela": "swarmdsl.codegen.bundled.promela:generator",
    "murphi": "swarmdsl.codegen.bundled.murphi:generator",
    "jani": "swarmdsl.codegen.bundled.jani:generator",
    "gazebo": "swarmdsl.codegen.bundled.gazebo:generator",
    "nav2_map": "swarmdsl.codegen.bundled.nav2_map:generator",
}
# Formats of other tools, built on request only.
ON_REQUEST = frozenset(
    {
        "skeleton",
        "yasmin",
        "amf",
        "swarmros",
        "parameters",
        "fitness",
        "composition",
        "frevo",
        "promela",
        "murphi",
        "jani",
        "gazebo",
        "nav2_map",
    }
)
GROUP = "swarmdsl.generators"

OPTION_TYPES = (str, bool, int)

# Names that users try for the target of ROS 1.
ROS_1 = frozenset({"ros", "ros1", "ros-1", "ros_1"})

# A target's name is also the name of its output folder.
_NAME = r"[a-z][a-z0-9_-]*"


@dataclass(frozen=True)
class Broken:
    """Installed generator that cannot be used, with the reason."""

    reason: str


def target_names() -> list[str]:
    """Return the names of all targets, the built-in ones first."""
    return [*BUILT_IN, *sorted(_third_party().keys() - BUILT_IN.keys())]


def has(name: str) -> bool:
    """Return True if there is a target of that name."""
    return name in BUILT_IN or name in _third_party()


def similar_target(name: str) -> str:
    """Return a hint for the name of an unknown target."""
    if name.lower() in ROS_1:
        return "ROS 1 is target `smach`, and ROS 2 is `ros2`"
    return suggest(name, target_names(), "targets")


def default_names() -> list[str]:
    """Return the targets that are built if none is requested."""
    return [name for name in target_names() if name not in ON_REQUEST]


def shadowed_names() -> list[str]:
    """Return the built-in names that a third-party package offers, too."""
    return sorted(_third_party().keys() & BUILT_IN.keys())


def load(name: str) -> Generator | Broken | None:
    """Return the generator of a target, or None if there is no such target."""
    if name in BUILT_IN:
        module, _, attribute = BUILT_IN[name].partition(":")
        return _load_checked(name, lambda: getattr(import_module(module), attribute))
    found = _third_party().get(name, [])
    if not found:
        return None
    if not re.fullmatch(_NAME, name):
        return Broken("its name has other characters than lower-case letters, digits, `-` and `_`")
    if len(found) > 1:
        return Broken(f"it is offered more than once: {' and '.join(p.value for p in found)}")
    return _load_checked(name, found[0].load)


def _third_party() -> dict[str, list[EntryPoint]]:
    # Imported late: slow, and not needed for built-in targets.
    from importlib.metadata import entry_points

    by_name: dict[str, list[EntryPoint]] = {}
    for point in entry_points(group=GROUP):
        # A package that is both installed and on the path is listed twice.
        same_name = by_name.setdefault(point.name, [])
        if point.value not in [known.value for known in same_name]:
            same_name.append(point)
    return by_name


def _load_checked(name: str, load: Callable[[], object]) -> Generator | Broken:
    try:
        found = load()
        fault = _fault(name, found)
    # Any failure of third-party code, `sys.exit` included, breaks only its own target.
    except (Exception, SystemExit) as error:
        return Broken(describe_exception(f"loading the generator of target {name}", error))
    if fault is not None:
        return Broken(fault)
    assert isinstance(found, Generator)
    return found


def _fault(name: str, found: object) -> str | None:
    if not isinstance(found, Generator):
        return f"it is an object of class `{type(found).__name__}`, not a `Generator`"
    if found.api_version != API_VERSION:
        return f"it is made for version {found.api_version} of the generator API, not {API_VERSION}"
    if found.target != name:
        return f"its `target` is `{found.target}`"
    if not (isinstance(found.options_type, type) and is_dataclass(found.options_type)):
        return "its `options_type` is not a dataclass"
    types = get_type_hints(found.options_type)
    for option, about in fields_of(found.options_type).items():
        if types[option] not in OPTION_TYPES:
            return f"its option `{option}` is neither `str`, `bool` nor `int`"
        if "default" not in about:
            return f"its option `{option}` has no default"
        other = about.get("metadata", {}).get("only", "").partition("=")[0]
        if other and other not in types:
            return (
                f"its option `{option}` counts only with an option `{other}`, which does not exist"
            )
    return None
