"""Grammar of the ECMAScript subset: expressions, and scripts that assign.

Nothing here evaluates: `ecmascript` and `assignments` compile the trees to Python functions.
"""

from __future__ import annotations

import json
import re
from functools import cache

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedInput, UnexpectedToken

_EXPRESSIONS = r"""
?start: conditional
?conditional: either | either "?" conditional ":" conditional -> choice
?either: both | either "||" both -> either
?equality: relation | equality EQUALITY relation -> operation
?sum: product | sum (PLUS | MINUS) product -> operation
?product: sign | product (STAR | SLASH | PERCENT) sign -> operation
?postfix: primary | postfix "." NAME -> member | postfix "[" conditional "]" -> item
    | postfix "(" [conditional ("," conditional)*] ")" -> call
?primary: NUMBER -> number | TEXT -> text | NAME -> name | "(" conditional ")"
    | "[" [conditional ("," conditional)*] "]" -> list
    | "{" [pair ("," pair)*] "}" -> object
    | "function" "(" [NAME ("," NAME)*] ")" "{" "return" conditional ";"? "}" -> function
pair: (NAME | TEXT) ":" conditional
EQUALITY: "===" | "!==" | "==" | "!="
RELATION: "<=" | ">=" | "<" | ">"
NOT: "!"
TYPEOF: "typeof"
PLUS: "+"
MINUS: "-"
STAR: "*"
SLASH: "/"
PERCENT: "%"
NUMBER: /0[xX][0-9a-fA-F]+|(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?/
TEXT: /"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'/
NAME: /[A-Za-z_$][A-Za-z0-9_$]*/
%ignore /\s+/
"""
_COMMON = r"""
?both: equality | both "&&" equality -> both
?relation: sum | relation RELATION sum -> operation
?sign: postfix | (NOT | PLUS | MINUS | TYPEOF) sign -> sign
"""
# Comments, and operators that few documents use: they double the time to make the parser.
_RARE = r"""
?both: bits | both "&&" bits -> both
?bits: exclusive | bits BAR exclusive -> bitwise
?exclusive: intersection | exclusive CARET intersection -> bitwise
?intersection: equality | intersection AMPERSAND equality -> bitwise
?relation: shift | relation RELATION shift -> operation | relation "in" shift -> membership
?shift: sum | shift SHIFT sum -> bitwise
?sign: step | (NOT | PLUS | MINUS | TYPEOF | TILDE) sign -> sign
?step: postfix | STEP postfix -> before | postfix STEP -> after
SHIFT: "<<" | ">>>" | ">>"
BAR: "|"
CARET: "^"
AMPERSAND: "&"
TILDE: "~"
STEP: "++" | "--"
COMMENT: /\/\/[^\n]*|\/\*[\s\S]*?\*\//
%ignore COMMENT
"""
_USES_RARE = re.compile(
    r"(?<!&)&(?!&)|(?<!\|)\|(?!\|)|\^|~|<<|>>|\+\+|--|//|/\*|(?<![\w$])in(?![\w$])"
)
_SCRIPTS = r"""
script: (SEMICOLON | _statement)*
_statement: variables | assignment | change
variables: "var" variable ("," variable)*
variable: NAME ["=" conditional]
assignment: postfix (EQUALS | COMPOUND) conditional
?change: STEP postfix -> before | postfix STEP -> after
EQUALS: "="
COMPOUND: "+=" | "-=" | "*=" | "/=" | "%="
SEMICOLON: ";"
"""
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|x([0-9a-fA-F]{2})|(.))")
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "b": "\b", "f": "\f", "v": "\v", "0": "\0"}
_DEEPEST = 150


class Unreadable(Exception):  # noqa: N818 - what is wrong is the text, which is reported
    """The string is not a supported expression; the message is the reason."""


@cache
def _parser(operators: str, start: str = "start") -> Lark:
    return Lark(_EXPRESSIONS + operators, parser="lalr", start=start, maybe_placeholders=False)


def parse(written: str) -> Tree[Token]:
    """Parse an expression. Raises Unreadable."""
    return _parsed(_parser(_RARE if _USES_RARE.search(written) else _COMMON), written)


def parse_script(written: str) -> Tree[Token]:
    """Parse a sequence of assignments. Raises Unreadable."""
    return _parsed(_parser(_RARE + _SCRIPTS, "script"), written)


def _parsed(parser: Lark, written: str) -> Tree[Token]:
    try:
        tree = parser.parse(written)
    except UnexpectedInput as error:
        if isinstance(error, UnexpectedToken) and error.token.type == "$END":
            raise Unreadable("it ends early") from None
        start = error.pos_in_stream or 0
        word = written[start : start + 40].split()[0]
        raise Unreadable(f"`{word}` cannot stand here") from None
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [child for each in level for child in each.children if isinstance(child, Tree)]
    if depth > _DEEPEST:
        raise Unreadable("it is nested too deeply")
    return tree


def unquoted(token: str) -> str:
    """Return the string value of a literal, or the name itself."""
    if token[0] not in "\"'":
        return str(token)

    def plain(found: re.Match[str]) -> str:
        code = found[1] or found[2]
        return chr(int(code, 16)) if code else _ESCAPED.get(found[3], found[3])

    made = _ESCAPE.sub(plain, token[1:-1])
    # A character above U+FFFF is escaped as a surrogate pair.
    return made.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def inline_expression(content: str) -> str:
    """Return text inside an element as an expression (B.2.1).

    JSON is its own value; other text is a string, with its white space normalized.
    """
    try:
        json.loads(content, parse_constant=_refuse, parse_int=str)
    except (ValueError, RecursionError):
        return json.dumps(" ".join(content.split()))
    return content


def _refuse(name: str) -> None:
    """Refuse `NaN` and `Infinity`, which Python reads but JSON does not have."""
    raise ValueError(name)
