"""Modules of JavaScript as one script."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.tools.player.modules import BadModuleError, join

ONE = r"""// A comment.
export const one = "a  b" + ' {  } ';
export const pattern = /[ /"] , {2}/g;
/** Told
 * here. */
export function two(a, b) {
  return `x  ${a ? `y { ${b}  }` : "}  `"} , z`;
}
"""
OTHER = 'import { one as first, two } from "./one.js";\nexport const said = two(first, [1, 2]);\n'


def test_strings_templates_and_patterns_stay(tmp_path: Path) -> None:
    (tmp_path / "one.js").write_text(ONE, encoding="utf-8")
    (tmp_path / "other.js").write_text(OTHER, encoding="utf-8")
    script = join(tmp_path, "other.js")
    for kept in ('"a  b"', "' {  } '", '/[ /"] , {2}/g', '`x  ${a ? `y { ${b}  }` : "}  `"} , z`'):
        assert kept in script
    assert "comment" not in script
    assert "Told" not in script
    assert "const{one:first,two}=$one;\nconst said=two(first,[1,2]);" in script


@pytest.mark.parametrize(
    "text",
    ['import * as all from "./one.js";', "export default 1;", 'import { a } from "./bad.js";'],
    ids=["star", "default", "itself"],
)
def test_other_imports_and_exports_are_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "bad.js").write_text(text, encoding="utf-8")
    with pytest.raises(BadModuleError):
        join(tmp_path, "bad.js")
