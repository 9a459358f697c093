"""Phases of swarmdsl as actions on a model, without what happens before them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cached_property, partial
from pathlib import Path

from growth_models import MODEL, Files
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen import registry
from swarmdsl.codegen.emit import Output, Request, emit
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.driver.pipeline import Result
from swarmdsl.driver.workspace import Workspace
from swarmdsl.execution.scxml import read
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import choose
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.runner import run as simulate
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ide.server.completion import completions
from swarmdsl.ide.server.folding_range import folding_ranges
from swarmdsl.ide.server.hover import hover
from swarmdsl.ide.server.symbols import outline
from swarmdsl.importing.command import run as import_files
from swarmdsl.ir import System
from swarmdsl.lowering import lower
from swarmdsl.output import write
from swarmdsl.project.loader import Project
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.parse import parse
from swarmdsl.tools.compare.comparison import compare
from swarmdsl.tools.compare.report import format_changes
from swarmdsl.tools.diagram.formats import FORMATS
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.document import document
from swarmdsl.tools.merge.files import merge_files
from swarmdsl.tools.refactor.rename import rename

Action = Callable[[], object]
_MILLISECOND = 10**6


class NotApplicableError(Exception):
    """A phase does not apply to a model; the message is the first diagnostic."""


class Model:
    """A model on disk, and the results of phases that others start from."""

    def __init__(self, folder: Path, files: Files) -> None:
        self.folder = folder
        self.files = files
        self.path = self._written("model", files)

    def _written(self, name: str, files: Files) -> Path:
        (self.folder / name).mkdir(parents=True, exist_ok=True)
        for file, text in files.items():
            (self.folder / name / file).write_text(text, encoding="utf-8")
        return self.folder / name / MODEL

    @cached_property
    def checked(self) -> Result:
        """The result of a check without errors."""
        result = pipeline.check([self.path])
        _expect_valid(result.report)
        return result

    @property
    def project(self) -> Project:
        """The linked syntax trees."""
        assert self.checked.valid is not None
        return self.checked.valid

    @property
    def system(self) -> System:
        """The intermediate representation."""
        assert self.checked.system is not None
        return self.checked.system

    def changed(self, digit: str) -> Path:
        """Write the model with other names of what has a number that ends with a digit."""
        name = re.compile(rf"\b([A-Zf]_?\d*{digit})\b")
        changed = {file: name.sub(r"\1x", text) for file, text in self.files.items()}
        return self._written(f"changed{digit}", changed)

    def emitted(self, *targets: str) -> Output:
        """Run the generators of targets."""
        report = Diagnostics()
        output = emit(self.system, [Request(target) for target in targets], report)
        _expect_valid(report)
        return output

    @cached_property
    def documents(self) -> list[Path]:
        """The state machines of the model as SCXML of the W3C."""
        report, requests = Diagnostics(), [Request("scxml", {"profile": "portable"})]
        files = emit(self.system, requests, report).get("scxml", [])
        _expect_valid(report)
        if not files:
            raise NotApplicableError("the model has no state machine")
        paths = [self.folder / file.path for file in files]
        for path, file in zip(paths, files, strict=True):
            path.write_text(file.text, encoding="utf-8")
        return paths


def _expect_valid(report: Diagnostics) -> None:
    if report.has_errors:
        errors = [found.message for found in report if found.severity.name == "ERROR"]
        raise NotApplicableError(errors[0])


def _parse(model: Model) -> Action:
    sources = [Source(name, text) for name, text in model.files.items()]
    return lambda: [parse(source, Diagnostics()) for source in sources]


def _check(model: Model) -> Action:
    return lambda: pipeline.check([model.path])


def _format(model: Model) -> Action:
    sources = [Source(name, text.replace("  ", " ")) for name, text in model.files.items()]
    return lambda: [format_source(source, Diagnostics()) for source in sources]


def _lower(model: Model) -> Action:
    return partial(lower, model.project)


def _print(model: Model) -> Action:
    return partial(print_system, model.system)


def _rename(model: Model) -> Action:
    return partial(rename, [model.path], "Go", "Gone", dry_run=True)


def _keystroke(model: Model) -> Action:
    workspace = Workspace([model.path])
    text = model.files[MODEL]
    at = text.index("\n", len(text) // 2)
    typed = f"{text[:at]} o{text[at:]}"

    def act() -> None:
        workspace.update({model.path: typed})
        list(workspace.report)

    return act


def _editor(model: Model) -> Action:
    workspace = Workspace([model.path])
    file = workspace.file(model.path)
    assert file is not None
    text = file.source.text
    word = text.rindex("Go")
    at = text.index("\n", word)

    def act() -> None:
        completions(workspace, file, at)
        hover(workspace, file, word)
        outline(file)
        folding_ranges(file.source)

    return act


def _emit(target: str, model: Model) -> Action:
    assert model.system
    return partial(model.emitted, target)


def _write(model: Model) -> Action:
    output = model.emitted("smach", "ros2")
    return partial(write, output, model.folder / "out", Diagnostics())


def _diagram(format_: str, model: Model) -> Action:
    return lambda: [FORMATS[format_](each) for each in diagrams(model.system)]


def _document(model: Model) -> Action:
    return partial(document, model.project)


def _diff(model: Model) -> Action:
    before = pipeline.check([model.changed("7")])
    _expect_valid(before.report)
    assert before.system is not None
    old = before.system

    def act() -> None:
        changes, breaking = compare(old, model.system)
        list(format_changes(changes, breaking, "text", _place))

    return act


def _place(span: Span) -> str:
    return f"{span.absolute.source.name}:{span.line}"


def _merge(model: Model) -> Action:
    ours, theirs = model.changed("7"), model.changed("3")
    return partial(merge_files, model.path, ours, theirs, Diagnostics())


def _import(model: Model) -> Action:
    paths = model.documents

    def act() -> None:
        _expect_valid(import_files("scxml", paths, (), None, force=False).report)

    return act


def _read_scxml(model: Model) -> Action:
    sources = [Source(path.name, path.read_text(encoding="utf-8")) for path in model.documents]
    return lambda: [read(source, Diagnostics()) for source in sources]


def _simulate(model: Model) -> Action:
    report, scenario = Diagnostics(), Scenario()
    swarms, machines = model.system.swarms, model.system.machines
    machine = None if len(swarms) == 1 else machines[0].name

    def act() -> None:
        subject = choose(model.system, [], machine, None, report)
        assert subject is not None
        cast = actors(subject, subject.create_robots({}), scenario, report)
        _expect_valid(report)
        simulate(World(model.system, cast, scenario, 1, []), [], _MILLISECOND)

    return act


TARGETS = [name for name in registry.BUILT_IN if name not in ("fitness", "frevo")]
"""Targets for models without an optimization."""

PHASES: Mapping[str, Callable[[Model], Action]] = {
    "parse": _parse,
    "check": _check,
    "format": _format,
    "lower": _lower,
    "print": _print,
    "rename": _rename,
    "keystroke": _keystroke,
    "editor": _editor,
    **{target: partial(_emit, target) for target in TARGETS},
    "write": _write,
    **{format_: partial(_diagram, format_) for format_ in FORMATS},
    "document": _document,
    "diff": _diff,
    "merge": _merge,
    "import": _import,
    "read SCXML": _read_scxml,
    "simulate": _simulate,
}
"""Prepare what a phase starts from, and return its work."""
