"""Hints for words and symbols of other languages."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.advice import write
from swarmdsl.syntax.parser.doc_comments import is_first_on_line

_WORDS = {
    "if": "write a guard in square brackets: `on event [x < 3] -> Target`",
    "when": "begin a transition with `on`, and write a guard in square brackets",
    "goto": "write `->` before the target",
    "then": "write `->` before the target",
    "transition": "write a transition in its source state: `on event [guard] / effect -> Target`",
    "from": 'write `import "file.swarm"` or `import package.*`',
    "include": 'write `import "file.swarm"`',
    "using": write("import package.*"),
    "class": "declare a robot as `member`, and its components as `sensor`, `actuator`, ...",
    "robot": "declare a kind of robot as `member`",
    "node": "declare a component as `sensor`, `actuator`, `controller` or `virtual`",
    "component": "declare a component as `sensor`, `actuator`, `controller` or `virtual`",
    "namespace": "begin a file with `package name`",
    "module": "begin a file with `package name`",
    "model": "declare data as `struct`, or as `message` to send it on its own",
    "typedef": "write `struct Name { ... }`, or `type Name = other`",
    "interface": "declare what a robot can do as `function name : abstraction { ... }`",
    "op": "declare what a robot can do as `function name : abstraction { ... }`",
    "signal": "declare it as `event`",
    "topology": "declare the parts of a robot in a `member`",
    "@": "there are no annotations: write documentation in `///` comments",
    "fsm": "begin a state machine with `statemachine`",
    "machine": "begin a state machine with `statemachine`",
    "topic": 'give the topic of an event or a port: `event Low : pkg/Type on "topic"`',
    "<": "this is not XML: write a state as `state Name { on event -> Target }`",
    "?": "there is no conditional expression: use two transitions with guards",
    "$": "a name has ASCII letters, digits and `_`, and starts with no digit",
}
# A transition without its keyword.
_TRANSITION = re.compile(r"[A-Za-z_]\w*[ \t]*(?:-+>|/[^/{}\n]*-+>|\[[^]\n]*\][ \t]*(?:/|-+>))")
_EFFECT = re.compile(r"send\b|[A-Za-z_]\w*(?:\.\w+)*[ \t]*=[^=>]")
# These also within a statement.
_ANYWHERE = ("if", "goto", "then", "?", "$")
_SYMBOLS = {
    ";": "`;` stands only between two statements",
    ",": "no `,` is needed here: `;` or a line break separates statements",
    "&": write("and"),
    "|": write("or"),
    "!": write("not"),
    "'": "write a string in double quotes",
    "#": "begin a comment with `//`",
}


def foreign_token_hint(expected: set[str], text: str, at: int) -> str | None:
    """Return a hint for the foreign word at an offset; None if it is not known."""
    begins = is_first_on_line(text, at)
    if text[at] == "{" and "`(`" in expected:
        return "write arguments in parentheses"
    if text[at] == "=" and "`:`" in expected:
        return "write the type before the value: `name : type = value`"
    before = text[:at].rstrip()
    if before.endswith(";") and _EFFECT.match(text, at):
        return "separate effects with `,`"
    if before.endswith(","):
        return "delete the `,` before it"
    if number := re.compile(r"\d+(?:_\d+)+\b").match(text, at):
        return write(number[0].replace("_", ""))
    if re.compile(r"0[xXbB]").match(text, at):
        return "write the number in decimal"
    if begins and "`state`" in expected and re.compile(r"[A-Za-z_]\w*\s*\{").match(text, at):
        return "begin a state with `state`"
    if begins and _TRANSITION.match(text, at):
        if "`on`" in expected:
            return "begin a transition with `on`"
        return "write a transition in its source state: `on event -> Target`"
    found = re.compile(r"#?[ \t]*([A-Za-z]+)|\S").match(text, at)
    if found is None:
        return None
    word = found[1] if found[1] and (found[0][0] != "#" or found[1] == "include") else found[0]
    return _WORDS.get(word) if begins or word in _ANYWHERE else None


def symbol_hint(token: str) -> str | None:
    """Return a hint for a foreign symbol; None if it is not known."""
    return _SYMBOLS.get(token)
