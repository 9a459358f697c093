"""Fixtures: words of the language, and tools of Node."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from arpeggio import RegExMatch, StrMatch, Terminal
from textx import metamodel_from_file

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "editors" / "vscode"
OFFLINE = re.compile(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ENETUNREACH|ETIMEDOUT")

# Skip the scan for secrets: it takes longer than all the rest, and they would be in the repository.
UNSEARCHED = "--allow-package-all-secrets --allow-package-env-file"

# Token: line, first column, column after it (from 0), scopes from the outermost.
Token = tuple[int, int, int, list[str]]
Npm = Callable[..., "subprocess.CompletedProcess[str]"]


class Language:
    """Keywords of the textX grammar, and its parser."""

    def __init__(self) -> None:
        self.metamodel = metamodel_from_file(ROOT / "grammar" / "swarm.tx", autokwd=True)
        # Reference targets do not matter here, but textX requires an object.
        self.metamodel.register_scope_providers({"*.*": lambda *_: object()})
        rules = list(_rules(self.metamodel._parser_blueprint.parser_model, set()))
        self.keywords = {rule.to_match for rule in rules if self.is_keyword(rule)}
        self.regexes = {r.rule_name: r.to_match for r in rules if isinstance(r, RegExMatch)}
        reserved = re.match(r"\(\?!\(\?:([a-z|]+)\)\\b\)", self.regexes["IDENT"])
        assert reserved, "IDENT in grammar/lexical.tx has no list of reserved words"
        self.reserved = set(reserved[1].split("|"))
        self.contextual = self.keywords - self.reserved

    @staticmethod
    def is_keyword(rule: Any) -> bool:
        """Return True if a parser rule is a keyword; `autokwd` turns them into regexes."""
        return isinstance(rule, StrMatch | RegExMatch) and rule.to_match.isalpha()

    def parse(self, text: str) -> list[Terminal]:
        """Return the terminals of `text`. Raises an error of textX if it is invalid."""
        return list(_terminals(self.metamodel.model_from_str(text)._tx_parser.parse_tree))


def _rules(rule: Any, seen: set[int]) -> Iterator[Any]:
    if id(rule) not in seen:
        seen.add(id(rule))
        yield rule
        for inner in getattr(rule, "nodes", ()):
            yield from _rules(inner, seen)


def _terminals(node: Any) -> Iterator[Terminal]:
    if isinstance(node, Terminal):
        yield node
    else:
        for inner in node:
            yield from _terminals(inner)


@pytest.fixture(scope="session")
def language() -> Language:
    return Language()


@pytest.fixture(scope="session")
def npm() -> Npm:
    """Return a function that runs npm in the extension, with its development tools installed."""
    program = shutil.which("npm")
    if program is None or shutil.which("node") is None:
        pytest.skip("no Node: apt-get install nodejs npm")

    def run(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [program, *arguments], cwd=EXTENSION, capture_output=True, text=True, **options
        )

    lock = EXTENSION / "package-lock.json"
    installed = EXTENSION / "node_modules" / ".package-lock.json"
    if not installed.is_file() or installed.stat().st_mtime < lock.stat().st_mtime:
        result = run("ci")
        if result.returncode and OFFLINE.search(result.stderr):
            pytest.skip("npm cannot fetch the tools of the extension: `make vsix`")
        assert result.returncode == 0, result.stderr
    return run


@pytest.fixture(scope="session")
def packages(npm: Npm, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return two packages of the extension, built in different folders at the same time."""
    if shutil.which("make") is None:
        pytest.skip("no make: apt-get install make")

    def packaged(zone: str) -> Path:
        folder = tmp_path_factory.mktemp("package")
        made = subprocess.run(
            ["make", "vsix", f"VSIX_DIR={folder}", f"VSCE={UNSEARCHED}"],
            cwd=ROOT,
            env={**os.environ, "TZ": zone, "SOURCE_DATE_EPOCH": "1700000000"},
            capture_output=True,
            text=True,
        )
        assert made.returncode == 0, made.stderr
        [package] = folder.glob("*.vsix")
        return package

    return packaged("UTC"), packaged("Pacific/Auckland")


@pytest.fixture(scope="session")
def tokenize(npm: Npm) -> Iterator[Callable[[str], list[Token]]]:
    """Return a tokenizer with the TextMate grammar, using the library of VS Code."""
    with subprocess.Popen(
        ["node", EXTENSION / "tests" / "tokenize.js"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        stdin, stdout = process.stdin, process.stdout
        assert stdin is not None
        assert stdout is not None

        def run(text: str) -> list[Token]:
            stdin.write(json.dumps(text) + "\n")
            stdin.flush()
            return [tuple(token) for token in json.loads(stdout.readline())]

        yield run
        stdin.close()
