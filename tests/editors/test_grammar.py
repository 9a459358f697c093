"""Each token has the TextMate scope of its role according to textX."""

from __future__ import annotations

import re
from itertools import accumulate
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
INLINE = ROOT / "editors" / "vscode" / "tests"
# This one is invalid on purpose.
INCOMPLETE = INLINE / "incomplete.swarm"
MODELS = sorted(
    {
        *(ROOT / "examples").rglob("*.swarm"),
        *(ROOT / "tests" / "golden").rglob("*.swarm"),
        *INLINE.glob("*.swarm"),
    }
    - {INCOMPLETE}
)

# Prefixes of the innermost scope of a terminal, by its role.
KEYWORD = ("keyword.", "storage.")
NAME = ("entity.", "variable.other.", "variable.parameter.", "support.")
SEPARATOR = ("punctuation.accessor.", "punctuation.separator.")
STRING = ("string.", "punctuation.definition.string.", "constant.character.escape.")
NUMBER = ("constant.numeric.", "keyword.other.unit.")
OPERATOR = ("keyword.operator.", "punctuation.", "constant.language.unbounded.")
COMMENT = ("comment.", "punctuation.definition.comment.")
# Keywords that are values, not constructs.
VALUES = {
    "true": ("constant.language.",),
    "false": ("constant.language.",),
    "event": (*KEYWORD, "variable.language."),
}


def scopes_of(part: Any, language: Any) -> tuple[str, ...]:
    """Return the allowed scope prefixes of a terminal of textX."""
    if language.is_keyword(part.rule):
        return VALUES.get(part.value, KEYWORD)
    if part.rule.rule_name == "LATER":
        return KEYWORD
    if part.value.startswith('"'):
        return STRING
    if re.match(r"-?\d", part.value):
        return NUMBER
    if re.match(r"[A-Za-z_]", part.value):
        return NAME
    if re.match(r"[./][\w*]", part.value):  # rest of `pkg.Name`, `pkg/Type` or `pkg.*`
        return (*NAME, *SEPARATOR, "keyword.operator.wildcard.")
    if re.match(r"(\[|<=|\[\s*<=)\s*\d", part.value):  # array size, bound
        return OPERATOR + NUMBER
    return OPERATOR


def miscoloured(text: str, language: Any, tokenize: Any) -> list[str]:
    """Return the parts of `text` without the scope of their role."""
    allowed = [COMMENT] * len(text)
    for part in language.parse(text):
        end = part.position + len(part.value)
        allowed[part.position : end] = [scopes_of(part, language)] * len(part.value)
    lines = text.split("\n")
    starts = [0, *accumulate(len(line) + 1 for line in lines)]
    return [
        f"line {line + 1}: `{lines[line][start:end].strip()}` is {scopes[-1]}"
        for line, start, end, scopes in tokenize(text)
        if not all(
            character.isspace() or scopes[-1].startswith(allowed[at])
            for at, character in enumerate(lines[line][start:end], starts[line] + start)
        )
    ]


def test_inline_assertions(npm: Any) -> None:
    result = npm("test")
    assert result.returncode == 0, result.stdout
    for path in INLINE.glob("*.swarm"):
        assert path.name in result.stdout


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_part_of_a_model_has_the_scope_of_its_role(
    path: Path, language: Any, tokenize: Any
) -> None:
    assert miscoloured(path.read_text(encoding="utf-8"), language, tokenize) == []


def test_wrong_scope_is_found(language: Any, tokenize: Any) -> None:
    # TextMate grammars work line by line, so this one cannot know that `state` is a field here.
    text = "message M {\n  state\n  : string }"
    assert miscoloured(text, language, tokenize) == ["line 2: `state` is keyword.other.swarm"]


def test_every_keyword_can_be_the_name_of_a_field(language: Any, tokenize: Any) -> None:
    words = sorted(language.keywords | language.reserved)
    fields = " ".join(f"{word} : pkg/{word}\n" for word in words)
    models = [
        f"message M {{\n{fields}}}",
        f"service S {{ request {{ {fields} }} response {{ {fields} }} }}",
        *(
            f'sensor P {{\n in {word} : T\n out {word} : T on "x" }}\n'
            f"member R {{ connect a.{word} -> b.{word}\n connect {word} -> {word} }}"
            for word in words
        ),
        f"action A {{ goal {{ {fields} }} result {{ {fields} }} feedback {{ {fields} }} }}",
        *(
            f"""
            member R {{ communication radio {{ {word} = 1 }} part : Part {{ {word} = 1 }} }}
            statemachine M {{
              state T = N({word} = 1, {word}=v.{word})
              state S {{
                entry / v.{word} = 1, send E({word} = v.{word})
                do f({word} = v.{word}) gives ({word} => v.{word}, {word}=>v)
                on E [v.{word} == 1] / v.{word} = 2, send E({word}= 3, {word} =v) -> S
              }}
            }}"""
            for word in words
        ),
    ]
    assert miscoloured("\n".join(models), language, tokenize) == []


