"""Run git in repositories of strangers: it runs no program that they name, and fetches nothing.

The configuration of a repository can name programs, such as `core.fsmonitor`, and addresses from
which git fetches content that a partial clone lacks, with a program of their own. Commands that
only read objects need none of that.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

# They take precedence over every file.
_SETTINGS = {
    "core.fsmonitor": "false",
    "core.hooksPath": os.devnull,
    "core.alternateRefsCommand": "",
    "diff.external": "",
    "protocol.allow": "never",
    # A folder that looks like a repository is none, unless git is told so.
    "safe.bareRepository": "explicit",
}
_ENVIRONMENT = {
    "GIT_ALLOW_PROTOCOL": "",
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_TERMINAL_PROMPT": "0",
}


def run_git(
    folder: Path, *arguments: str, given: bytes = b""
) -> subprocess.CompletedProcess[bytes]:
    """Run a git command that only reads, in a folder. Raises OSError if there is no git.

    Whether the owner of a repository is trusted (`safe.directory`) is left to git.
    """
    settings = [word for name, value in _SETTINGS.items() for word in ("-c", f"{name}={value}")]
    return subprocess.run(
        ["git", "-C", str(folder), *settings, *arguments],
        input=given,
        capture_output=True,
        check=False,
        env={**os.environ, **_ENVIRONMENT},
    )
