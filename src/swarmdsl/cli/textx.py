"""Register the language and the bundled targets with textX."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from textx import (
    GeneratorDesc,
    LanguageDesc,
    TextXError,
    TextXSemanticError,
)

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Severity
from swarmdsl.syntax.pegen.metamodel import metamodel

if TYPE_CHECKING:
    from swarmdsl.driver.config.settings import Settings


# Room for models as deep as NESTING_LIMIT: textX recurses about thirty frames a level.
_RECURSION_LIMIT = 20_000


def _checking_metamodel(**_params: Any) -> Any:
    sys.setrecursionlimit(max(sys.getrecursionlimit(), _RECURSION_LIMIT))
    made = metamodel()
    made.register_model_processor(_check)
    return made


def _check(model: Any, _metamodel: Any) -> None:
    """Raise the first error of a file; textX can show only one."""
    from swarmdsl.driver import pipeline

    path = getattr(model, "_tx_filename", None)
    if path is not None:
        _raise_errors(pipeline.check([Path(path)], _settings(Path(path))).report)


def _settings(path: Path) -> Settings:
    """Return the settings of the project of a model."""
    from swarmdsl.driver.config import find_settings

    report = Diagnostics()
    settings = find_settings([path], report)
    _raise_errors(report)
    return settings


def _raise_errors(report: Diagnostics) -> None:
    errors = [found for found in report if found.severity is Severity.ERROR]
    if errors:
        raise _as_textx_error(errors[0], len(errors) - 1)


def _as_textx_error(error: Diagnostic, others: int) -> TextXError:
    message = f"{error.message} [{error.code}]"
    if others:
        message += f" (and {others} more; run `swarmc check`)"
    if error.primary is None:
        return TextXSemanticError(message)
    source, start, end = error.primary.span
    line, column = source.line_column(start)
    return TextXSemanticError(message, line, column, nchar=end - start, filename=source.name)


def _generator(target: str, description: str) -> GeneratorDesc:
    def generate(
        _metamodel: Any,
        model: Any,
        output_path: str | None,
        overwrite: bool,
        _debug: bool,
        **given: str | bool,
    ) -> None:
        from swarmdsl.codegen.emit import Request
        from swarmdsl.driver import pipeline
        from swarmdsl.output import WriteOptions

        if model is None:
            raise TextXError("give a .swarm file to generate from")
        path = Path(model._tx_filename)
        # An option without a value arrives as True.
        texts = {name: "true" if value is True else str(value) for name, value in given.items()}
        out = Path(output_path) if output_path else path.parent
        settings = _settings(path)
        options = {**settings.targets.get(target, {}), **texts}
        request = Request(target, options)
        result = pipeline.build([path], [request], out, settings, WriteOptions(force=overwrite))
        _raise_errors(result.report)

    return GeneratorDesc("swarm", target, description, generate)


swarm = LanguageDesc(
    "swarm", "*.swarm", "Swarms of robots: members, behaviour", _checking_metamodel
)

scxml = _generator("scxml", "SCXML documents of the state machines")
adf = _generator("adf", "Abstraction description file of the functions")
smach = _generator("smach", "ROS packages that run the state machines with SMACH")
ros2 = _generator("ros2", "ROS 2 packages that run the state machines on rclpy")
yasmin = _generator("yasmin", "ROS 2 packages that run the state machines with YASMIN")
skeleton = _generator("skeleton", "Packages of functions and components, to fill in")
amf = _generator("amf", "Algorithm Modelling File of the swarm library")
swarmros = _generator("swarmros", "Configuration of the bridge between members")
parameters = _generator("parameters", "Search space for optimisers")
fitness = _generator("fitness", "Python scripts that compute the fitness of a run")
composition = _generator("composition", "Members of a swarm as XML, and launch files")
frevo = _generator("frevo", "Problem and configuration of a search with FREVO")
promela = _generator("promela", "Composed swarms and their properties for the model checker SPIN")
murphi = _generator("murphi", "Composed swarms and their properties for the model checker rumur")
jani = _generator("jani", "Composed swarms and their properties for the model checker Storm")
gazebo = _generator("gazebo", "Worlds of environments for the simulator Gazebo")
nav2_map = _generator("nav2_map", "Occupancy maps of environments for the navigation of ROS")
