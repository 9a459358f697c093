"""Grammar for tree-sitter, by which Neovim, Helix, Zed and Emacs highlight: `src/grammar.json`.

Rules, fields and keywords are those of the textX grammar. Only lexical rules are written here:
tokens of tree-sitter cannot look around themselves. What must, `src/scanner.c` reads.
Format: https://tree-sitter.github.io/tree-sitter/creating-parsers
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Grammar,
    Optional,
    Repetition,
    Rule,
    Sequence,
    Terminal,
    UnsupportedError,
    Use,
)
from swarmdsl.syntax.pegen.keywords import Keywords

GRAMMAR = Path("editors/tree-sitter/src/grammar.json")

Json = dict[str, Any]


def _symbol(name: str) -> Json:
    return {"type": "SYMBOL", "name": name}


def _string(value: str) -> Json:
    return {"type": "STRING", "value": value}


def _pattern(value: str) -> Json:
    return {"type": "PATTERN", "value": value}


def _seq(*members: Json) -> Json:
    return {"type": "SEQ", "members": list(members)}


def _choice(*members: Json) -> Json:
    return {"type": "CHOICE", "members": list(members)}


def _repeat(content: Json) -> Json:
    return {"type": "REPEAT", "content": content}


_BLANK: Json = {"type": "BLANK"}
_IDENTIFIER = _symbol("identifier")
_INTEGER = _symbol("integer")


def _joined(separator: Json) -> Json:
    return _seq(_IDENTIFIER, _repeat(_seq(separator, _IDENTIFIER)))


_DOT, _SLASH = _string("."), _string("/")
_UNIT = _seq(_IDENTIFIER, _choice(_seq(_SLASH, _IDENTIFIER), _BLANK))
# Uses of lexical rules.
_USES: dict[str, Json] = {
    "IDENT": _IDENTIFIER,
    "WORD": _IDENTIFIER,
    "PORT": _IDENTIFIER,
    "QNAME": _symbol("qualified_name"),
    "STATENAME": _symbol("qualified_name"),
    "INTERFACE": _symbol("interface"),
    "TYPENAME": _symbol("type_name"),
    "LIBRARY": _symbol("library"),
    "QUOTED": _symbol("string"),
    "STRINGBOUND": _symbol("string_bound"),
    "ARRAY": _symbol("array"),
    "UNIT": _choice(_UNIT, _string("%")),
    "LATER": _symbol("later"),
    "INTEGER": _choice(_INTEGER, _symbol("negative")),
    "INDEX": _INTEGER,
    "BOUND": _choice(_INTEGER, _string("*")),
    "PROBABILITY": _choice(_INTEGER, _symbol("decimal")),
    "LENGTH": _symbol("length"),
    "QUANTITY": _symbol("quantity"),
    "MINUS": _string("-"),
    "QUALIFIERS": _seq(_DOT, _joined(_DOT)),
    "BEFOREINDEX": _BLANK,
}
_LEXICAL: dict[str, Json] = {
    "qualified_name": _joined(_DOT),
    "interface": _joined(_SLASH),
    "type_name": _joined(_choice(_DOT, _SLASH)),
    "library": _seq(_joined(_DOT), _choice(_seq(_DOT, _string("*")), _BLANK)),
    "quantity": _seq(_symbol("number"), _choice(_symbol("percent"), _BLANK)),
    "identifier": _pattern("[A-Za-z_][A-Za-z0-9_]*"),
    "integer": _pattern(r"\d+"),
    "negative": _pattern(r"-\d+"),
    "decimal": _pattern(r"\d+\.\d+"),
    "length": _pattern(r"\d+(?:\.\d+)?[ \t]*(?:km|cm|mm|m)"),
    "string": _pattern(r'"(?:[^"\\\n]|\\[^\n])*"'),
    "string_bound": _pattern(r"<=?\s*-?\d+"),
    "array": _pattern(r"(?:\[\s*(?:<=?\s*)?(?:-?\d[\d.]*|\*)?\s*\])+"),
    "comment": _pattern(r"\/\/[^\n]*|\/\*(?:[^*]|\*+[^*\/])*\*+\/"),
}
# Tokens of `src/scanner.c`, in the order of its enumeration.
_SCANNED = ("number", "percent", "later")
# Parts of expressions that have a node; others are parts of the node around them.
_NODES = {
    "INSTATE": "in_state",
    "NEIGHBORS": "neighbors",
    "QUERY": "query",
    "MADE": "construction",
    "CALL": "call",
    "PATH": "path",
    "FIELDVALUE": "field_value",
}
# Rules that begin alike: both are followed until one of them ends.
_CONFLICTS = (
    ("who", "qualified_name"),
    ("construction", "_root"),
    ("type_ref",),
    ("transition", "trigger"),
    ("type_name",),
    ("unit",),
)
# Rules that can read one text in two ways, of which the first is that of the language.
_RANKED = frozenset({"Transition"})


def tree_sitter(grammar: Grammar, keywords: Keywords) -> str:
    """Return the grammar; raises UnsupportedError for a rule without a counterpart here."""
    return json.dumps(_grammar(grammar, keywords), indent=1) + "\n"


def _grammar(grammar: Grammar, keywords: Keywords) -> Json:
    rules = {
        _name(rule): _written(rule.body, rule, grammar)
        for rule in sorted(grammar.rules.values(), key=lambda rule: rule.name != grammar.start)
        if rule.name not in _USES and not _is_token(rule)
    }
    # A part may be called `battery`, although a block of that name may stand in its place.
    begin = keywords.first["MemberItem"] | keywords.first["SwarmItem"]
    named = (
        {"type": "ALIAS", "content": _string(word), "named": True, "value": "identifier"}
        for word in sorted(begin & keywords.contextual)
    )
    rules["name"] = _choice(_IDENTIFIER, *named)
    return {
        "name": "swarm",
        "word": "identifier",
        "rules": rules | _LEXICAL,
        "extras": [_pattern(r"\s"), _symbol("comment")],
        "conflicts": [list(names) for names in _CONFLICTS],
        "precedences": [],
        "externals": [_symbol(token) for token in _SCANNED],
        "inline": [],
        "supertypes": [_name(rule) for rule in grammar.rules.values() if rule.kind == "choice"],
    }


def _is_token(rule: Rule) -> bool:
    return rule.kind == "text" and isinstance(rule.body, Terminal)


def _name(rule: Rule) -> str:
    """Return the name of a node; nodes with an underscore first are not in the tree."""
    if rule.name in _NODES:
        return _NODES[rule.name]
    snake = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", rule.name).lower()
    return f"_{snake}" if rule.name.isupper() else snake


def _written(part: Expression, rule: Rule, grammar: Grammar) -> Json:
    match part:
        case Use(name) | Terminal(name=name, literal="") if name in _USES:
            return _USES[name]
        case Use(name):
            used = grammar.rules[name]
            return _written(used.body, used, grammar) if _is_token(used) else _symbol(_name(used))
        case Terminal(literal="[") if rule.name == "ITEM":
            # After a space, the bracket begins a guard.
            adjacent = {"type": "PREC", "value": 1, "content": _string("[")}
            return {"type": "IMMEDIATE_TOKEN", "content": adjacent}
        case Terminal(literal=literal) if literal:
            return _string(literal)
        case Sequence(members):
            known = (_written(each, rule, grammar) for each in members)
            return _seq(*(each for each in known if each != _BLANK))
        case Choice(members):
            choices = [_written(each, rule, grammar) for each in members]
            if rule.name in _RANKED:
                choices = [
                    {"type": "PREC_DYNAMIC", "value": -place, "content": each}
                    for place, each in enumerate(choices)
                ]
            return _choice(*choices)
        case Optional(inner):
            return _choice(_written(inner, rule, grammar), _BLANK)
        case Repetition(inner, least, separator):
            if separator is None:
                repeated = _written(_single(inner), rule, grammar)
                return {"type": "REPEAT1" if least else "REPEAT", "content": repeated}
            one = _written(inner, rule, grammar)
            listed = _seq(one, _repeat(_seq(_written(separator, rule, grammar), one)))
            return listed if least else _choice(listed, _BLANK)
        case Assign(attribute, _, inner):
            content = _written(inner, rule, grammar)
            return {"type": "FIELD", "name": attribute, "content": content}
    raise UnsupportedError(rule.name, f"{part} has no counterpart in {Path(__file__).name}")


def _single(repeated: Expression) -> Expression:
    """Replace `x+` in a choice that is repeated by `x`, which matches the same."""
    match repeated:
        case Sequence((first, *others)) if all(isinstance(each, Optional) for each in others):
            return Sequence((_single(first), *others))
        case Choice(members):
            return Choice(tuple(map(_single, members)))
        case Repetition(part, 1, None):
            return part
    return repeated
