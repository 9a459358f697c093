"""Pygments lexer for .swarm files, used by Sphinx, LaTeX (minted) and consoles.

Registered as an entry point of Pygments: a code block of language `swarm` needs no setup.
"""

from __future__ import annotations

from typing import Any, ClassVar

from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import (
    Comment,
    Keyword,
    Name,
    Number,
    Operator,
    Punctuation,
    String,
    Text,
    Whitespace,
)

from swarmdsl.syntax.parser.keywords import CONTEXTUAL, GROUPS, NAMING, RESERVED
from swarmdsl.syntax.parser.literals import PERCENT_SIGN, UNIT_NAMES
from swarmdsl.syntax.types import PRIMITIVES

_NAME = r"[A-Za-z_]\w*"
_NAMED = "|".join(sorted(NAMING))
_NUMBER = r"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"
_DECLARATIONS = sorted(RESERVED - frozenset().union(*GROUPS.values()))


def _words(group: str) -> Any:
    return words(sorted(GROUPS[group] & RESERVED), suffix=r"\b")


class SwarmLexer(RegexLexer):  # type: ignore[misc]  # Pygments has no types
    """Lexer of swarm models."""

    name = "Swarm"
    aliases: ClassVar[list[str]] = ["swarm"]
    filenames: ClassVar[list[str]] = ["*.swarm"]
    tokens: ClassVar[dict[str, Any]] = {
        "root": [
            (r"\s+", Whitespace),
            (r"///(?!/)[^\n]*", Comment.Special),
            (r"//[^\n]*", Comment.Single),
            (r"/\*(?:[^*]|\*(?!/))*\*/", Comment.Multiline),
            (r'"(?=(?:[^"\\\n]|\\[^\n])*")', String, "string"),
            (r"(\.)(done)\b", bygroups(Punctuation, Keyword)),
            # A field may have the name of a keyword.
            (rf"(\.)({_NAME})", bygroups(Punctuation, Name.Attribute)),
            (
                rf"({_NAME})(\s*)(:)(?=\s*[A-Za-z_])",
                bygroups(Name.Variable, Whitespace, Punctuation),
            ),
            # So may a port.
            (
                rf"(inout|in|out|connect)([ \t]+)({_NAME})(?=[ \t]*(?::|->))",
                bygroups(Keyword, Whitespace, Name.Variable),
            ),
            (rf"(->)([ \t]*)({_NAME})", bygroups(Operator, Whitespace, Name)),
            (words(sorted(PRIMITIVES), prefix=r"\b", suffix=r"\b"), Keyword.Type),
            (rf"{_NAME}(?=\s*=(?!=))", Name.Attribute),
            (
                rf"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?(?:[ \t]*(?:(?:{UNIT_NAMES})\b|{PERCENT_SIGN}))?",
                Number,
            ),
            (rf"({_NAME})(/)({_NAME})", bygroups(Name.Namespace, Punctuation, Name.Class)),
            *((rf"\b{word}\b(?=[ \t]*{follow})", Keyword) for word, follow in CONTEXTUAL.items()),
            (
                rf"(function|do)(\s+)({_NAME}(?:\.{_NAME})*)",
                bygroups(Keyword, Whitespace, Name.Function),
            ),
            (
                rf"({_NAMED})(\s+)({_NAME})",
                bygroups(Keyword, Whitespace, Name.Class),
            ),
            (_words("include"), Keyword.Namespace),
            (_words("outcome"), Name.Constant),
            (_words("boolean"), Keyword.Constant),
            (_words("operator"), Operator.Word),
            (_words("statement"), Keyword),
            (words(_DECLARATIONS, suffix=r"\b"), Keyword),
            (_NAME, Name),
            (r"->|=>|==|!=|<=|>=|[-+*/%<>=]", Operator),
            (r"\.\.|[{}()\[\],:.]", Punctuation),
            (r".", Text),
        ],
        "string": [
            (r'"', String, "#pop"),
            (r'\\(?:["\\nrt]|u[0-9A-Fa-f]{4}|U[0-9A-Fa-f]{8})', String.Escape),
            (r"\\.", String),
            (r'[^"\\]+', String),
        ],
    }
