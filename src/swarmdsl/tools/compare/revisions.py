"""Models as git has them: what a revision holds, put into a folder for the compiler."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path, PurePosixPath

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass

# What a model is made of, and where settings and packages of interfaces are told by.
_SUFFIXES = frozenset((".swarm", ".msg", ".srv", ".action"))
_NAMES = frozenset(("swarm.toml", "package.xml"))
_FILES = ("100644", "100755")
# As buf writes it: `.git#branch=main`.
_OF_BUF = re.compile(
    r"\.git#(?:branch|tag|ref|commit)=(?P<revision>[^,]+)(?:,subdir=(?P<path>.*))?"
)


@dataclass(frozen=True)
class Revision:
    """A path as a revision has it."""

    revision: str
    path: str

    def __str__(self) -> str:
        return f"{self.revision}:{self.path}"


def against(text: str, path: Path) -> Revision:
    """What `--against` means beside a path: `main`, `HEAD~2`, `main:models`, `.git#tag=v1`."""
    found = _OF_BUF.fullmatch(text)
    if found is not None:
        return Revision(found["revision"], found["path"] or str(path))
    revision, colon, inner = text.partition(":")
    return Revision(revision, inner if colon else str(path))


def named(text: str) -> Path | Revision:
    """A path, or what git calls `REVISION:PATH` where there is no such path."""
    revision, colon, path = text.partition(":")
    if Path(text).exists() or not colon or len(revision) < 2:  # a drive of Windows is one letter
        return Path(text)
    return Revision(revision, path)


def is_revision(text: str, beside: Path) -> bool:
    """Whether git, in the repository of a path, knows a revision of that name."""
    git = _Git(beside, Diagnostics())
    return git.line("rev-parse", "--verify", "--quiet", f"{text}^{{commit}}") is not None


def take_out(wanted: Revision, folder: Path, report: Diagnostics) -> Path | None:
    """Put the models of a revision into a folder; return where the path is in it.

    A path is one in the file system, of which git knows the place, as in `git show REV:./PATH`;
    one of a file that is gone since is found as well. None, and reported, where git has no such
    revision or path.
    """
    git = _Git(Path(wanted.path), report)
    root = git.line("rev-parse", "--show-toplevel")
    if root is None:
        return None
    commit = git.line("rev-parse", "--verify", "--quiet", f"{wanted.revision}^{{commit}}")
    if commit is None:
        git.complain(wanted.revision, "git knows no such revision")
        return None
    path, top = Path(wanted.path).resolve(), Path(root).resolve()
    if not path.is_relative_to(top):
        git.complain(str(wanted), f"a link leads out of the repository, to `{path}`")
        return None
    inner = path.relative_to(top)
    entries = git.ask("ls-tree", "-r", "-z", "--full-tree", commit)
    files = dict(_files(entries or b""))
    place = PurePosixPath(inner.as_posix())
    if not any(place == name or place in name.parents for name in files):
        git.complain(str(wanted), "there is no model in it")
        return None
    content = git.ask("cat-file", "--batch", given="\n".join(files.values()).encode())
    if content is None:
        return None
    for name, data in zip(files, _contents(content), strict=True):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return folder / inner


class _Git:
    """Runs git in the repository of a path."""

    def __init__(self, path: Path, report: Diagnostics) -> None:
        self._path = path
        self._report = report
        folders = (path, *path.absolute().parents)
        self._folder = next(folder for folder in folders if folder.is_dir())

    def ask(self, *arguments: str, given: bytes = b"") -> bytes | None:
        """What git prints; None where it fails."""
        command = ["git", "-C", str(self._folder), *arguments]
        try:
            return subprocess.run(command, input=given, capture_output=True, check=True).stdout
        except FileNotFoundError:
            self.complain(str(self._path), "git is not installed")
        except subprocess.CalledProcessError as error:
            if error.stderr:
                said = error.stderr.decode(errors="replace").strip().splitlines()[-1]
                self.complain(str(self._path), said.removeprefix("fatal: "))
        return None

    def line(self, *arguments: str) -> str | None:
        """The same as one line of text."""
        found = self.ask(*arguments)
        return None if found is None else found.decode(errors="surrogateescape").rstrip("\n")

    def complain(self, name: str, reason: str) -> None:
        """Report what cannot be compared with."""
        self._report.report("no-revision", None, name=name, reason=reason)


def _files(entries: bytes) -> list[tuple[PurePosixPath, str]]:
    """The files of a tree that models may need, with their object names."""
    found = []
    for entry in entries.decode(errors="surrogateescape").split("\0"):
        about, _, name = entry.partition("\t")
        path = PurePosixPath(name)
        if about and (path.suffix in _SUFFIXES or path.name in _NAMES):
            mode, _, object_ = about.split(" ")
            if mode in _FILES:
                found.append((path, object_))
    return found


def _contents(batch: bytes) -> list[bytes]:
    """The contents of the objects that `git cat-file --batch` prints."""
    found, at = [], 0
    while at < len(batch):
        end = batch.index(b"\n", at)
        size = int(batch[at:end].split(b" ")[2])
        found.append(batch[end + 1 : end + 1 + size])
        at = end + size + 2
    return found