def test_contextual_keywords_can_be_names(language: Any, tokenize: Any) -> None:
    model = """
    package {0}
    import "{0}"; import ros "{0}"; import {0}.*; import {0}.{0}; import {0}
    const {0} : {0} = {0} + {0}
    enum {0} : {0} {{ {0} = -1, {0} }}
    message {0} {{ const {0} : {0} = {0}, {0} : {0}[<=3] }}
    struct {0} {{ {0} : {0} }}
    type {0} = {0}[3]
    event {0} : {0}/{0}
    function {0} : abstraction {{ param {0} : {0} = {0} }}
    sensor {0} extends {0} {{
      in {0} : {0}; param {0} : {0} = {0}; operation {0}(in {0} : {0}, {0} : {0}); behavior {0}
    }}
    member {0} extends {0} {{
      behavior {0}
      communication {0} {{ {0} = {0} }}
      {0} : {0} {{ {0} = {0} }}
      connect {0}.{0} -> {0}.{0}
    }}
    statemachine {0} {{
      var {0} : {0} = {0} + {0}({0})
      initial {0}
      state {0} = {0}({0} = {0}) {{
        entry / send {0}, {0} = {0}
        exit / {0} = {0}
        do {0}(by {0}) gives by {0}
        [{0}] -> {0}
        monitor "{0}" : {0} [{0}] / {0} = {0} + 1
        internal [{0}] -> {0}
        internal on {0} [{0}] / {0} = {0} -> {0}
        on {0} / send {0}
        internal monitor "{0}" : {0} -> {0}
        internal after {0} [{0}] / send {0}
        on {0} / send {0} to {0}[{0}], send {0}({0} = {0}) to {0}, {0} = {0}
        history {0} -> {0}
        deep history {0} -> {0}
        on {0} [{0} > {0}.{0}] / send {0}, {0} = {0} -> {0}
        on done.{0} -> {0}
        after {0} -> {0}
      }}
      parallel state {0} {{ region {0} {{ initial {0}; final {0} }} on {0}.done -> {0} }}
      choice {0} {{ [{0}] / send {0}({0} = {0}) -> {0}; else -> {0} }}
    }}
    swarm {0} {{ {0} : {0}[1..*]; environment {0}; fitness {0} }}
    environment {0} {{ world "w"; size 1 m x 1 m }}
    fitness {0} {{
      in {0} : {0}; param {0} : {0} = {0} + {0}
      maximize {0} * {0}
    }}
    optimize {0} {{
      {0}.{0} in {0} .. {0} step {0}; count of {0} in {0} .. {0}
      steps {0}; seed {0}; evaluations {0}
    }}
    """
    for word in sorted(language.contextual):
        assert miscoloured(model.format(word), language, tokenize) == [], word


@pytest.mark.parametrize(
    "typed",
    [
        "on", "on E", "on E / x = 1", "after 3 s", "after 3 s / x =", "monitor",
        'monitor "a" : b/C', "[x > 1]", "entry", "exit /", "entry / x =",
    ],
)  # fmt: skip
def test_a_transition_without_target_ends_where_the_next_item_begins(
    typed: str, tokenize: Any
) -> None:
    items = [
        "after", "choice", "deep history", "do", "entry", "exit", "final", "history", "initial",
        "internal after", "internal monitor", "internal on", "internal [", "monitor", "on", "param",
        "parallel state", "region", "state", "var",
    ]  # fmt: skip
    half = [f"{typed}\n{item} X {{ }} }}" for item in items]
    text = "statemachine M {" + "".join(f"state S {{\n{lines}" for lines in half)
    first = {line: scopes[-1] for line, start, _, scopes in tokenize(text) if start == 0}
    for number, lines in enumerate(half):
        scope = first[2 + 2 * number]
        assert scope.startswith(KEYWORD), lines
        assert scope != "keyword.other.swarm", lines
