"""Number of diagnostics per code for each real file, so that changes show.

The files are not part of the project; here they are called by what they are made of (SHA-256).
"""

from __future__ import annotations

import hashlib
import os
from collections import Counter
from pathlib import Path

import pytest

from swarmdsl.importing.command import Format, run

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
GOLDEN = Path(__file__).with_name("warnings.txt")
FILES: list[tuple[Format, Path]] = [
    *(("scxml", path) for path in sorted((CORPUS / "scxml").glob("*.xml"))),
    *(("scxml", path) for path in sorted((CORPUS / "statecharts").glob("*/*.scxml"))),
    *(("adf", path) for path in sorted((CORPUS / "adf").glob("*.json"))),
]


@pytest.mark.skipif(not FILES, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
def test_warnings(bless: bool) -> None:
    lines = []
    for format_, path in FILES:
        report = run(format_, [path], [], None, force=False).report
        counts = Counter(found.code for found in report)
        said = "".join(f"  {code} {number}" for code, number in sorted(counts.items()))
        lines.append(f"{format_} {hashlib.sha256(path.read_bytes()).hexdigest()[:12]}{said}\n")
    made = "".join(sorted(lines))
    if bless:
        GOLDEN.write_text(made, encoding="utf-8")
    assert made == GOLDEN.read_text(encoding="utf-8")
