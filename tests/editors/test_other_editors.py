"""Tests of Vim, Neovim, Emacs, Pygments and pre-commit."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Collection
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from pygments.lexers import get_lexer_by_name, get_lexer_for_filename
from pygments.token import Keyword, Name, Operator, String

from .tree_sitter import QUERIES, language

ROOT = Path(__file__).resolve().parents[2]
MODE = ROOT / "editors" / "emacs" / "swarm-mode.el"
RUNTIME = f"set rtp^={ROOT / 'editors' / 'vim'}"
FILES = [
    *sorted((ROOT / "examples").glob("*/*.swarm")),
    ROOT / "tests" / "golden" / "everything" / "model.swarm",
    ROOT / "tests" / "golden" / "language" / "model.swarm",
]
WORD = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/|([A-Za-z_]\w*)')

Coloured = Callable[[list[str]], set[int]]


# Kinds of words that are keywords, and those of escapes, in Vim and Emacs.
VIM = ("Declaration", "Statement", "Include", "Outcome", "Operator", "Boolean")
EMACS = ("font-lock-keyword-face", "font-lock-constant-face")


def of_pygments(text: str) -> set[int]:
    kinds = (Keyword, Operator.Word, Name.Constant)
    found = get_lexer_by_name("swarm").get_tokens_unprocessed(text)
    return {
        at
        for at, kind, word in found
        if kind in kinds or any(kind in each for each in kinds)
        if kind is not Keyword.Type and word.strip()
    }


def of_vim(text: str, folder: Path, kinds: Collection[str] = VIM) -> set[int]:
    vim = shutil.which("vim")
    if (
        vim is None
        or b"+eval" not in subprocess.run([vim, "--version"], capture_output=True).stdout
    ):
        pytest.skip("no Vim with its scripts: apt-get install vim-nox")
    script = r"""
set encoding=utf-8 nocompatible
filetype plugin on
syntax on
edit text.swarm
let found = []
for line in range(1, line('$'))
  let at = 0
  while 1
    let [word, start, end] = matchstrpos(getline(line), '\<\h\w*\>', at)
    if start < 0 | break | endif
    call add(found, [line, start, synIDattr(synID(line, start + 1, 1), 'name')])
    let at = end
  endwhile
endfor
call writefile([json_encode(found), &filetype, &commentstring], 'found.json')
qall!
"""
    (folder / "text.swarm").write_text(text, encoding="utf-8")
    (folder / "run.vim").write_text(script)
    subprocess.run(
        [vim, "-es", "-u", "NONE", "--cmd", RUNTIME, "-S", "run.vim"],
        cwd=folder, check=False, timeout=60, env={**os.environ, "HOME": str(folder)},
    )  # fmt: skip
    found, filetype, comment = (folder / "found.json").read_text().splitlines()
    assert (filetype, comment) == ("swarm", "// %s")
    return places(
        text, [(line - 1, column, kind) for line, column, kind in json.loads(found)], kinds
    )


def places(text: str, found: list[tuple[int, int, str]], kinds: Collection[str]) -> set[int]:
    """Return the offsets of words of some kinds; columns count bytes."""
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line.encode()))
    data = text.encode()
    return {
        len(data[: starts[line] + column].decode())
        for line, column, kind in found
        if kind.removeprefix("swarm") in kinds
    }


def of_emacs(text: str, folder: Path, kinds: Collection[str] = EMACS) -> set[int]:
    emacs = shutil.which("emacs")
    if emacs is None:
        pytest.skip("no Emacs: apt-get install emacs-nox")
    script = r"""
