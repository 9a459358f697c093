"""Read and decode source files, and report what is wrong with them."""

from __future__ import annotations

from codecs import BOM_UTF8
from pathlib import Path

from swarmdsl.base.diagnostics.advice import Advice, meant
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.read_files import MOST, OddFileError, TooLargeError, is_file, read_file
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import closest, did_you_mean, suggest
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.syntax.parser.doc_comments import CONTROL

# Control characters of ASCII except tab and line ends.
_CONTROL = bytes([*range(0x01, 0x09), 0x0B, 0x0C, *range(0x0E, 0x20), 0x7F])

_MODEL = "a .swarm file"
# A hint for a missing file names at most this many.
_FEW = 5
# Similarity from which a suffix counts as a misspelled `.swarm`.
_SAME_SUFFIX = 0.75


def read_source(
    path: Path,
    at: Span | None,
    report: Diagnostics,
    expected: str = _MODEL,
    most: int = MOST,
) -> Source | None:
    """Read and decode a file; report a failure at `at` and return None."""
    content = read_bytes(path, at, report, expected, most)
    return decoded(path, content, at, report) if content is not None else None


def read_bytes(
    path: Path,
    at: Span | None,
    report: Diagnostics,
    expected: str = _MODEL,
    most: int = MOST,
) -> bytes | None:
    """Read the bytes of a file; report a failure at `at` and return None."""
    try:
        return read_file(path, most)
    except OSError as error:
        report_unreadable(path, error, at, report, expected)
    return None


def report_unreadable(
    path: Path,
    error: OSError,
    at: Span | None,
    report: Diagnostics,
    expected: str = _MODEL,
) -> None:
    """Report at `at` why a file could not be read."""
    if isinstance(error, FileNotFoundError):
        report.report("file-not-found", at, path=path, help=_similar_file(path))
    elif isinstance(error, OddFileError):
        help_: str = "save what comes out of it in a file first"
        if error.kind == "a folder":
            help_ = "name a file in it"
            if expected == _MODEL and at is not None:
                text = f"{help_}, or write `import ros` if it has interfaces of ROS"
                help_ = Advice(text, "write import", "import ros")
        report.report("not-a-file", at, path=path, actual=error.kind, expected=expected, help=help_)
    elif isinstance(error, TooLargeError):
        report.report("too-large", at, path=path, most=error.most // 2**20)
    else:
        reason = (error.strerror or str(error)).lower()
        report.report("unreadable-file", at, path=path, reason=reason)


def decoded(path: Path, data: bytes, at: Span | None, report: Diagnostics) -> Source | None:
    """Decode the content of a file as UTF-8; report a failure at `at` and return None."""
    try:
        text = data.removeprefix(BOM_UTF8).decode()
    except UnicodeDecodeError as error:
        _report_encoding(path, at, data, error, report)
        return None
    if "\0" in text:
        report.report("not-text", at, path=path, help="this looks like a binary file")
        return None
    return Source(str(path), _unified(text), path)


def _report_encoding(
    path: Path, at: Span | None, data: bytes, error: UnicodeDecodeError, report: Diagnostics
) -> None:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        report.report("not-text", at, path=path, help="it looks like UTF-16: save it as UTF-8")
    elif b"\0" in data:
        report.report("not-text", at, path=path, help="this looks like a binary file")
    else:
        data = error.object  # without a byte order mark
        readable = _unified(data[: error.start].decode())
        rest = _unified(data[error.start :].decode(errors="replace"))
        source = Source(str(path), readable + rest, path)
        report.report(
            "not-text",
            Span(source, len(readable), len(readable) + 1),
            path=path,
            related=(Label(at, "imported here"),) if at else (),
            help="save it as UTF-8",
        )


def _unified(text: str) -> str:
    """Text with uniform line ends."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _similar_file(path: Path) -> str | None:
    if is_file(f"{path}{SUFFIX}"):
        return meant(f"{path.name}{SUFFIX}")
    suffix = closest(path.suffix, (SUFFIX,), _SAME_SUFFIX) or path.suffix or SUFFIX
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.suffix == suffix]
    except FileNotFoundError:
        return f"there is no folder `{path.parent}`"
    except OSError:
        return None
    if suffix == SUFFIX or not 0 < len(names) <= _FEW:
        return did_you_mean(path.name, names)
    return suggest(path.name, sorted(names), f"files that end with `{suffix}` there")


def without_control_characters(source: Source, report: Diagnostics) -> Source:
    """Replace control characters by spaces and report them."""
    # Ten times as fast as the pattern for a text without control characters.
    data = source.text.encode("utf-8", "surrogatepass")
    if len(data.translate(None, _CONTROL)) == len(data) and (
        source.text.isascii() or not CONTROL.search(source.text)
    ):
        return source
    found = list(CONTROL.finditer(source.text))
    for each in found:
        place = Span(source, each.start(), each.end())
        report.report(
            "control-character",
            place,
            code=f"U+{ord(each[0]):04X}",
            help=Advice("remove it", "remove character"),
        )
    return replace(source, text=CONTROL.sub(" ", source.text))
