"""Keyword lists in the grammars of editors: Vim, Emacs, tree-sitter, TextMate (VS Code).

All but the last have them between two marked lines. JSON has no comments: in the TextMate grammar
the alternations of reserved words and of first words of items are replaced wherever they are.
"""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from swarmdsl.syntax.pegen.keywords import EMACS_REGEX, PYTHON_REGEX, VIM_REGEX, Keywords
from swarmdsl.syntax.types import PRIMITIVES
from swarmdsl.syntax.units import PERCENT, UNITS

VIM = Path("editors/vim/syntax/swarm.vim")
EMACS = Path("editors/emacs/swarm-mode.el")
CAPTURES = Path("editors/tree-sitter/queries/highlights.scm")
SCANNER = Path("editors/tree-sitter/src/scanner.c")
TEXTMATE = Path("editors/vscode/syntaxes/swarm.tmLanguage.json")
SNIPPETS = Path("src/swarmdsl/ide/server/snippets.json")

_MARKED = re.compile(r"(?<=made by `make parser`\n).*?(?=^[\";/]+ end$)", re.DOTALL | re.MULTILINE)
_DECLARATION = "declaration"
# In the TextMate grammar: the words that begin an item of a state machine, and what ends the
# parameters of an operation.
_ITEMS = re.compile(
    r"\\b\(\?:after\|[a-z|]+\)\\b"
    r"(?:\|\\b[a-z]+(?:\\s\+(?:[a-z]+|\(\?:[a-z|]+\))\\b|\(\?=\[ \\t\]\*\[[^\]]*\]\)))*"
)
_OPERATION_END = re.compile(r"(?<=\(\?=\[\{\}\]\|)\\b\(\?:behavior\|[a-z|]+\)\\b")


class MarksMissingError(Exception):
    """A file for an editor has no marked lines for the keywords."""


def editor_files(root: Path, keywords: Keywords) -> Iterator[tuple[Path, str]]:
    """Files of editors with the keywords of today."""
    marked = {VIM: _vim, EMACS: _emacs, CAPTURES: _captures, SCANNER: _units}
    for path, lines in marked.items():
        text = (root / path).read_text(encoding="utf-8")
        generated = "".join(f"{line}\n" for line in lines(keywords))
        replaced, count = _MARKED.subn(generated.replace("\\", r"\\"), text)
        if count != 1:
            raise MarksMissingError(f"{path}: the lines made by `make parser` are not marked")
        yield root / path, replaced
    text = (root / TEXTMATE).read_text(encoding="utf-8")
    yield root / TEXTMATE, _textmate(text, keywords)


def missing_words(root: Path, keywords: Keywords) -> Iterator[str]:
    """Messages about keywords that the hand-written parts of the editor support lack."""
    grammar = json.loads((root / TEXTMATE).read_text(encoding="utf-8"))
    coloured = {word for text in _strings(grammar) for word in _words(text)}
    for word in sorted(keywords.contextual - coloured):
        yield f"{TEXTMATE}: no rule for the contextual keyword `{word}`"
    snippets = json.loads((root / SNIPPETS).read_text(encoding="utf-8"))
    used = {word for text in _strings(snippets) for word in _words(text)}
    for word in sorted((keywords.statements | keywords.top_level) - used):
        yield f"{SNIPPETS}: no snippet for `{word}`"


