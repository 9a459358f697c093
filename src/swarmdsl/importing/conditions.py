"""Conditions and values of SCXML, as far as the language has them too."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from lark import Lark, LarkError, Token, Tree

from swarmdsl.ir import Binary, Expression, Literal, Type, Unary, VariableRef
from swarmdsl.ir.types import BOOL, FLOAT, INT, STRING

_GRAMMAR = r"""
?start: or
?or: (or "||")? and
?and: (and "&&")? equal
?equal: (equal EQUAL)? order
?order: (order ORDER)? sum
?sum: (sum SUM)? product
?product: (product PRODUCT)? unary
?unary: "!" unary -> no
      | "-" unary -> minus
      | "(" or ")"
      | INT | FLOAT | TEXT | TRUE | FALSE | NAME
EQUAL: /[!=]==?/
ORDER: /[<>]=?/
SUM: /[+-]/
PRODUCT: "*"
TRUE.2: /true\b/
FALSE.2: /false\b/
NAME: /[A-Za-z_]\w*/
INT: /\d+(?![\d.])/
FLOAT: /\d+\.\d*|\.\d+/
TEXT: /"[^"\\]*"|'[^'\\]*'/
%ignore /\s+/
"""

_LITERALS = {"INT": INT, "FLOAT": FLOAT, "TEXT": STRING, "TRUE": BOOL, "FALSE": BOOL}


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr")


def tree_of(text: str) -> Tree[Token] | Token | None:
    """The tree of an expression; None for one that the language does not have."""
    try:
        return _parser().parse(text)
    except LarkError:
        return None


def expression(
    tree: Tree[Token] | Token,
    variables: dict[str, Type],
    name: Callable[[str], str],
    wanted: Type = BOOL,
) -> Expression:
    """The expression of a tree; variables that nobody has declared get a type by their use.

    `name` says what a variable is called in the model.
    """
    if isinstance(tree, Token):
        text = str(tree)
        match tree.type:
            case "INT":
                return Literal(int(text), INT)
            case "FLOAT":
                return Literal(float(text), FLOAT)
            case "TEXT":
                return Literal(text[1:-1], STRING)
            case "TRUE" | "FALSE":
                return Literal(text == "true", BOOL)
        return VariableRef(name(text), variables.setdefault(text, wanted))
    if tree.data == "no":
        return Unary("not", expression(tree.children[0], variables, name, BOOL), BOOL)
    if tree.data == "minus":
        operand = expression(tree.children[0], variables, name, INT)
        return Unary("-", operand, operand.type)
    left, *between, right = tree.children
    if not between:
        word = "or" if tree.data == "or" else "and"
        operands = [expression(each, variables, name, BOOL) for each in (left, right)]
        return Binary(word, operands[0], operands[1], BOOL)
    operator = str(between[0]).replace("===", "==").replace("!==", "!=")
    hint = _known(left, variables) or _known(right, variables) or INT
    first, second = (expression(each, variables, name, hint) for each in (left, right))
    compares = tree.data in ("equal", "order")
    return Binary(operator, first, second, BOOL if compares else first.type)


def _known(tree: Tree[Token] | Token, variables: dict[str, Type]) -> Type | None:
    """The type of an operand, where its use does not decide about it."""
    if isinstance(tree, Token):
        return variables.get(str(tree)) if tree.type == "NAME" else _LITERALS.get(tree.type)
    if tree.data in ("or", "and", "no", "equal", "order"):
        return BOOL
    types = (_known(each, variables) for each in tree.children)
    return next((type_ for type_ in types if type_ is not None), None)
