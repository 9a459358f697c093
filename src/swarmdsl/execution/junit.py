"""Results as JUnit XML, for Jenkins, GitLab and others."""

from __future__ import annotations

from collections.abc import Sequence
from io import StringIO
from pathlib import PurePath
from typing import Literal

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.records import dataclass

# Characters that XML cannot represent.
_CONTROL = dict.fromkeys([*range(9), 11, 12, *range(14, 32), 0xFFFE, 0xFFFF], "\ufffd")


@dataclass(frozen=True)
class Remark:
    """Reason that a case did not pass: a `failure`, an `error`, or `skipped`."""

    tag: Literal["failure", "error", "skipped"]
    message: str
    kind: str = ""
    text: str = ""

    @classmethod
    def of(
        cls,
        tag: Literal["failure", "error"],
        found: Sequence[Diagnostic],
        kind: str = "",
        more: str = "",
    ) -> Remark:
        """Return what diagnostics say; `more` follows them."""
        stream = StringIO()
        render(found, "text", stream)
        message = found[-1].message if found else "the model has errors"
        return cls(tag, message, kind or found[-1].name, stream.getvalue() + more)


@dataclass(frozen=True)
class Case:
    """A test or a property; without a remark it passed."""

    name: str
    class_name: str
    seconds: float = 0.0
    remark: Remark | None = None


@dataclass(frozen=True)
class Suite:
    """Cases that belong together; `output` are lines about all of them."""

    name: str
    cases: tuple[Case, ...]
    output: tuple[str, ...] = ()
    seconds: float = 0.0


def document(name: str, suites: Sequence[Suite]) -> str:
    """Return the file."""
    root = etree.Element("testsuites", name=name)
    root.set("tests", str(sum(len(suite.cases) for suite in suites)))
    for key, tag in (("failures", "failure"), ("errors", "error")):
        root.set(key, str(sum(_count(suite, tag) for suite in suites)))
    root.set("time", f"{sum(suite.seconds for suite in suites):.3f}")
    root.extend(map(_suite, suites))
    etree.indent(root)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8").decode() + "\n"


def class_name(path: PurePath, suffix: str) -> str:
    """Convert a path to a Java class name: `examples.storage.shift`."""
    parts = [part for part in path.parts if part not in ("..", ".", path.anchor)]
    return ".".join([*parts[:-1], parts[-1].removesuffix(suffix)])


def _count(suite: Suite, tag: str) -> int:
    return sum(case.remark is not None and case.remark.tag == tag for case in suite.cases)


def _suite(suite: Suite) -> etree._Element:
    made = etree.Element(
        "testsuite",
        name=_text(suite.name),
        tests=str(len(suite.cases)),
        failures=str(_count(suite, "failure")),
        errors=str(_count(suite, "error")),
        skipped=str(_count(suite, "skipped")),
        time=f"{suite.seconds:.3f}",
    )
    for case in suite.cases:
        inner = etree.SubElement(
            made,
            "testcase",
            name=_text(case.name),
            classname=_text(case.class_name),
            time=f"{case.seconds:.3f}",
        )
        if case.remark is not None:
            remark = etree.SubElement(inner, case.remark.tag, message=_text(case.remark.message))
            if case.remark.kind:
                remark.set("type", case.remark.kind)
            remark.text = _text(case.remark.text) or None
    if suite.output:
        output = etree.SubElement(made, "system-out")
        output.text = _text("".join(f"{line}\n" for line in suite.output))
    return made


def _text(text: str) -> str:
    return text.translate(_CONTROL)
