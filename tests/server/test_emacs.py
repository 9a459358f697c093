"""Test of the Emacs configuration in docs/editors.md."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .model import MODEL

PAGE = Path(__file__).resolve().parents[2] / "docs" / "editors.md"
EMACS = shutil.which("emacs")
BEGIN = ["--batch", "-q", "--eval", "(package-initialize)", "--eval", "(require 'eglot)"]

SESSION = """
(setq eglot-sync-connect 20 eglot-confirm-server-initiated-edits nil)
(find-file "patrol.swarm")
(call-interactively 'eglot)
(let ((tries 200))
  (while (and (> tries 0) (not (flymake-diagnostics)))
    (flymake-start)
    (accept-process-output nil 0.1)
    (setq tries (1- tries))))
(dolist (each (flymake-diagnostics))
  (message "DIAGNOSTIC %s" (flymake-diagnostic-text each)))
(goto-char (point-min))
(search-forward "-> Round")
(backward-char 2)
(message "DEFINITION %s" (xref-item-summary (car (xref-backend-definitions 'eglot "LSP"))))
(eglot-rename "Circle")
(message "RENAMED %s" (how-many "\\\\_<Circle\\\\_>" (point-min) (point-max)))
(search-forward "-> Hone")
(replace-match "-> Home")
(goto-char (point-min))
(search-forward "  initial")
(replace-match "initial")
(eglot-format-buffer)
(message "FORMATTED %s" (how-many "^  initial" (point-min) (point-max)))
(eglot-shutdown (eglot-current-server))
"""


@pytest.fixture
def emacs(tmp_path):
    if EMACS is None or subprocess.run([EMACS, *BEGIN], capture_output=True).returncode:
        pytest.skip("no Emacs with eglot: apt-get install emacs-nox elpa-eglot")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "HOME": str(tmp_path), "PATH": path}

    def run(text):
        file = tmp_path / "session.el"
        file.write_text(text)
        ran = subprocess.run(
            [EMACS, *BEGIN, "-l", str(file)],
            cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120,
        )  # fmt: skip
        assert ran.returncode == 0, ran.stderr
        return ran.stderr

    return run


def test_a_session(emacs, tmp_path):
    (tmp_path / "patrol.swarm").write_text(MODEL.replace("aborted -> Home", "aborted -> Hone"))
    [configuration] = re.findall(r"```lisp\n(.*?)```", PAGE.read_text(), re.DOTALL)
    configuration = configuration.replace("/path/to/swarmdsl", str(PAGE.parents[1]))
    told = emacs(configuration + SESSION).splitlines()
    assert "no state called `Hone`" in next(line for line in told if "DIAGNOSTIC" in line)
    assert "DEFINITION   state Round {" in told
    assert "RENAMED 3" in told
    assert "FORMATTED 1" in told
