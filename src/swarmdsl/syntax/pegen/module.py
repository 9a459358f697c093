"""Assemble a generated parser: constants, the function `parse`, the program."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl.syntax.pegen.actions import Target
from swarmdsl.syntax.pegen.analysis import Analysis
from swarmdsl.syntax.pegen.emit_functions import Emission
from swarmdsl.syntax.pegen.grammar import Grammar, Terminal, inside
from swarmdsl.syntax.pegen.lookahead import Lookahead
from swarmdsl.syntax.pegen.program import Program

_DEFINITIONS = '''\
new_node = object.__new__
new_span = tuple.__new__
new_word = str.__new__

{constants}
RESERVED = frozenset({reserved})
TERMINALS = (
{terminals}
)
PROGRAM = (
{program}
)


def parse(source: Source, docs: dict[int, str], limit: int) -> tuple[{start}, int] | None:
    """Parse a file to a model; None where it does not follow the grammar.

    With the model comes the number of wrong expressions, which have no trees. Documentation is
    taken from `docs`, which maps places to texts. Raises TooDeepError for nesting beyond `limit`.
    """
    text = source.text
    depth = at = 0
    tokens, ends = LEXER.tokenize(text)
    token = tokens[0]
{begin}
{functions}
{tables}

    try:
        model = r_{start}()
        if model is None or BLANKS(text, ends[at]).end() < len(text):
            return None
{finish}
        return model, {result}
    finally:
        # They refer to each other: so they are gone at once, without the garbage collector.
        {names} = None
'''
_FUNCTION = re.compile(r" {4}def (\w+)\(")


def definitions(grammar: Grammar, target: Target) -> tuple[str, list[str]]:
    """Return the source of the definitions, and the classes of nodes it uses.

    It also uses `re`, `Lexer`, `Span`, `Word`, `Ref` and `TooDeepError`. Raises UnsupportedError.
    """
    look = Lookahead(Analysis(grammar), target.nodes)
    emission = Emission(look, target)
    used = Program(grammar)
    rules = [grammar.rules[name] for name in used.rules]
    nodes = [rule for rule in rules if rule.name in target.nodes.keys() - target.written.keys()]
    for rule in nodes:
        emission.rule(rule)
    emission.ordered_attempts()
    terminals = [part for rule in rules for part in inside(rule.body) if isinstance(part, Terminal)]
    reserved = {word for terminal in terminals for word in terminal.reserved or ()}
    text = _DEFINITIONS.format(
        constants="\n".join(look.constants()),
        reserved=sorted(reserved),
        terminals="\n".join(f"    {terminal!r}," for terminal in used.terminals),
        program="\n".join(f"    {pair!r}," for pair in used.instructions),
        begin=target.begin,
        functions="\n".join(emission.lines),
        tables="\n".join(f"    {name} = {table}" for name, table in look.tables.items()),
        names=" = ".join([*_functions(emission.lines), *look.tables]),
        start=grammar.start,
        finish=target.finish,
        result=target.result,
    )
    return text, sorted(rule.name for rule in nodes)


def _functions(lines: Iterable[str]) -> Iterator[str]:
    """Yield the names of the functions defined in lines of source."""
    for line in lines:
        if found := _FUNCTION.match(line):
            yield found[1]
