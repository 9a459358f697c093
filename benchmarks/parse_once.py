"""Time one parser.

Usage: `python benchmarks/parse_once.py PARSER WARM_UP FILE...`

Prints the CPU seconds for all files, after parsing the warm-up file a few times. Each parser runs
in a separate process, without garbage collection, which helps all of them.
"""

from __future__ import annotations

import gc
import os
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from time import process_time
from typing import Any

PEERS = Path(__file__).resolve().parent / "peers"
GRAMMAR = PEERS.parents[1] / "grammar"
WARM_UPS = 5

# Parses files, given with their text, or raises an exception.
Parser = Callable[[Sequence[Path], Sequence[str]], object]


def _swarmdsl() -> Parser:
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.base.source import Source
    from swarmdsl.syntax.parse import parse

    def run(files: Sequence[Path], texts: Sequence[str]) -> object:
        report = Diagnostics()
        parsed = [
            parse(Source(str(file), text), report) for file, text in zip(files, texts, strict=True)
        ]
        if report.has_errors:
            raise ValueError([found.message for found in report])
        return parsed

    return run


def _textx() -> Parser:
    from swarmdsl.syntax.pegen.metamodel import metamodel

    return _each(metamodel().model_from_str)


def lark() -> Any:
    """Return Lark's LALR parser of the language."""
    from lark import Lark

    lexical = (GRAMMAR / "lexical.tx").read_text(encoding="utf-8")
    ident = re.search(r"^IDENT: /(.*)/;$", lexical, re.MULTILINE)
    assert ident is not None
    grammar = (PEERS / "swarm.lark").read_text(encoding="utf-8")
    return Lark(grammar.replace("%IDENT%", ident[1]), parser="lalr")


def _lark() -> Parser:
    return _each(lark().parse)


def _sqlglot() -> Parser:
    import sqlglot

    return _each(sqlglot.parse)


def _cpython() -> Parser:
    import ast

    return _each(ast.parse)


def _protoc() -> Parser:
    from grpc_tools import protoc

    def run(files: Sequence[Path], _texts: Sequence[str]) -> None:
        folder = files[0].parent
        output = f"--descriptor_set_out={os.devnull}"
        if protoc.main(["protoc", f"-I{folder}", output, *map(str, files)]):
            raise ValueError(f"protoc refuses files in {folder}")

    return run


def _each(parse: Callable[[str], object]) -> Parser:
    return lambda _files, texts: [parse(text) for text in texts]


PARSERS: dict[str, Callable[[], Parser]] = {
    "swarmdsl": _swarmdsl,
    "textX": _textx,
    "Lark": _lark,
    "protoc": _protoc,
    "sqlglot": _sqlglot,
    "CPython": _cpython,
}


def main() -> None:
    """Print the seconds."""
    name, *names = sys.argv[1:]
    gc.disable()
    parse = PARSERS[name]()
    warm_up, *files = map(Path, names)
    text = warm_up.read_text(encoding="utf-8")
    for _ in range(WARM_UPS):
        parse([warm_up], [text])
    texts = [file.read_text(encoding="utf-8") for file in files]
    start = process_time()
    parsed = parse(files, texts)
    print(process_time() - start, flush=True)
    del parsed
    os._exit(0)  # skip the destruction of the results


if __name__ == "__main__":
    main()
