"""Words and marks of other languages, and how that is said in this one."""

from __future__ import annotations

import re

from swarmdsl.syntax.parser.doc_comments import starts_line

_WORDS = {
    "if": "a guard stands in square brackets: `on event [x < 3] -> Target`",
    "when": "a transition begins with `on`, and a guard stands in square brackets",
    "goto": "write `->` before the target",
    "then": "write `->` before the target",
    "transition": "a transition is written `on event [guard] / effect -> Target`, in its source",
    "from": 'an import is written `import "file.swarm"` or `import package.*`',
    "include": 'an import is written `import "file.swarm"`',
    "using": "an import is written `import package.*`",
    "class": "what a robot is made of is a `member`, its parts are `sensor`, `actuator`, ...",
    "robot": "a kind of robot is a `member`",
    "node": "a part of a robot is a `sensor`, `actuator`, `controller` or `virtual` component",
    "component": "a component is a `sensor`, `actuator`, `controller` or `virtual`",
    "namespace": "a file begins with `package name`",
    "module": "a file begins with `package name`",
    "model": "data is a `struct`, what is sent on its own a `message`",
    "typedef": "write `struct Name { ... }`, or `type Name = other`",
    "interface": "what a robot can do is a `function name : abstraction { ... }`",
    "op": "what a robot can do is a `function name : abstraction { ... }`",
    "signal": "what a machine waits for is an `event`",
    "topology": "which parts a robot has is said in a `member`",
    "@": "there are no annotations: documentation stands in `///` comments",
    "fsm": "a state machine begins with `statemachine`",
    "machine": "a state machine begins with `statemachine`",
    "topic": 'a topic belongs to an event or a port: `event Low : pkg/Type on "topic"`',
    "<": "this is not XML: a state is written `state Name { on event -> Target }`",
    "?": "there is no conditional value: use two transitions with guards",
    "$": "a name has ASCII letters, digits and `_`, and starts with no digit",
}
# A transition without the word it begins with.
_TRANSITION = re.compile(r"[A-Za-z_]\w*[ \t]*(?:-+>|/[ \t]*-+>|\[[^]\n]*\][ \t]*(?:/|-+>))")
# These also inside a statement.
_ANYWHERE = ("if", "goto", "then", "?", "$")
_MARKS = {
    ";": "no `;` is needed: a line break ends a statement",
    ",": "no `,` is needed here",
    "&": "write `and`",
    "|": "write `or`",
    "!": "write `not`",
    "'": "texts stand in double quotes",
    "#": "a comment starts with `//`",
}


def foreign(expected: set[str], text: str, at: int) -> str | None:
    """How to say here what the word at an offset says in other languages; None if unknown."""
    begins = starts_line(text, at)
    if text[at] == "{" and "`(`" in expected:
        return "arguments stand in parentheses"
    if text[at] == "=" and "`:`" in expected:
        return "a type stands before the value: `name : type = value`"
    if text[:at].rstrip().endswith(","):
        return "delete the `,` before it"
    if number := re.compile(r"\d+(?:_\d+)+\b").match(text, at):
        return f"write `{number[0].replace('_', '')}`"
    if re.compile(r"0[xXbB]").match(text, at):
        return "numbers are decimal"
    if begins and "`state`" in expected and re.compile(r"[A-Za-z_]\w*\s*\{").match(text, at):
        return "a state begins with `state`"
    if begins and _TRANSITION.match(text, at):
        if "`on`" in expected:
            return "a transition begins with `on`"
        return "a transition stands in its source state: `on event -> Target`"
    found = re.compile(r"#?[ \t]*([A-Za-z]+)|\S").match(text, at)
    if found is None:
        return None
    word = found[1] if found[1] and (found[0][0] != "#" or found[1] == "include") else found[0]
    return _WORDS.get(word) if begins or word in _ANYWHERE else None


def mark(token: str) -> str | None:
    """What to write for a mark that has no place here; None if unknown."""
    return _MARKS.get(token)
