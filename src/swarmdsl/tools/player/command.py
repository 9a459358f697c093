"""Play a run, or recorded traces: `swarmc play`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.read_files import MOST_RECORDED
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Source
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.simulate.command import simulate
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.execution.testing.run_case import run_case
from swarmdsl.execution.testing.verdict import Verdict
from swarmdsl.project.read_source import decoded, read_bytes
from swarmdsl.tools.player.page import page
from swarmdsl.tools.player.record import RunRecorder, record_traces
from swarmdsl.tools.player.recording import Recording

Tell = Callable[[Diagnostics], None]


@dataclass(frozen=True)
class Played:
    """Result: True without errors, None if interrupted; and the page, if it was written."""

    succeeded: bool | None
    written: Path | None = None


def play_run(request: Request, out: Path, tell: Tell, other: Recording | None = None) -> Played:
    """Simulate a run and write its page; a run that fails is shown up to where it did.

    The page compares it with the other run, if there is one.
    """
    request = replace(request, trace="none")
    return recorded(
        lambda keep, recorder: simulate(replace(request, recorder=recorder), keep),
        out,
        tell,
        other,
    )


def read_other(request: Request, path: Path, tell: Tell) -> Recording | None:
    """Return the recording of a trace to compare with; None if it cannot be read."""
    report = Diagnostics()
    source = _source(path, report)
    recording = None
    if source is not None:
        of = replace(request, replay=(path,), events=None)
        recording = record_traces([source], _prepared(of, Diagnostics()), report)
        if recording is None and not report.has_errors:
            report.report("empty-trace", path=source.name)
    tell(report)
    return recording


def recorded(
    run: Callable[[Tell, RunRecorder], bool | None],
    out: Path,
    tell: Tell,
    other: Recording | None = None,
) -> Played:
    """Run something that tells a recorder, and write the page of what it has told."""
    recorder = RunRecorder()
    found: list[Diagnostic] = []

    def keep(report: Diagnostics) -> None:
        found.extend(report)
        tell(report)

    succeeded = run(keep, recorder)
    recording = recorder.recording(found)
    if recording is None:
        return Played(succeeded)
    return _written(recording, out, tell, succeeded, other)


def play_lines(request: Request, name: str, text: str, out: Path, tell: Tell) -> Played:
    """Write the page of a trace that is in memory, by a name for it."""
    prepared = _prepared(request, Diagnostics())
    recording = record_traces([Source(name, text)], prepared, Diagnostics())
    if recording is None:
        return Played(False)
    return _written(recording, out, tell, True)


def play_traces(
    request: Request,
    traces: Sequence[Path],
    out: Path,
    tell: Tell,
    other: Recording | None = None,
) -> Played:
    """Write the page of traces, of a model if one is named or found; show what can be read.

    The page compares them with the other run, if there is one.
    """
    report = Diagnostics()
    sources = []
    for path in traces:
        source = _source(path, report)
        if source is not None:
            sources.append(source)
    for source in sources:
        if not source.text.strip():
            report.report("empty-trace", path=source.name)
    recording = None
    if any(source.text.strip() for source in sources):
        prepared = prepare_traces(request, traces, report)
        recording = record_traces(sources, prepared, report)
    tell(report)
    if recording is None:
        return Played(False)
    return _written(recording, out, tell, not report.has_errors, other)


def play_test(verdict: Verdict, out: Path, tell: Tell) -> Played:
    """Run a test again with the first seed with which it fails, if any, and write its page."""

    def run(keep: Tell, recorder: RunRecorder) -> bool:
        report = Diagnostics()
        run_case(
            verdict.case,
            next(iter(verdict.failures), verdict.seeds[0]),
            lambda line: None,
            recorder,
        )
        verdict.report(report)
        keep(report)
        return True

    return recorded(run, out, tell)


def _source(path: Path, report: Diagnostics) -> Source | None:
    """Return a trace; one with bytes that are no UTF-8, which are reported, without these."""
    data = read_bytes(path, None, report, "a trace", MOST_RECORDED)
    if data is None:
        return None
    source = decoded(path, data, None, report)
    if source is None and b"\0" not in data:
        return Source(str(path), data.decode(errors="replace"), path)
    return source


def prepare_traces(
    request: Request, traces: Sequence[Path], report: Diagnostics
) -> Prepared | None:
    """Return the subject of traces; None without a model, which shows the traces alone."""
    return _prepared(replace(request, replay=tuple(traces)), report)


def _prepared(request: Request, report: Diagnostics) -> Prepared | None:
    found = Diagnostics()
    prepared = prepare(request, found)
    if request.paths or not found.count_of("nothing-to-compile"):
        report.include(found)
    return prepared


def _written(
    recording: Recording,
    out: Path,
    tell: Tell,
    succeeded: bool | None,
    other: Recording | None = None,
) -> Played:
    report = Diagnostics()
    try:
        with write_stream(out) as stream:
            stream.write(page(recording, other))
    except OSError as error:
        report_unwritten(out, error, report)
        tell(report)
        return Played(False)
    return Played(succeeded, out)
