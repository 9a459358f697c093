"""Stand-in for `launch` and `launch_ros`; `launch` is in no package index.

An action is done as launch does it: launch configurations are set where nothing is set, groups
have their own, namespaces are pushed and popped, included files see what the including one has set.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

_MODULES = {
    "launch": ("LaunchDescription",),
    "launch.actions": (
        "DeclareLaunchArgument",
        "GroupAction",
        "IncludeLaunchDescription",
        "OpaqueFunction",
    ),
    "launch.launch_description_sources": ("PythonLaunchDescriptionSource",),
    "launch.substitutions": ("LaunchConfiguration",),
    "launch_ros": (),
    "launch_ros.actions": ("LifecycleNode", "Node", "PushRosNamespace"),
    "ament_index_python": (),
    "ament_index_python.packages": (),
}

_OWN = ("robots", "launched_nodes", "launching")
"""Modules of a package that its launch files import, each after those that it imports."""


class Recorded:
    """An object of `launch` or `launch_ros`, which keeps what it is made of."""

    def __init__(self, *arguments: Any, **keywords: Any) -> None:
        self.arguments = arguments
        self.keywords = keywords

    def perform(self, context: Mapping[str, str]) -> str:
        """The text that a launch configuration stands for."""
        return context[self.arguments[0]]


def launch(
    path: Path, packages: Mapping[str, Path], setattr_: Callable[..., None], **arguments: str
) -> list[dict[str, Any]]:
    """The nodes that a launch file starts: what they are made of, with their whole namespace.

    `packages` are those that are installed, with their folders; `setattr_` puts an item into a
    dictionary until the test has ended.
    """
    _install(packages, setattr_)
    started: list[dict[str, Any]] = []
    _include(path, dict(arguments), [], started)
    return started


def _install(packages: Mapping[str, Path], setitem: Callable[..., None]) -> None:
    for name, classes in _MODULES.items():
        module = ModuleType(name)
        for each in classes:
            setattr(module, each, type(each, (Recorded,), {}))
        setitem(sys.modules, name, module)
    for name, folder in packages.items():
        modules = [path for path in _OWN if (folder / name / f"{path}.py").is_file()]
        if modules:
            package = ModuleType(name)
            package.__path__ = [str(folder / name)]
            setitem(sys.modules, name, package)
        for each in modules:
            path = folder / name / f"{each}.py"
            spec = importlib.util.spec_from_file_location(f"{name}.{each}", path)
            assert spec is not None
            assert spec.loader is not None
            setitem(sys.modules, spec.name, importlib.util.module_from_spec(spec))
    missing = type("PackageNotFoundError", (KeyError,), {})

    def share(name: str) -> str:
        if name not in packages:
            raise missing(name)
        return str(packages[name])

    index = sys.modules["ament_index_python.packages"]
    index.PackageNotFoundError = missing  # type: ignore[attr-defined]
    index.get_package_share_directory = share  # type: ignore[attr-defined]
    for each in [
        sys.modules[f"{name}.{own}"]
        for name in packages
        for own in _OWN
        if f"{name}.{own}" in sys.modules
    ]:
        assert each.__spec__ is not None
        assert each.__spec__.loader is not None
        each.__spec__.loader.exec_module(each)


def _include(
    path: Path, context: dict[str, str], spaces: list[str], started: list[dict[str, Any]]
) -> None:
    code: dict[str, Any] = {}
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), code)
    (actions,) = code["generate_launch_description"]().arguments
    for action in actions:
        _do(action, context, spaces, started)


def _do(
    action: Any, context: dict[str, str], spaces: list[str], started: list[dict[str, Any]]
) -> None:
    match type(action).__name__:
        case "DeclareLaunchArgument":
            context.setdefault(action.arguments[0], action.keywords["default_value"])
        case "GroupAction":
            inside, below = dict(context), list(spaces)
            for each in action.arguments[0]:
                _do(each, inside, below, started)
        case "PushRosNamespace":
            spaces.append(_text(action.arguments[0], context))
        case "OpaqueFunction":
            for each in action.keywords["function"](context):
                _do(each, context, spaces, started)
        case "IncludeLaunchDescription":
            given = dict(action.keywords["launch_arguments"])
            context.update({name: _text(value, context) for name, value in given.items()})
            (source,) = action.arguments
            _include(Path(source.arguments[0]), context, spaces, started)
        case _:
            own = _text(action.keywords.get("namespace") or "", context)
            namespace = "/".join(["", *filter(None, [*spaces, own])])
            kind = type(action).__name__
            started.append({**action.keywords, "namespace": namespace, "kind": kind})


def _text(value: Any, context: Mapping[str, str]) -> str:
    return value.perform(context) if isinstance(value, Recorded) else value
