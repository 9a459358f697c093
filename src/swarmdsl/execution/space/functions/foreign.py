"""Load the function models of a project: classes in its files, or entry points of packages."""

from __future__ import annotations

from importlib.metadata import entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.errors import describe_exception
from swarmdsl.base.read_files import is_file
from swarmdsl.base.suggest import suggest
from swarmdsl.driver.config import ModelSource
from swarmdsl.execution.space.functions.base import Model
from swarmdsl.execution.space.setting import Kind
from swarmdsl.ir.function_models import Argument

GROUP = "swarmdsl.models"
"""Group of entry points of function models."""


class _BadError(Exception):
    """A model that cannot be loaded, with the reason."""


def load(source: ModelSource, report: Diagnostics) -> Kind | None:
    """Load a model; report why it cannot be had."""
    try:
        found = _class_in(source.path, source) if source.path is not None else _entry(source)
        return Kind(source.name, _arguments(found), found)
    except _BadError as error:
        report.report("bad-model", source.place, name=source.name, reason=str(error))
    # Any failure of the code of others, `sys.exit` included, breaks only this model.
    except (Exception, SystemExit) as error:
        reason = describe_exception(f"loading the model {source.name}", error)
        report.report("bad-model", source.place, name=source.name, reason=reason)
    return None


def _class_in(path: Path, source: ModelSource) -> type[Model]:
    if not is_file(path):
        raise _BadError(f"there is no file `{path}`")
    spec = spec_from_file_location(f"swarmdsl_model_{source.name}", path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    found = getattr(module, source.attribute, None)
    if found is None:
        names = [name for name, each in vars(module).items() if isinstance(each, type)]
        hint = suggest(source.attribute, names, "classes")
        raise _BadError(f"`{path}` has no `{source.attribute}`{f': {hint}' if hint else ''}")
    return _checked(found, source.attribute)


def _entry(source: ModelSource) -> type[Model]:
    points = {point.name: point for point in entry_points(group=GROUP)}
    if source.attribute not in points:
        hint = suggest(source.attribute, points, "entry points")
        reason = f"no package has an entry point `{source.attribute}` of group `{GROUP}`"
        raise _BadError(f"{reason}{f': {hint}' if hint else ''}")
    return _checked(points[source.attribute].load(), source.attribute)


def _checked(found: object, name: str) -> type[Model]:
    if not isinstance(found, type) or not issubclass(found, Model):
        raise _BadError(f"`{name}` is no class made from `{Model.__module__}.{Model.__name__}`")
    if found.__abstractmethods__:
        raise _BadError(f"`{name}` has no method `step`")
    return found


def _arguments(found: type[Model]) -> tuple[Argument, ...]:
    arguments = found.arguments
    if not isinstance(arguments, tuple) or not all(isinstance(a, Argument) for a in arguments):
        raise _BadError("its `arguments` are no tuple of `Argument`")
    return arguments
