"""Run the generators of the requested targets on the IR."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeVar

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Label, Severity
from swarmdsl.base.errors import describe_exception
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.relative_paths import clash_key, stays_inside
from swarmdsl.base.source import Span
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator, OutputFile
from swarmdsl.codegen.features import WAYS_OUT, unsupported
from swarmdsl.codegen.options import options_of, parse_options
from swarmdsl.ir import System

# Errors of a target that no option avoids.
_UNABLE = frozenset({"unsupported-construct", "bad-identifier", "generator-failed"})

Output = dict[str, list[OutputFile]]
"""The files of each target, in the order of the requests."""

_Made = TypeVar("_Made")


@dataclass(frozen=True)
class Request:
    """Target to build, with its options as strings and the `places` of the options.

    If it is not `required` and cannot express the model or fails, it is left out with a warning,
    as long as another target succeeds.
    """

    target: str
    options: Mapping[str, str] = field(default_factory=dict)
    required: bool = True
    places: Mapping[str, Span] = field(default_factory=dict)


def emit(system: System, requests: Sequence[Request], report: Diagnostics) -> Output:
    """Return the files of the requested targets; incomplete if errors were reported."""
    output: Output = {}
    left_out: dict[str, Diagnostics] = {}
    merged = _merge_requests(requests, report)
    for request in merged:
        found = Diagnostics()
        files = _emit_target(system, request, merged, found)
        if not request.required and _is_unable(found):
            left_out[request.target] = found
            continue
        report.include(found)
        if files is not None:
            output[request.target] = files
    for target, found in left_out.items():
        # A warning if another target is built, else the errors.
        if output:
            _report_left_out(target, found, report)
        else:
            report.include(found)
    _check_collisions(output, report)
    return output


def _merge_requests(requests: Sequence[Request], report: Diagnostics) -> list[Request]:
    """Return one request a target; duplicates may add options but not contradict."""
    merged: dict[str, Request] = {}
    for request in requests:
        known = merged.setdefault(request.target, request)
        for name, value in request.options.items():
            if known.options.get(name, value) != value:
                fault = f"option `{name}` is given as `{known.options[name]}` and as `{value}`"
                place = request.places.get(name)
                report.report("bad-option", place, target=request.target, fault=fault)
        merged[request.target] = Request(
            request.target,
            {**request.options, **known.options},
            known.required or request.required,
            {**request.places, **known.places},
        )
    return list(merged.values())


def _emit_target(
    system: System, request: Request, built: Iterable[Request], report: Diagnostics
) -> list[OutputFile] | None:
    """Return the files of one of the `built` targets, or None if it fails."""
    generator = registry.load(request.target)
    if generator is None:
        hint = registry.similar_target(request.target)
        report.report("unknown-target", name=request.target, help=hint)
        return None
    if isinstance(generator, registry.Broken):
        _report_broken(request.target, generator.reason, report)
        return None
    uses = _run_guarded(
        generator, lambda: unsupported(generator.machines(system), generator.supports), report
    )
    for feature, place in uses or ():
        report.report(
            "unsupported-construct",
            place,
            target=request.target,
            construct=feature.value,
            help=WAYS_OUT.get(feature),
        )
    given = {**_implied_options(generator, request, built), **request.options}
    options = parse_options(generator, given, report, request.places)
    if report.has_errors:
        return None
    files = _run_guarded(generator, lambda: generator.emit(system, options, report), report)
    if files is None or not _are_files(files, request.target, report):
        return None
    for file in files:
        if not stays_inside(file.path):
            report.report("outside-output", file.origin, target=request.target, path=file.path)
    if not files and not report.has_errors:
        report.report("nothing-to-generate", target=request.target)
    return files


def _implied_options(
    generator: Generator, request: Request, built: Iterable[Request]
) -> dict[str, str]:
    """Return the options that are true because of another target in the build."""
    options = options_of(generator)
    beside = {name: each.beside for name, each in options.items() if each.beside}
    if not beside:
        return {}
    own = {"", *(f"{name}={value}" for name, value in _all_options(request))}
    beside = {name: other for name, other in beside.items() if options[name].only in own}
    chosen = {
        f"{each.target}.{name}={value}" for each in built for name, value in _all_options(each)
    }
    return {name: "true" for name, other in beside.items() if other in chosen}


def _all_options(request: Request) -> Iterable[tuple[str, str]]:
    """Return the options of a target: defaults, overridden by the given ones."""
    generator = registry.load(request.target)
    known = options_of(generator) if isinstance(generator, Generator) else {}
    return {**{name: str(each.default) for name, each in known.items()}, **request.options}.items()


def _run_guarded(
    generator: Generator, make: Callable[[], Iterable[_Made]], report: Diagnostics
) -> list[_Made] | None:
    """Return the results of a generator's function, or None if it fails."""
    if generator.target in registry.BUILT_IN:
        return list(make())
    try:
        return list(make())
    # A bug in third-party code must not look like one of swarmdsl.
    except (Exception, SystemExit) as error:
        reason = describe_exception(f"running the generator of target {generator.target}", error)
        _report_broken(generator.target, reason, report)
        return None


def _are_files(files: Iterable[object], target: str, report: Diagnostics) -> bool:
    for file in files:
        if not (
            isinstance(file, OutputFile)
            and isinstance(file.path, str)
            and isinstance(file.text, str)
        ):
            _report_broken(target, f"it returned {file!r:.80}, not an `OutputFile`", report)
            return False
    return True


def _report_broken(target: str, reason: str, report: Diagnostics) -> None:
    hint = "`--debug` shows where it fails"
    report.report("generator-failed", target=target, reason=reason, help=hint)


def _errors(found: Diagnostics) -> list[Diagnostic]:
    return [diagnostic for diagnostic in found if diagnostic.severity is Severity.ERROR]


def _is_unable(found: Diagnostics) -> bool:
    return found.has_errors and all(error.name in _UNABLE for error in _errors(found))


def _report_left_out(target: str, found: Diagnostics, report: Diagnostics) -> None:
    first, *others = _errors(found)
    notes = [first.message]
    if others:
        notes.append(f"and {len(others)} more: `--target {target}` shows them")
    place = first.primary.span if first.primary else None
    report.report("target-left-out", place, notes=tuple(notes), help=first.help, target=target)


def _check_collisions(output: Output, report: Diagnostics) -> None:
    """Report equal paths, and files where another path needs a folder."""
    files: dict[str, OutputFile] = {}
    folders: dict[str, OutputFile] = {}
    for target, made in output.items():
        for file in made:
            path = f"{target}/{file.path}"
            key = clash_key(path)
            above = [key[:at] for at, character in enumerate(key) if character == "/"]
            other = files.get(key) or folders.get(key)
            for folder in above:
                other = other or files.get(folder)
                folders.setdefault(folder, file)
            if other is not None:
                _report_collision(path, target, file, other, report)
            files.setdefault(key, file)


def _report_collision(
    path: str, target: str, file: OutputFile, other: OutputFile, report: Diagnostics
) -> None:
    related = (Label(other.origin, "the other one comes from here"),) if other.origin else ()
    same = other.path == file.path
    notes = () if same else (f"the other one is `{target}/{other.path}`",)
    report.report("output-collision", file.origin, related=related, notes=notes, path=path)
