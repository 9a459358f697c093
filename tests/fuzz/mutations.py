"""Random mistakes in documents: of any text, and of the values in a JSON document."""

from __future__ import annotations

import json
import re
from random import Random
from typing import Any

NUMBERS = (
    *("0", "-1", "-0", "1e999", "-1e999", "1e308", "1e-400", "NaN", "nan", "inf", ".inf", "-.inf"),
    *(".nan", "Infinity", "0x7fffffffffffffffffff", "9" * 20, "9" * 400, "9" * 5000, "1_000"),
    *(
        "1.",
        ".5",
        "007",
        "0b1",
        "1e",
        "+1",
        "255",
        "256",
        "65536",
        "4294967296",
        "18446744073709551616",
    ),
)
ODD = (
    *("\ufeff", "\ufffe", "\uffff", "\ufdd0", "\U0001ffff", "\U0010ffff", "\u2028", "\x85", "\x0b"),
    *("\x1c", "\0", "\r", "\r\n", "\t", "\u200b", "\u202e", "é", "²", "٣", "ﬁ", "İ", "\x7f"),
)
WORDS = (
    *("", " ", ".", "..", "...", "/", "//", "../..", "/dev/zero", "-", "--", "*", "a" * 300, "%s"),
    *("{}", "[]", "$(x)", "${x}", "<x/>", "&x;", "&#0;", "&#xD800;", "]]>", "<!--", "-->", "*/"),
    *(
        '"',
        "'",
        '"""',
        "`",
        "\\",
        "\\u0000",
        "\\ud800",
        "#",
        "---",
        "...\n---",
        "null",
        "true",
        "~",
    ),
    *("!!python/object:os.system", "&a", "*a", "<<", "? ", "[[", "]]", "{", "}", "import ...*"),
    *("constructor", "__proto__", "__class__", "_event", "toString", "None", "self", "class"),
)
_TOKEN = re.compile(r"-?\d[\w.]*|\"(?:[^\"\\\n]|\\.)*\"|'[^'\n]*'|[A-Za-z_][\w.-]*|\s+|.", re.S)


def mutated(text: str, chance: Random) -> bytes:
    """Make some mistakes in a text; the result can be no UTF-8."""
    tokens = _TOKEN.findall(text)
    for _ in range(chance.choice((1, 1, 1, 1, 2, 3, 8))):
        _mutate(tokens, chance)
    made = "".join(tokens)
    data = made.encode("utf-8", "surrogatepass")
    match chance.randrange(60):
        case 0:
            return bytes(data[: chance.randrange(len(data) + 1)])
        case 1:
            at = chance.randrange(len(data) + 1)
            return data[:at] + chance.randbytes(chance.randrange(1, 9)) + data[at:]
        case 2:
            return made.encode(chance.choice(("utf-16", "utf-8-sig", "utf-32")), "replace")
    return data


def _mutate(tokens: list[str], chance: Random) -> None:
    if not tokens:
        tokens.append(chance.choice(WORDS))
        return
    at = chance.randrange(len(tokens))
    other = chance.randrange(len(tokens))
    end = at + chance.randrange(1, 12)
    # More often other values than other syntax: these get further.
    match chance.choice((0, 1, 2, 3, 4, 4, 4, 4, 6, 6, 6, 6, 6, 6, 8, 9, 10)):
        case 0:
            del tokens[at:end]
        case 1:
            tokens[at:at] = tokens[at:end]
        case 2:
            tokens[at], tokens[other] = tokens[other], tokens[at]
        case 3:
            tokens[at] = tokens[other]
        case 4:
            numbers = [place for place, token in enumerate(tokens) if token[:1].isdigit()]
            tokens[chance.choice(numbers or [at])] = chance.choice(NUMBERS)
        case 6:
            words = [place for place, token in enumerate(tokens) if token[:1] in "\"'"]
            place = chance.choice(words or [at])
            mark = tokens[place][:1] if words else ""
            tokens[place] = f"{mark}{chance.choice((*WORDS, *ODD, *NUMBERS))}{mark}"
        case 8:
            tokens[at] = chance.choice((*WORDS, *ODD, *NUMBERS))
        case 9:
            word = tokens[at]
            cut = chance.randrange(len(word) + 1)
            tokens[at] = word[:cut] + chance.choice(ODD) + word[cut:]
        case 10:
            tokens[at:end] = tokens[at:end] * chance.choice((2, 50, 400))


def mutated_json(text: str, chance: Random) -> bytes:
    """Put other values into a JSON document."""
    content = json.loads(text)
    for _ in range(chance.choice((1, 1, 2, 5))):
        content = _replaced(content, chance)
    # `json` writes what JSON does not have, too: NaN, and lone surrogates as escapes.
    return json.dumps(content, ensure_ascii=chance.random() < 0.5).encode("utf-8", "surrogatepass")


def _replaced(value: Any, chance: Random) -> Any:
    if not value or not isinstance(value, (dict, list)) or chance.random() < 0.15:
        return _other(chance)
    if isinstance(value, list):
        at = chance.randrange(len(value))
        made = list(value)
        if chance.random() < 0.2:
            made.insert(at, value[at])
        else:
            made[at] = _replaced(value[at], chance)
        return made
    key = chance.choice(list(value))
    match chance.randrange(8):
        case 0:
            return {each: inner for each, inner in value.items() if each != key}
        case 1:
            return {**value, chance.choice((*WORDS, *ODD)): _other(chance)}
    return {**value, key: _replaced(value[key], chance)}


def _other(chance: Random) -> Any:
    values: tuple[Any, ...] = (
        None,
        True,
        False,
        0,
        -1,
        1.5,
        2**70,
        1e308,
        float("inf"),
        float("nan"),
    )
    values += ("", [], {}, [[]], {"a": {}}, ["x"], [None], "\ud800", "x" * 300, [1, "a", {}])
    return chance.choice((*values, chance.choice((*WORDS, *ODD, *NUMBERS))))
