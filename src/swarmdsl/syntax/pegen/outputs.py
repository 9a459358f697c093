"""Files made from the grammar: the parser, the tables of keywords, keywords in editors."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

from textx import TextXError

from swarmdsl.base.resources import checkout_root, grammar
from swarmdsl.syntax import ast
from swarmdsl.syntax.ast import NODES
from swarmdsl.syntax.pegen.editors import MarksMissingError, editor_files, missing_words
from swarmdsl.syntax.pegen.grammar import Grammar, UnsupportedError, read
from swarmdsl.syntax.pegen.keywords import Keywords, read_annotations
from swarmdsl.syntax.pegen.metamodel import metamodel
from swarmdsl.syntax.pegen.swarm_actions import TARGET, parser
from swarmdsl.syntax.pegen.tree_sitter import GRAMMAR, tree_sitter

_PARSER = Path(__file__).parents[1] / "parser"
PARSER = _PARSER / "generated.py"
KEYWORDS = _PARSER / "keywords.py"
_AST = "src/swarmdsl/syntax/ast"


class GrammarError(Exception):
    """Something is missing or wrong, so that nothing can be made; the message says where."""


def outputs() -> tuple[dict[Path, str], list[str]]:
    """Content of all files by their paths, and messages about what to add by hand.

    Raises GrammarError.
    """
    try:
        model = read(metamodel())
        if missing := list(_missing_classes(model)):
            raise GrammarError("\n".join(missing))
        keywords = Keywords(model, read_annotations(grammar()))
        files = {PARSER: parser(model), KEYWORDS: keywords.source()}
        root = checkout_root()
        if root is None:
            return files, []
        files.update(editor_files(root, keywords))
        files[root / GRAMMAR] = tree_sitter(model, keywords)
        return files, list(missing_words(root, keywords))
    except TextXError as error:
        raise GrammarError(_undefined_rule(str(error)) or str(error)) from error
    except (UnsupportedError, MarksMissingError) as error:
        raise GrammarError(str(error)) from error


def _undefined_rule(message: str) -> str | None:
    """Message about a rule that is used but not defined: textX gives it a wrong place."""
    found = re.search(r'Unexisting rule "(\w+)"', message)
    if found is None:
        return None
    use = re.compile(rf"\b{found[1]}\b")
    places = (
        f"{path.parent.name}/{path.name}:{number}"
        for path in sorted(grammar().glob("*.tx"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if use.search(line)
    )
    return f"{next(places, 'grammar')}: rule {found[1]} is used, but not defined"


def _missing_classes(model: Grammar) -> Iterator[str]:
    """Messages about rules whose class does not exist or has other fields."""
    others = TARGET.words.keys() | TARGET.written.keys()
    for rule in model.rules.values():
        if rule.kind != "node" or rule.name in others:
            continue
        where = f"grammar rule {rule.name}"
        if rule.name not in NODES:
            attributes = ", ".join(rule.attributes) or "none"
            yield f"{where}: class {rule.name} is missing in {_AST} (fields: {attributes})"
            continue
        node = NODES[rule.name]
        has = {field.name for field in fields(node) if field.init} - {"span"}
        file = f"{_AST}/{node.__module__.rpartition('.')[2]}.py"
        if not hasattr(ast, rule.name):
            yield f"{where}: {_AST}/__init__.py does not export class {rule.name} of {file}"
        for name in sorted(rule.attributes.keys() - has):
            yield f"{where}: class {rule.name} in {file} has no field `{name}`"
        for name in sorted(has - rule.attributes.keys()):
            yield f"{where}: it sets no `{name}`, but class {rule.name} in {file} has that field"
