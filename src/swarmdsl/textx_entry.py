"""Registers the language and its targets with textX: `textx check`, `textx generate`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from textx import GeneratorDesc, LanguageDesc, TextXError, TextXSemanticError

from swarmdsl.diagnostics import Diagnostic, Diagnostics, Severity

if TYPE_CHECKING:
    from swarmdsl.project.settings import Settings


def _metamodel(**_params: Any) -> Any:
    from swarmdsl.parse import RECURSION_LIMIT, metamodel

    # The parse is textX's here, out of reach: a deep model needs the room all the same.
    sys.setrecursionlimit(max(sys.getrecursionlimit(), RECURSION_LIMIT))
    # One of textX's own: with the check in it, ours could not parse without checking.
    made = metamodel.__wrapped__()
    made.register_model_processor(_check)
    return made


def _check(model: Any, _metamodel: Any) -> None:
    """Raise what swarmc finds wrong with a file; textX can show but one mistake."""
    from swarmdsl import compiler

    path = getattr(model, "_tx_filename", None)
    if path is not None:
        _raise_errors(compiler.check([Path(path)], _settings(Path(path))).report)


def _settings(path: Path) -> Settings:
    """What the project file of a model says."""
    from swarmdsl.project import find_settings

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
        from swarmdsl import compiler
        from swarmdsl.emit import Request

        if model is None:
            raise TextXError("give a .swarm file to generate from")
        path = Path(model._tx_filename)
        # An option without a value arrives as True.
        texts = {name: "true" if value is True else str(value) for name, value in given.items()}
        out = Path(output_path) if output_path else path.parent
        settings = _settings(path)
        options = {**settings.targets.get(target, {}), **texts}
        request = Request(target, options)
        result = compiler.build([path], [request], out, settings, force=overwrite)
        _raise_errors(result.report)

    return GeneratorDesc("swarm", target, description, generate)


swarm = LanguageDesc("swarm", "*.swarm", "Swarms of robots: members, behaviour", _metamodel)

scxml = _generator("scxml", "SCXML documents of the state machines")
adf = _generator("adf", "Abstraction description file of the functions")
smach = _generator("smach", "ROS 1 packages that run the state machines with SMACH")
