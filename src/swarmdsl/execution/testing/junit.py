"""Test results as JUnit XML, for Jenkins, GitLab and others."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import PurePath

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.diagnostics.render import render
from swarmdsl.execution.simulate.trace import as_text
from swarmdsl.execution.testing.discovery import SUFFIX
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.verdict import Verdict

# Characters that XML cannot represent.
_CONTROL = dict.fromkeys([*range(9), 11, 12, *range(14, 32), 0xFFFE, 0xFFFF], "\ufffd")


def junit(outcomes: Iterable[FileOutcome]) -> bytes:
    """Return the file, with a suite per test file and a case per test."""
    root = etree.Element("testsuites", name="swarmc test")
    counts = [0, 0, 0]
    seconds = 0.0
    for outcome in outcomes:
        suite = _suite(outcome)
        root.append(suite)
        for place, key in enumerate(("tests", "failures", "errors")):
            counts[place] += int(suite.get(key, "0"))
        seconds += outcome.seconds
    for key, count in zip(("tests", "failures", "errors"), counts, strict=True):
        root.set(key, str(count))
    root.set("time", f"{seconds:.3f}")
    etree.indent(root)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8") + b"\n"


def _suite(outcome: FileOutcome) -> etree._Element:
    name = _text(outcome.path.as_posix())
    unread = [(each.name, each.problems) for each in outcome.unread]
    if not outcome.read:
        unread = [(outcome.path.as_posix(), outcome.problems)]
    suite = etree.Element(
        "testsuite",
        name=name,
        tests=str(len(outcome.verdicts) + len(unread)),
        failures=str(sum(not verdict.passed for verdict, _ in outcome.verdicts)),
        errors=str(len(unread)),
        skipped="0",
        time=f"{outcome.seconds:.3f}",
    )
    class_name = _class_name(outcome.path)
    for title, problems in unread:
        case = etree.SubElement(
            suite, "testcase", name=_text(title), classname=class_name, time="0.000"
        )
        error = etree.SubElement(case, "error", message=_message(problems), type="error")
        error.text = _text(_rendered(problems))
    for verdict, found in outcome.verdicts:
        case = etree.SubElement(
            suite,
            "testcase",
            name=_text(verdict.case.name),
            classname=class_name,
            time=f"{verdict.seconds:.3f}",
        )
        if not verdict.passed:
            failure = etree.SubElement(
                case, "failure", message=_message(found), type=found[-1].name
            )
            failure.text = _text(_rendered(found) + _last(verdict))
    if outcome.remarks:
        output = etree.SubElement(suite, "system-out")
        output.text = _text("".join(f"{remark}\n" for remark in outcome.remarks))
    return suite


def _class_name(path: PurePath) -> str:
    """Convert a path to a Java class name: `examples.storage.shift`."""
    parts = [part for part in path.parts if part not in ("..", ".", path.anchor)]
    return _text(".".join([*parts[:-1], parts[-1].removesuffix(SUFFIX)]))


def _rendered(found: Sequence[Diagnostic]) -> str:
    stream = StringIO()
    render(found, "text", stream)
    return stream.getvalue()


def _last(verdict: Verdict) -> str:
    return "".join(f"{as_text(line)}\n" for line in verdict.last)


def _message(found: Sequence[Diagnostic]) -> str:
    return _text(found[-1].message if found else "the model has errors")


def _text(text: str) -> str:
    return text.translate(_CONTROL)
