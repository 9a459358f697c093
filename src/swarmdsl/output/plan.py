"""Decides what becomes of each file of an output folder; nothing on disk changes.

A file is as swarmc wrote it when its text was generated, now or before, and no region of it has
lines of the user. Such a file follows the model, whoever it belongs to later. Any other has been
worked on: it is kept where it is there to be filled in, else merged with what is generated now.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress

from swarmdsl import regions
from swarmdsl.dataclass import dataclass, replace
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.fitting_code import mark_in, mark_of, marked, outdated
from swarmdsl.generator import OutputFile
from swarmdsl.manifest import Hashes, Manifest, content_hash
from swarmdsl.map_file import Maps, Positions
from swarmdsl.output import remarks
from swarmdsl.output.changes import Action, Change, How, Written
from swarmdsl.output.disk import Disk, report_os_error
from swarmdsl.output.merge import merge
from swarmdsl.output.names import Names
from swarmdsl.output.remarks import NEW, NOTE
from swarmdsl.output.texts import Texts
from swarmdsl.output_path import clash_key

PARKED = ".parked"
"""The folder for files that are put aside. Tools of ROS pass over a folder of such a name."""


@dataclass(frozen=True)
class _Found:
    """What stands for a file: its content, and the hash of the text that it was made from.

    `source` is where it is, if not in its place; `names` how its element was called before.
    """

    content: bytes
    base: str | None
    source: str | None = None
    names: Names | None = None


class Plan:
    """What is to be done in a folder; all paths are below it.

    `before` is the manifest as it was, `hashes` the files of it as they will be. What is found
    goes to `report`, and nothing may be done where that is an error; `remarks` are told beside
    what is done.
    """

    def __init__(self, disk: Disk, before: Manifest, how: How, report: Diagnostics) -> None:
        self.disk, self.before, self.how, self.report = disk, before, how, report
        self.remarks = Diagnostics()
        self.texts = Texts(disk.out)
        self.hashes: Hashes = {}
        self.parked = dict(before.parked)
        self.owners: dict[str, str] = {}
        self.maps: Maps = {}
        self._positions = Positions(disk.out)
        self.changes: list[Change] = []
        self.unchanged: list[str] = []
        self.kept: list[str] = []
        self.edited: list[str] = []
        self.conflicts: list[str] = []
        self._moved: dict[str, tuple[str, Names]] = {}

    # ---- what is asked from outside

    def add_all(self, output: Mapping[str, Sequence[OutputFile]]) -> None:
        """Decide about all files of these targets, and about those that they have no more."""
        made = {f"{target}/{file.path}": file for target, files in output.items() for file in files}
        self._find_moves(made)
        for path, file in made.items():
            self._add(path, file)
        self._add_stale(output.keys())
        self._add_strays(output.keys(), made)
        self._find_renamed(made)

    def clean(self, targets: Collection[str]) -> None:
        """Decide to remove what was generated for these targets and not edited."""
        for path, hash_ in self.before.files.items():
            self.hashes[path] = hash_
            with suppress(OSError):
                content = self.disk.content(path) if self._leads_inside(path) else None
                of_target = path.partition("/")[0] in targets
                if content is None or not of_target:
                    continue
                if self.disk.is_link(path) or not self._is_pristine(path, content, hash_):
                    self.edited.append(path)
                    continue
                del self.hashes[path]
                self.changes.append(Change(Action.REMOVE, path, content, None))
        self._keep_what_is_known()

    @property
    def written(self) -> Written:
        """What becomes of the files."""
        return Written(
            self.disk.out,
            tuple(self.changes),
            tuple(self.unchanged),
            tuple(self.kept),
            tuple(self.edited),
            tuple(self.conflicts),
        )

    @property
    def manifest(self) -> Manifest:
        """The list as it will be."""
        return Manifest(self.hashes, self.parked, self.owners, self.maps)

    # ---- files that are generated

    def _add(self, path: str, file: OutputFile) -> None:
        if not self._is_inside(path):
            return
        try:
            new = file.text.encode()
            found = self._found(path)
        except UnicodeEncodeError:
            reason = "it has characters that are not Unicode"
            self.report.report("cannot-write", path=str(self.disk.out / path), reason=reason)
        except NotADirectoryError:
            reason = "it is a file where a folder is needed"
            obstacle = str(self.disk.obstacle(path))
            self.report.report("cannot-write", path=obstacle, reason=reason)
        except OSError as error:
            report_os_error(self.disk.out / path, error, self.report)
        else:
            self.hashes[path] = self.texts.add(file.text)
            self.maps[path] = self._positions.file_map(file)
            if file.facts:
                self.texts.add_facts(file.facts)
            if file.owner and file.keep:
                self.owners[path] = f"{file.owner} {mark_of(file.facts)}"
            if found is None:
                self._change(Action.CREATE, path, None, new, file)
            elif file.keep:
                self._keep(path, file, new, found)
            else:
                self._update(path, file, new, found)

    def _keep(self, path: str, file: OutputFile, new: bytes, found: _Found) -> None:
        """Leave a file that is the user's as it is, once there is something of the user in it."""
        if self._is_pristine(path, found.content, found.base):
            self._settle(path, file, found, new)
            return
        found = self._renamed(path, file, new, found)
        marks = outdated(found.content, new)
        if marks is not None:
            # What its code builds on is still the old text.
            self.hashes[path] = found.base or self.hashes[path]
            base = self.texts.get(found.base)
            facts = self.texts.facts(marks[0])
            note = remarks.changed_below(path, file, found.content, base, facts)
            place = self.disk.out / path
            self._add_neighbour(f"{path}{NOTE}", note)
            remarks.report_outdated(place, file, marks, facts, self.remarks)
        if found.source is None:
            self.kept.append(path)
        else:
            self._bring(path, found, found.content)

    def _update(self, path: str, file: OutputFile, new: bytes, found: _Found) -> None:
        """Bring a file up to date that is swarmc's, with what the user has written in it."""
        pristine = self._is_generated(found.content, found.base)
        if pristine:
            found = replace(found, base=content_hash(found.content))
        found = self._renamed(path, file, new, found)
        try:
            of_user = regions.kept(found.content)
        except regions.RegionError:
            of_user = {}
        filled, lost = regions.filled(new, of_user)
        if found.content == filled or (pristine and not lost):
            self._settle(path, file, found, filled)
            return
        if self.how.force:
            self._change(Action.OVERWRITE, path, found.content, filled, file, found.source)
            return
        if found.base is None and found.source is None:
            self._report_foreign(path)
            return
        self._merge(path, file, filled, found, of_user)

    def _merge(
        self, path: str, file: OutputFile, filled: bytes, found: _Found, of_user: regions.Texts
    ) -> None:
        base_hash, neighbour = found.base, f"{path}{NEW}"
        offered = self.before.files.get(neighbour)
        if offered is not None and self.disk.content(neighbour) is None:
            # It was deleted: the user has taken over what is wanted of it.
            base_hash = offered
        base = self.texts.get(base_hash)
        if base is None and base_hash == self.hashes[path]:
            base = file.text.encode()
        if base is not None:
            base = self._base_as_edited(base, found, filled, of_user)
        place = self.disk.out / path
        merged = merge(base, found.content, filled) if base is not None else None
        if base is None or merged is None or merged.text is None:
            # Where nothing is known of it, all of it is the user's: it was made from nothing.
            self.hashes[path] = base_hash or self.texts.add("")
            self._add_neighbour(neighbour, filled)
            remarks.report_conflict(place, found.content, merged, self.remarks)
            if found.source is None:
                self.conflicts.append(path)
            else:
                self._bring(path, found, found.content)
            return
        remarks.report_edited(place, found.content, base, merged.taken, self.remarks)
        if found.source is not None:
            self._bring(path, found, merged.text)
        elif merged.text == found.content:
            self.edited.append(path)
        else:
            self._change(Action.MERGE, path, found.content, merged.text, file)

    def _base_as_edited(
        self, base: bytes, found: _Found, filled: bytes, of_user: regions.Texts
    ) -> bytes:
        """The text from before with the regions of the user that stay, and under the new name."""
        if found.names is not None:
            text, _ = found.names.rewritten(base.decode(), filled.decode(errors="surrogateescape"))
            base = text.encode(errors="surrogateescape")
        with suppress(regions.RegionError):
            staying = regions.ids(filled)
            base, _ = regions.filled(
                base, {id_: text for id_, text in of_user.items() if id_ in staying}
            )
        return base

    def _settle(self, path: str, file: OutputFile, found: _Found, new: bytes) -> None:
        """Write a text in place of one that has nothing of the user but what is in it too."""
        if found.source is not None:
            self._bring(path, found, new)
            return
        has_mode = not file.executable or self.disk.is_executable(path)
        if found.content == new and has_mode:
            self.unchanged.append(path)
        else:
            self._change(Action.CHANGE, path, found.content, new, file)

    # ---- where a file is

    def _found(self, path: str) -> _Found | None:
        content = self.disk.content(path)
        base = self.before.files.get(path)
        if path in self._moved:
            source, names = self._moved[path]
            if content is None or self._is_pristine(path, content, base):
                return self._found_elsewhere(source, names)
            reason = f"`{self.disk.out / path}` has lines of yours already"
            help_ = f"move them away, or put those of `{self.disk.out / source}` there by hand"
            self.report.report("bad-rename", old=names.old, new=names.new, fault=reason, help=help_)
            return None
        if content is not None:
            return _Found(content, base)
        aside = f"{PARKED}/{path}"
        content = self.disk.content(aside) if self._leads_inside(aside) else None
        if content is None:
            return None
        return _Found(content, self.parked.pop(path, None), aside)

    def _found_elsewhere(self, source: str, names: Names) -> _Found | None:
        content = self.disk.content(source)
        if content is None:
            return None
        path = source.removeprefix(f"{PARKED}/")
        base = self.before.parked.get(path) if path != source else self.before.files.get(path)
        return _Found(content, base, source, names)

    def _find_moves(self, made: Mapping[str, OutputFile]) -> None:
        """Which files are those of elements that had another name, and have lines of the user."""
        for old, new in self.how.renames:
            names = Names(old, new)
            found = 0
            for path, base in (*self.before.files.items(), *self.before.parked.items()):
                moved = names(path)
                if moved == path or moved not in made or path in made:
                    continue
                found += 1
                source = path if path in self.before.files else f"{PARKED}/{path}"
                with suppress(OSError):
                    content = self.disk.content(source) if self._leads_inside(source) else None
                    if content is not None and not self._is_pristine(path, content, base):
                        self._moved[moved] = (source, names)
                        if source != path:
                            self.parked.pop(path, None)
            if not found:
                remarks.report_bad_rename(names, made, self.report)

    def _add_strays(self, targets: Collection[str], made: Mapping[str, OutputFile]) -> None:
        """Move what the user has put beside generated files into the folder with the new name."""
        known = (*self.before.files, *self.before.parked)
        tops = {"/".join(path.split("/")[:2]) for path in known}
        for old, new in self.how.renames:
            names = Names(old, new)
            for top in sorted(top for top in tops if names(top) != top):
                taken = any(path.startswith(f"{top}/") for path in made)
                if taken or top.partition("/")[0] not in targets:
                    continue
                for path in self.disk.files(top):
                    moved = names(path)
                    free = moved not in made and not (self.disk.out / moved).exists()
                    if path not in self.before.files and free and self._leads_inside(path):
                        content = (self.disk.out / path).read_bytes()
                        self._bring(moved, _Found(content, None, path, names), content)

    def _find_renamed(self, made: Mapping[str, OutputFile]) -> None:
        """Tell of new elements that may be those that are gone, under another name."""
        aside: dict[tuple[str, str], list[str]] = {}
        for path in self.parked:
            if path in self.owners and path not in made:
                old, _, mark = self.owners[path].partition(" ")
                aside.setdefault((old, mark), []).append(path)
        created = {change.path for change in self.changes if change.action is Action.CREATE}
        fresh = {path: file for path, file in made.items() if file.owner and path in created}
        for (old, mark), paths in aside.items():
            owners = {file.owner for file in fresh.values()} - {old}
            facts = self.texts.facts(mark) or []
            like = [new for new in owners if _is_like(Names(old, new), paths, facts, fresh)]
            if len(like) == 1:
                place = next(file.origin for file in fresh.values() if file.owner == like[0])
                remarks.report_renamed(old, like[0], place, self.how.command, self.remarks)

    def _renamed(self, path: str, file: OutputFile, new: bytes, found: _Found) -> _Found:
        """The content with the new name of its element, as far as that is clear."""
        if found.names is None:
            return found
        text = found.content.decode(errors="surrogateescape")
        text, left = found.names.rewritten(text, new.decode())
        content = text.encode(errors="surrogateescape")
        mark = mark_in(content)
        facts = self.texts.facts(mark) if mark is not None and file.facts else None
        if facts is not None and found.names.same(facts, file.facts):
            content = marked(content, mark_of(file.facts))
        remarks.report_old_name(self.disk.out / path, content, left, found.names, self.remarks)
        return replace(found, content=content)

    # ---- files that are not generated any more

    def _add_stale(self, targets: Collection[str]) -> None:
        for path in [path for path in self.parked if not self._is_there(f"{PARKED}/{path}")]:
            del self.parked[path]
        new = {clash_key(path): path for path in self.hashes}
        moved = {source for source, _ in self._moved.values()}
        for path, old in self.before.files.items():
            if path.partition("/")[0] not in targets:
                self.hashes[path] = old
            elif path not in new.values() and path not in moved:
                self._drop(path, old, new.get(clash_key(path)))
        self._keep_what_is_known()

    def _keep_what_is_known(self) -> None:
        """Of files that are no more looked at, but there."""
        for path, owner in self.before.owners.items():
            if path in self.hashes or path in self.parked:
                self.owners.setdefault(path, owner)
        for path, map_ in self.before.maps.items():
            if path in self.hashes:
                self.maps.setdefault(path, map_)

    def _drop(self, path: str, old: str, successor: str | None) -> None:
        """Remove a file, or put it aside where it has lines of the user."""
        with suppress(OSError):
            if self.disk.is_link(path) or not self._leads_inside(path):
                return
            if successor is not None and self.disk.same(path, successor):
                return  # one file under two names, where case does not count
            content = self.disk.content(path)
            if content is None:
                return
            if self._is_pristine(path, content, old):
                self.changes.append(Change(Action.REMOVE, path, content, None))
            else:
                self._park(path, content, old)

    def _park(self, path: str, content: bytes, old: str) -> None:
        aside, number = f"{PARKED}/{path}", 1
        while self._is_there(aside) and self.disk.content(aside) != content:
            aside, number = f"{PARKED}/{path}.{number}", number + 1
        if not self._is_inside(aside):
            return
        self.parked[aside.removeprefix(f"{PARKED}/")] = old
        mode = self.disk.mode(path)
        self.changes.append(Change(Action.PARK, aside, content, content, path, mode=mode))
        out = self.disk.out
        remarks.report_parked(out / path, out / aside, self.remarks)

    # ---- steps

    def _change(
        self,
        action: Action,
        path: str,
        before: bytes | None,
        after: bytes,
        file: OutputFile,
        source: str | None = None,
    ) -> None:
        self.changes.append(Change(action, path, before, after, source, file.executable))

    def _bring(self, path: str, found: _Found, content: bytes) -> None:
        """Put a file in its place that is in another one."""
        assert found.source is not None
        action = Action.RESTORE if found.names is None else Action.MOVE
        mode = self.disk.mode(found.source)
        before = self.disk.content(found.source)
        self.changes.append(Change(action, path, before, content, found.source, mode=mode))

    def _add_neighbour(self, path: str, content: bytes) -> None:
        """Write a file beside another one, if the user has not written in it."""
        self.hashes[path] = content_hash(content)
        with suppress(OSError):
            old = self.disk.content(path)
            known = self.before.files.get(path)
            if old == content:
                self.unchanged.append(path)
            elif old is None:
                self.changes.append(Change(Action.CREATE, path, None, content))
            elif self._is_pristine(path, old, known):
                self.changes.append(Change(Action.CHANGE, path, old, content))
            else:
                self.edited.append(path)

    def _is_pristine(self, path: str, content: bytes, base: str | None) -> bool:
        """Whether a file is as swarmc wrote it, with no line of the user in a region."""
        # What would be in place of another file has the lines from there.
        is_copy = path.endswith(NEW)
        return self._is_generated(content, base) and (is_copy or not _has_lines_of_user(content))

    def _is_generated(self, content: bytes, base: str | None) -> bool:
        """The same, but for what is in regions."""
        return content_hash(content) == base or self.texts.knows(content)

    def _report_foreign(self, path: str) -> None:
        reason = "it is not from swarmc"
        help_ = "move it away, or overwrite it with `--force`"
        place = str(self.disk.out / path)
        self.report.report("would-overwrite", path=place, reason=reason, help=help_)

    def _is_inside(self, path: str) -> bool:
        if self._leads_inside(path):
            return True
        notes = ("a symbolic link on the way leads out of the folder",)
        place = str(self.disk.out / path)
        target = path.removeprefix(f"{PARKED}/").partition("/")[0]
        self.report.report("outside-output", target=target, path=place, notes=notes)
        return False

    def _leads_inside(self, path: str) -> bool:
        return self.disk.leads_inside(path)

    def _is_there(self, path: str) -> bool:
        return (self.disk.out / path).exists()


def _has_lines_of_user(content: bytes) -> bool:
    with suppress(regions.RegionError):
        return bool(regions.kept(content))
    return False


def _is_like(
    names: Names, paths: Iterable[str], facts: Sequence[str], fresh: Mapping[str, OutputFile]
) -> bool:
    """Whether files of an element would be those of another one, if it had another name."""
    files = [fresh.get(names(path)) for path in paths]
    return all(file is not None and names.same(facts, file.facts) for file in files)
