"""Colours for .swarm files wherever Pygments makes them: Sphinx, LaTeX (minted), consoles.

It is an entry point of Pygments: a fence of the language `swarm` needs nothing else.
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

from swarmdsl.syntax.errors.hints import keywords
from swarmdsl.syntax.types import PRIMITIVES

_OUTCOMES = ("aborted", "preempted", "succeeded")
_TRUTH = ("true", "false")
_OPERATORS = ("and", "or", "not")
_NAME = r"[A-Za-z_]\w*"
_NAMED = (
    "statemachine|state|region|choice|final|history|member|sensor|actuator|controller|virtual"
    "|struct|enum|event|fitness|environment"
)
_RESERVED = sorted(keywords() - {*_OUTCOMES, *_TRUTH, *_OPERATORS})
# Words that are keywords where these follow or stand before them, and may be names elsewhere.
_CONTEXTUAL = (
    r"internal(?=\s+(?:on|after|monitor)\b)",
    r"deep(?=\s+history\b)",
    r"(?:goal|result|feedback|request|response)(?=\s*\{)",
    r"(?:abstraction)(?=\s*\{)",
    r"ros(?=\s*\")",
    r"by(?=\s+[A-Za-z_]\w*\s*(?:\)|$))",
    r"(?:maximize|minimize|steps|evaluations|seed|step)(?=\s+[-(\dA-Za-z])",
    r"count(?=\s+of\b)",
    r"of(?=\s+[A-Za-z_]\w*\s+in\b)",
    r"world(?=\s*\")",
    r"size(?=\s+\d)",
    r"x(?=\s+\d)",
)


class SwarmLexer(RegexLexer):  # type: ignore[misc]
    """Models of swarms of robots."""

    name = "Swarm"
    aliases: ClassVar[list[str]] = ["swarm"]
    filenames: ClassVar[list[str]] = ["*.swarm"]
    tokens: ClassVar[dict[str, Any]] = {
        "root": [
            (r"\s+", Whitespace),
            (r"///(?!/)[^\n]*", Comment.Special),
            (r"//[^\n]*", Comment.Single),
            (r"/\*(?:[^*]|\*(?!/))*\*/", Comment.Multiline),
            (r'"(?:[^"\\\n]|\\[^\n])*"', String),
            (r"(\.)(done)\b", bygroups(Punctuation, Keyword)),
            # A field may be called as a keyword is.
            (rf"(\.)({_NAME})", bygroups(Punctuation, Name.Attribute)),
            (
                rf"({_NAME})(\s*)(:)(?=\s*[A-Za-z_])",
                bygroups(Name.Variable, Whitespace, Punctuation),
            ),
            (words(sorted(PRIMITIVES), prefix=r"\b", suffix=r"\b"), Keyword.Type),
            (rf"{_NAME}(?=\s*=(?!=))", Name.Attribute),
            (r"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?(?:[ \t]*(?:us|ms|s|min|h|km|cm|mm|m)\b)?", Number),
            (rf"({_NAME})(/)({_NAME})", bygroups(Name.Namespace, Punctuation, Name.Class)),
            *((rf"\b{word}", Keyword) for word in _CONTEXTUAL),
            (
                rf"(function|do)(\s+)({_NAME}(?:\.{_NAME})*)",
                bygroups(Keyword, Whitespace, Name.Function),
            ),
            (
                rf"({_NAMED})(\s+)({_NAME})",
                bygroups(Keyword, Whitespace, Name.Class),
            ),
            (words(("package", "import"), suffix=r"\b"), Keyword.Namespace),
            (words(_OUTCOMES, suffix=r"\b"), Name.Constant),
            (words(_TRUTH, suffix=r"\b"), Keyword.Constant),
            (words(_OPERATORS, suffix=r"\b"), Operator.Word),
            (words(_RESERVED, suffix=r"\b"), Keyword),
            (_NAME, Name),
            (r"->|=>|==|!=|<=|>=|[-+*/%<>=]", Operator),
            (r"\.\.|[{}()\[\],:.]", Punctuation),
            (r".", Text),
        ]
    }