(find-file "text.swarm")
(font-lock-ensure)
(goto-char (point-min))
(unless (eq major-mode 'swarm-mode) (error "no swarm-mode"))
(let (found)
  (while (re-search-forward "\\_<[A-Za-z_][A-Za-z0-9_]*\\_>" nil t)
    (push (vector (1- (match-beginning 0))
                (format "%s" (get-text-property (match-beginning 0) 'face)))
          found))
  (princ (json-encode (vconcat (nreverse found)))))
"""
    (folder / "text.swarm").write_text(text, encoding="utf-8")
    (folder / "run.el").write_text(script)
    ran = subprocess.run(
        [emacs, "--batch", "-q", "--eval", "(require 'json)", "-l", MODE, "-l", "run.el"],
        cwd=folder, capture_output=True, text=True, timeout=60,
        env={**os.environ, "HOME": str(folder), "LC_ALL": "C.UTF-8"},
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    return {at for at, face in json.loads(ran.stdout) if face in kinds}


def of_tree_sitter(texts: list[str]) -> set[int]:
    """Return the keywords of each text by itself: it is a tree, which begins with its package."""
    starts = [sum(map(len, texts[:number])) for number in range(len(texts))]
    return {s + at for s, text in zip(starts, texts, strict=True) for at in of_a_tree(text)}


def of_a_tree(text: str) -> set[int]:
    """Of two captures of a node, the later one counts."""
    from tree_sitter import Parser, Query, QueryCursor

    query = Query(language(), (QUERIES / "highlights.scm").read_text(encoding="utf-8"))
    data = text.encode()
    found: dict[int, tuple[int, str]] = {}
    for pattern, captures in QueryCursor(query).matches(Parser(language()).parse(data).root_node):
        for name, nodes in captures.items():
            for node in nodes:
                found[node.start_byte] = max(found.get(node.start_byte, (0, "")), (pattern, name))
    kinds = ("keyword", "keyword.import", "constant.builtin", "boolean", "variable.builtin")
    return {len(data[:at].decode()) for at, (_, name) in found.items() if name in kinds}


@pytest.fixture(params=["pygments", "vim", "emacs", "tree-sitter"])
def coloured(request: Any, tmp_path: Path) -> Coloured:
    if request.param == "tree-sitter":
        return of_tree_sitter
    if request.param == "pygments":
        return lambda texts: of_pygments("".join(texts))
    of = {"vim": of_vim, "emacs": of_emacs}[request.param]
    return lambda texts: of("".join(texts), tmp_path)


def test_only_keywords_are_highlighted_as_keywords(language: Any, coloured: Coloured) -> None:
    missed: list[str] = []
    wrong: list[str] = []
    texts = [file.read_text(encoding="utf-8") for file in FILES]
    # All texts in one process: the start of an editor takes longer than highlighting them all.
    everywhere = coloured(texts)
    end = 0
    for file, text in zip(FILES, texts, strict=True):
        start, end = end, end + len(text)
        wanted = {
            terminal.position
            for terminal in language.parse(text)
            if language.is_keyword(terminal.rule)
            or terminal.rule.rule_name == "LATER"
            or str(terminal) in ("and", "or", "not")
        }
        # A keyword in properties, a function in expressions: these editors cannot tell.
        either = {found.start() for found in re.finditer(r"\b(?:count|distance)(?=\()", text)}
        # A keyword in measures, and the name of a type.
        typed = {found.start() for found in re.finditer(r"\btime(?=\(| until\b)", text)}
        words = {found.start(): found[1] for found in WORD.finditer(text) if found[1]}
        operators = {at for at, word in words.items() if word in ("and", "or", "not")}
        truth = {at for at, word in words.items() if word in ("true", "false")}
        outcomes = wanted | operators | truth
        found = {at - start for at in everywhere if start <= at < end} & words.keys()

        def shown(places: set[int], text: str = text) -> list[str]:
            return [text[max(at - 20, 0) : at + 20] for at in sorted(places)]

        missed += [f"{file.name}: {each}" for each in shown(outcomes - found - typed)]
        wrong += [f"{file.name}: {each}" for each in shown(found - outcomes - either)]
    assert (missed, wrong) == ([], [])


def test_pygments_lexer_covers_every_character() -> None:
    lexer = get_lexer_for_filename("a.swarm")
    for file in FILES:
        text = file.read_text(encoding="utf-8")
        tokens = list(lexer.get_tokens_unprocessed(text))
        assert "".join(word for _, _, word in tokens) == text
        assert "Text" not in {str(kind).rpartition(".")[2] for _, kind, _ in tokens}


ESCAPES = r"""const A : string = "\u00e9 \U0001f916 \n // \r" // \t
const B : string = "\u12 \w \U0001f91"
"""


def escapes_of_pygments(text: str, folder: Path) -> set[int]:
    lexed = get_lexer_by_name("swarm").get_tokens_unprocessed(text)
    return {at + 1 for at, kind, _ in lexed if kind is String.Escape}


@pytest.mark.parametrize(
    "of",
    [
        escapes_of_pygments,
        partial(of_vim, kinds=["Escape"]),
        partial(of_emacs, kinds=["(font-lock-constant-face font-lock-string-face)"]),
    ],
    ids=["pygments", "vim", "emacs"],
)
def test_escapes_are_highlighted(of: Any, tmp_path: Path) -> None:
    found = of(ESCAPES, tmp_path)
    assert sorted(ESCAPES[at:].split()[0].strip('"') for at in found) == [
        "U0001f916",
        "n",
        "r",
        "u00e9",
    ]


def test_a_session_of_neovim(tmp_path: Path) -> None:
    """The plugin in `editors/vim` starts the server and receives its messages."""
    nvim = shutil.which("nvim")
    if nvim is None:
        pytest.skip("no Neovim: apt-get install neovim")
    model = (ROOT / "examples" / "minimal" / "blinker.swarm").read_text(encoding="utf-8")
    (tmp_path / "swarm.toml").write_text('[project]\nname = "blink"\n')
    (tmp_path / "blinker.swarm").write_text(model.replace("final Off", "final Of"))
    (tmp_path / "session.lua").write_text("""
require("swarmdsl").setup()
vim.cmd("filetype plugin on | syntax on | edit blinker.swarm")
local found = {}
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 50)
found.diagnostics = vim.tbl_map(function(each) return each.message end, vim.diagnostic.get(0))
local function ask(method, line, character, more)
  local params = { textDocument = { uri = vim.uri_from_bufnr(0) },
                   position = { line = line, character = character } }
  params = vim.tbl_extend("force", params, more or {})
  local all = vim.lsp.buf_request_sync(0, method, params, 20000)
  for _, answer in pairs(all or {}) do return answer.result end
end
local line = vim.fn.search("on succeeded") - 1
local hover = ask("textDocument/hover", line, 21)
found.hover = hover and hover.contents.value
found.definition = ask("textDocument/definition", line, 21)
local edit = ask("textDocument/rename", line, 21, { newName = "Shine" })
vim.lsp.util.apply_workspace_edit(edit, "utf-16")
found.renamed = vim.fn.searchcount({ pattern = "\\\\<Shine\\\\>" }).total
found.root = vim.lsp.buf_get_clients(0)[next(vim.lsp.buf_get_clients(0))].config.root_dir
vim.fn.writefile({ vim.fn.json_encode(found) }, "found.json")
vim.cmd("qall!")
""")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    ran = subprocess.run(
        [nvim, "--headless", "-u", "NONE", "--cmd", RUNTIME, "-c", "luafile session.lua"],
        cwd=tmp_path, capture_output=True, text=True, timeout=90,
        env={**os.environ, "HOME": str(tmp_path), "PATH": path},
    )  # fmt: skip
    assert (tmp_path / "found.json").is_file(), ran.stderr
    found = json.loads((tmp_path / "found.json").read_text())
    assert any("no state called `Off`" in each for each in found["diagnostics"])
    assert found["hover"].startswith("```swarm\nstate Blink")
    assert found["definition"]["uri"].endswith("/blinker.swarm")
    assert found["renamed"] == 6
    assert found["root"] == str(tmp_path)


def test_pre_commit_hooks(tmp_path: Path) -> None:
    """Each hook runs as in pre-commit: with changed files, or with none."""
    import yaml

    hooks = {
        each["id"]: each for each in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    }
    model = tmp_path / "model.swarm"
    model.write_text("const   A : int32 = 5\n")
    names = ["model.swarm", "notes.md"]

    def run(hook: dict[str, Any]) -> subprocess.CompletedProcess[str]:
        program, *arguments = hook["entry"].split()
        given = [name for name in names if re.search(hook["files"], name)]
        return subprocess.run(
            [Path(sys.executable).with_name(program), *arguments]
            + (given if hook.get("pass_filenames", True) else []),
            cwd=tmp_path, capture_output=True, text=True, timeout=60,
        )  # fmt: skip

    assert run(hooks["swarmc-fmt"]).returncode == 0
    assert model.read_text() == "const A : int32 = 5\n"
    assert run(hooks["swarmc-check"]).returncode == 0
    model.write_text(
        "endless statemachine Work {\n  initial Idle\n  state Idle {}\n}\n"
        "property Rests of Work : in Idle at all times\n"
    )
    assert run(hooks["swarmc-verify"]).returncode == 0
    model.write_text(model.read_text().replace("in Idle at all", "not in Idle at all"))
    ran = run(hooks["swarmc-verify"])
    assert ran.returncode == 1
    assert "SW1701" in ran.stdout + ran.stderr
    model.write_text("const A : int32 = B\n")
    ran = run(hooks["swarmc-check"])
    assert ran.returncode == 1
    assert "SW0202" in ran.stdout + ran.stderr
