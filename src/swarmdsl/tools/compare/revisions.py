"""Read models from git revisions."""

from __future__ import annotations

import os
import re
from pathlib import Path, PurePosixPath

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.find_files import MOST_TOGETHER
from swarmdsl.base.git import run_git
from swarmdsl.base.read_files import exists, is_folder
from swarmdsl.base.records import dataclass

# Sources of a model, and files that configure a project or name a package of interfaces.
_SUFFIXES = frozenset((".swarm", ".msg", ".srv", ".action"))
_NAMES = frozenset(("swarm.toml", "package.xml"))
_FILES = ("100644", "100755")
# Notation of buf: `.git#branch=main`.
_BUF_NOTATION = re.compile(
    r"\.git#(?:branch|tag|ref|commit)=(?P<revision>[^,]+)(?:,subdir=(?P<path>.*))?"
)


@dataclass(frozen=True)
class Revision:
    """Path in a git revision."""

    revision: str
    path: str

    def __str__(self) -> str:
        return f"{self.revision}:{self.path}"


def parse_against(text: str, path: Path) -> Revision:
    """Parse `--against`: `main`, `HEAD~2`, `main:models`, `.git#tag=v1`."""
    found = _BUF_NOTATION.fullmatch(text)
    if found is not None:
        return Revision(found["revision"], found["path"] or str(path))
    revision, colon, inner = text.partition(":")
    return Revision(revision, inner if colon else str(path))


def parse_model(text: str) -> Path | Revision:
    """Parse a path or, if no such path exists, `REVISION:PATH`."""
    revision, colon, path = text.partition(":")
    if exists(text) or not colon or len(revision) < 2:  # one letter: a Windows drive
        return Path(text)
    return Revision(revision, path)


def is_revision(text: str, beside: Path) -> bool:
    """Return True if the git repository of a path has such a revision."""
    git = _Git(beside, Diagnostics())
    return git.commit(text) is not None


def extract(revision: Revision, folder: Path, report: Diagnostics) -> Path | None:
    """Extract the models of a revision into a folder and return the path in it.

    The path refers to the file system, as in `git show REV:./PATH`; a file that no longer exists is
    found as well. If git has no such revision or path, report it and return None.
    """
    git = _Git(Path(revision.path), report)
    root = git.run_line("rev-parse", "--show-toplevel")
    if root is None:
        return None
    commit = git.commit(revision.revision)
    if commit is None:
        git.fail(revision.revision, "no such revision in git")
        return None
    path, top = Path(os.path.realpath(revision.path)), Path(os.path.realpath(root))
    if not path.is_relative_to(top):
        git.fail(str(revision), f"a link leads out of the repository to `{path}`")
        return None
    inner = path.relative_to(top)
    entries = git.run("ls-tree", "-r", "-z", "-l", "--full-tree", commit)
    listed = list_files(entries or b"")
    if sum(size for _, _, size in listed) > MOST_TOGETHER:
        much = f"{MOST_TOGETHER // 2**20} MB of models"
        git.fail(str(revision), f"its repository has more than {much}")
        return None
    files = {path: object_ for path, object_, _ in listed}
    place = PurePosixPath(inner.as_posix())
    if not any(place == name or place in name.parents for name in files):
        git.fail(str(revision), "it contains no model")
        return None
    content = git.run("cat-file", "--batch", given="\n".join(files.values()).encode())
    if content is None:
        return None
    contents = split_batch(content)
    if len(contents) < len(files):
        git.fail(str(revision), "the repository lacks content of it: fetch it with git first")
        return None
    try:
        for name, data in zip(files, contents, strict=True):
            _write(folder, name, data)
    except (OSError, ValueError) as error:
        git.fail(str(revision), getattr(error, "strerror", None) or str(error))
        return None
    return folder / inner


def _write(folder: Path, name: PurePosixPath, data: bytes) -> None:
    """Write a file below a folder. Raises OSError, or ValueError if its name leads elsewhere."""
    path = folder / name
    if not Path(os.path.normpath(path)).is_relative_to(folder) or ".." in name.parts:
        raise ValueError(f"its file `{name}` leads out of the repository")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


class _Git:
    """Git in the repository of a path."""

    def __init__(self, path: Path, report: Diagnostics) -> None:
        self._path = path
        self._report = report
        folders = (path, *path.absolute().parents)
        self._folder = next(folder for folder in folders if is_folder(folder))

    def run(self, *arguments: str, given: bytes = b"") -> bytes | None:
        """Output of a git command; None if it fails."""
        try:
            done = run_git(self._folder, *arguments, given=given)
        except FileNotFoundError:
            self.fail(str(self._path), "git is not installed")
            return None
        if done.returncode == 0:
            return done.stdout
        if lines := done.stderr.decode(errors="replace").strip().splitlines():
            message = lines[-1]
            self.fail(str(self._path), message.removeprefix("fatal: "))
        return None

    def run_line(self, *arguments: str) -> str | None:
        """Output of a git command as one line."""
        found = self.run(*arguments)
        return None if found is None else found.decode(errors="surrogateescape").rstrip("\n")

    def commit(self, revision: str) -> str | None:
        """Name of the commit of a revision; None if there is none."""
        words = ("--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
        return self.run_line("rev-parse", *words)

    def fail(self, name: str, reason: str) -> None:
        """Report a revision that cannot be read."""
        self._report.report("no-revision", None, name=name, reason=reason)


def list_files(entries: bytes) -> list[tuple[PurePosixPath, str, int]]:
    """Files of a tree that models may need, with their object names and sizes."""
    found = []
    for entry in entries.decode(errors="surrogateescape").split("\0"):
        about, _, name = entry.partition("\t")
        path = PurePosixPath(name)
        if about and (path.suffix in _SUFFIXES or path.name in _NAMES):
            mode, _, object_, size = about.split()
            if mode in _FILES:
                # A partial clone knows no size of what it lacks.
                found.append((path, object_, int(size) if size.isdecimal() else 0))
    return found


def split_batch(batch: bytes) -> list[bytes]:
    """Contents of the objects that `git cat-file --batch` prints, up to a missing one."""
    found, at = [], 0
    while at < len(batch):
        end = batch.index(b"\n", at)
        about = batch[at:end].split(b" ")
        if len(about) < 3:  # NAME missing
            break
        size = int(about[2])
        found.append(batch[end + 1 : end + 1 + size])
        at = end + size + 2
    return found