def _strings(value: Any) -> Iterator[str]:
    """Patterns of a TextMate grammar, or lines of snippets."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        for inner in value:
            yield from _strings(inner)
    elif isinstance(value, dict):
        for key, inner in value.items():
            if key not in ("about", "comment", "name", "where"):
                yield from _strings(inner)


def _words(text: str) -> list[str]:
    r"""Words of a regular expression or a snippet, without escapes such as `\\b`."""
    return re.findall(r"[a-z]+", re.sub(r"\\.", " ", text))


def _group(keywords: Keywords, word: str) -> str:
    found = (group for group, words in keywords.groups.items() if word in words)
    return next(found, _DECLARATION)


def _in_group(keywords: Keywords, group: str) -> list[str]:
    return sorted(word for word in keywords.reserved if _group(keywords, word) == group)


def _vim(keywords: Keywords) -> Iterator[str]:
    for group in (_DECLARATION, *keywords.groups):
        yield from _wrapped(_in_group(keywords, group), f"syn keyword swarm{group.capitalize()} ")
    yield from _wrapped(PRIMITIVES, "syn keyword swarmType ")
    for word in sorted(keywords.contextual):
        follow = keywords.context(word, VIM_REGEX)
        group = _group(keywords, word).capitalize()
        yield rf"syn match swarm{group} #\<{word}\>\ze[ \t]*{follow}#"
    names = r"\|".join(sorted(keywords.naming - {"function"}))
    yield rf"syn match swarmName #\%(\<\%({names}\)\)\@<=\s\+\h\w*#"


def _emacs(keywords: Keywords) -> Iterator[str]:
    constants = keywords.groups["outcome"] | keywords.groups["boolean"]
    yield "(defconst swarm--keywords"
    yield from _quoted(sorted(keywords.reserved - constants))
    yield '  "Words that cannot be names.")'
    yield ""
    yield "(defconst swarm--constants"
    yield from _quoted(sorted(constants), end="))")
    yield ""
    yield "(defconst swarm--types"
    yield from _quoted(PRIMITIVES, end="))")
    yield ""
    yield "(defconst swarm--naming"
    yield from _quoted(sorted(keywords.naming - {"function"}))
    yield '  "Words that the name of a new element follows.")'
    yield ""
    yield "(defconst swarm--contextual"
    rows = []
    for word in sorted(keywords.contextual):
        follow = keywords.context(word, EMACS_REGEX)
        regex = rf"\_<\({word}\)\_>[ \t]*{follow}".replace("\\", "\\\\").replace('"', '\\"')
        rows.append(f'"{regex}"'.replace("\\\\t", "\\t"))
    yield "  '(" + "\n    ".join(rows) + ")"
    yield '  "Words that are keywords only before certain others.")'


def _captures(keywords: Keywords) -> Iterator[str]:
    names = {"include": "keyword.import", "outcome": "constant.builtin", "boolean": "boolean"}
    for group in (_DECLARATION, *keywords.groups):
        words = [w for w in keywords.reserved | keywords.contextual if _group(keywords, w) == group]
        yield from _quoted(sorted(words), "[", f"] @{names.get(group, 'keyword')}")
    yield "((identifier) @type.builtin"
    yield from _quoted(PRIMITIVES, "  (#any-of? @type.builtin ", "))")


def _units(_: Keywords) -> Iterator[str]:
    units = ", ".join(f'"{unit}"' for unit in UNITS if unit != PERCENT.name)
    yield "static const char *const UNITS[] = {"
    yield from textwrap.wrap(f"{units}, NULL,", 98, initial_indent="  ", subsequent_indent="  ")
    yield "};"


def _wrapped(words: Iterable[str], prefix: str) -> list[str]:
    return textwrap.wrap(" ".join(words), 100, initial_indent=prefix, subsequent_indent=prefix)


def _quoted(words: Iterable[str], begin: str = "  '(", end: str = ")") -> list[str]:
    text = " ".join(f'"{word}"' for word in words)
    lines = textwrap.wrap(text, 98, initial_indent=begin, subsequent_indent="    ")
    return [*lines[:-1], lines[-1] + end]


def _textmate(text: str, keywords: Keywords) -> str:
    items = frozenset[str]().union(
        *(keywords.first[f"{block}Item"] for block in ("Machine", "State", "Parallel", "Region"))
    )
    begins = _alternatives(items & keywords.reserved)
    for word in sorted(items - keywords.reserved):
        following = sorted(keywords.modifiers.get(word, ()))
        if not following:
            begins += rf"|\b{word}(?=[ \t]*{keywords.context(word, PYTHON_REGEX)})"
        elif len(following) == 1:
            begins += rf"|\b{word}\s+{following[0]}\b"
        else:
            begins += rf"|\b{word}\s+(?:{'|'.join(following)})\b"
    # A contextual word can be a parameter.
    ends = (keywords.first["ComponentItem"] & keywords.reserved) - {"in", "out"}
    grammar = json.loads(text)
    reserved = grammar["repository"]["reserved"]["match"]
    for old in sorted({*_strings(grammar)}, key=len, reverse=True):
        new = old
        if old == reserved:
            new = _alternatives(keywords.reserved)
        else:
            new = _ITEMS.sub(lambda _: begins, new)
            new = _OPERATION_END.sub(lambda _: _alternatives(ends), new)
        if new != old:
            text = text.replace(
                json.dumps(old, ensure_ascii=False), json.dumps(new, ensure_ascii=False)
            )
    return text


def _alternatives(words: Iterable[str]) -> str:
    return rf"\b(?:{'|'.join(sorted(words))})\b"
