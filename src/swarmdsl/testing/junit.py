"""What came of the tests as JUnit XML, as Jenkins, GitLab and others read it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import PurePath

from swarmdsl.diagnostics import Diagnostic
from swarmdsl.render import render
from swarmdsl.simulate.trace import as_text
from swarmdsl.testing.discovery import SUFFIX
from swarmdsl.testing.outcome import FileOutcome
from swarmdsl.testing.verdict import Verdict
from swarmdsl.xml import Element, document


def junit(outcomes: Iterable[FileOutcome]) -> bytes:
    """The file, with a suite for each test file, and a case for each test."""
    root = Element("testsuites", name="swarmc test")
    counts = [0, 0, 0]
    seconds = 0.0
    for outcome in outcomes:
        suite = _suite(outcome)
        root.children.append(suite)
        for place, key in enumerate(("tests", "failures", "errors")):
            counts[place] += int(suite.attributes[key])
        seconds += outcome.seconds
    for key, count in zip(("tests", "failures", "errors"), counts, strict=True):
        root.attributes[key] = str(count)
    root.attributes["time"] = f"{seconds:.3f}"
    return document(root).encode()


def _suite(outcome: FileOutcome) -> Element:
    name = outcome.path.as_posix()
    errors = 0 if outcome.read else 1
    suite = Element(
        "testsuite",
        name=name,
        tests=str(len(outcome.verdicts) + errors),
        failures=str(sum(not verdict.passed for verdict, _ in outcome.verdicts)),
        errors=str(errors),
        skipped="0",
        time=f"{outcome.seconds:.3f}",
    )
    class_name = _class_name(outcome.path)
    if errors:
        case = suite.add("testcase", name=name, classname=class_name, time="0.000")
        error = case.add("error", message=_message(outcome.problems), type="error")
        error.text = _rendered(outcome.problems)
    for verdict, found in outcome.verdicts:
        case = suite.add(
            "testcase",
            name=verdict.case.name,
            classname=class_name,
            time=f"{verdict.seconds:.3f}",
        )
        if not verdict.passed:
            failure = case.add("failure", message=_message(found), type=found[-1].name)
            failure.text = _rendered(found) + _last(verdict)
    return suite


def _class_name(path: PurePath) -> str:
    """The path with dots, as classes of Java have it: `examples.storage.shift`."""
    parts = [part for part in path.parts if part not in ("..", ".", path.anchor)]
    return ".".join([*parts[:-1], parts[-1].removesuffix(SUFFIX)])


def _rendered(found: Sequence[Diagnostic]) -> str:
    stream = StringIO()
    render(found, "text", stream)
    return stream.getvalue()


def _last(verdict: Verdict) -> str:
    return "".join(f"{as_text(line)}\n" for line in verdict.last)


def _message(found: Sequence[Diagnostic]) -> str:
    return found[-1].message if found else "the model has errors"
