"""Writes the generated files: all of them or none, and never over what the user wrote.

The files of target `t` go to the folder `t` of the output folder. A manifest lists what
was generated there; whatever is not in it, or was edited since, is the user's.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from pathlib import Path

from swarmdsl import manifest, regions
from swarmdsl.dataclass import dataclass, field
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.fitting_code import outdated
from swarmdsl.generator import OutputFile
from swarmdsl.map_file import Maps, Positions
from swarmdsl.output_path import clash_key
from swarmdsl.staging import Staging


@dataclass(frozen=True)
class Written:
    """What became of each file, as paths below the output folder.

    `kept` are files of the user that were left as they are, `removed` were generated
    before and are no longer part of the output, `left` are such files that were edited.
    """

    folder: Path
    written: tuple[str, ...] = ()
    unchanged: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    left: tuple[str, ...] = ()


def write(
    output: Mapping[str, Sequence[OutputFile]],
    out: Path,
    report: Diagnostics,
    *,
    force: bool = False,
) -> Written | None:
    """Bring the folder `out` up to date with the files of each target.

    `force` overwrites what the user wrote or edited, except files that are the user's to
    keep. None when something stands in the way: it is reported and nothing is changed.
    """
    plan = _Plan(out, manifest.read(out), manifest.read_maps(out) or {}, force, report)
    for target, files in output.items():
        for file in files:
            plan.add(target, file)
    plan.add_stale(output.keys())
    if report.has_errors:
        return None
    try:
        _carry_out(plan)
    except OSError as error:
        _report_os_error(Path(error.filename or out), error, report)
        return None
    return Written(
        out,
        tuple(plan.contents),
        tuple(plan.unchanged),
        tuple(plan.kept),
        tuple(plan.stale),
        tuple(plan.left),
    )


@dataclass
class _Plan:
    """What is to be done; all paths are below `out`.

    `before` and `maps_before` are the manifest as it was, `hashes` and `maps` as it will be;
    `inside` says of folders whether they are in `out`, whatever links lead there.
    """

    out: Path
    before: manifest.Hashes
    maps_before: Maps
    force: bool
    report: Diagnostics
    hashes: manifest.Hashes = field(default_factory=dict)
    maps: Maps = field(default_factory=dict)
    contents: dict[str, bytes] = field(default_factory=dict)
    executable: set[str] = field(default_factory=set)
    unchanged: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    inside: dict[Path, bool] = field(default_factory=dict)

    @cached_property
    def _positions(self) -> Positions:
        return Positions(self.out)

    def add(self, target: str, file: OutputFile) -> None:
        """Decide what happens to a file; what stands in the way is reported."""
        self.maps[f"{target}/{file.path}"] = self._positions.file_map(file)
        place = self.out / target / file.path
        if not self._leads_inside(place):
            notes = ("a symbolic link on the way leads out of the folder",)
            self.report.report("outside-output", target=target, path=str(place), notes=notes)
            return
        try:
            new, old = file.text.encode(), _content(place)
        except UnicodeEncodeError:
            reason = "it has characters that are not Unicode"
            self.report.report("cannot-write", path=str(place), reason=reason)
        except NotADirectoryError:
            obstacle = next(
                above for above in place.parents if above.exists() and not above.is_dir()
            )
            reason = "it is a file where a folder is needed"
            self.report.report("cannot-write", path=str(obstacle), reason=reason)
        except OSError as error:
            _report_os_error(place, error, self.report)
        else:
            self._decide(f"{target}/{file.path}", file, new, old)

    def _decide(self, path: str, file: OutputFile, new: bytes, old: bytes | None) -> None:
        if file.keep and old is not None:
            self.kept.append(path)
            self._check_fits(path, file, new, old)
            return
        if not file.keep:
            self.hashes[path] = manifest.content_hash(new)
            with_regions = self._with_regions(path, new, old)
            if with_regions is None:
                return
            new = with_regions
        has_mode = not file.executable or os.access(self.out / path, os.X_OK)
        if old == new and has_mode:
            self.unchanged.append(path)
            return
        if old is not None and old != new and not self.force:
            self._check_generated(path, old)
        self.contents[path] = new
        if file.executable:
            self.executable.add(path)

    def _check_fits(self, path: str, file: OutputFile, new: bytes, old: bytes) -> None:
        """Report code of the user that was written for what the model said before."""
        marks = outdated(old, new)
        if marks is not None:
            hint = f"adapt it, and then write `swarmc:fits {marks[1]}` for `{marks[0]}` in it"
            place = str(self.out / path)
            self.report.report("outdated-code", file.origin, path=place, help=hint)

    def _with_regions(self, path: str, new: bytes, old: bytes | None) -> bytes | None:
        """The new content with what the user has written in the regions of the old one.

        None where that is not possible, which is reported.
        """
        if old is None:
            return new
        try:
            of_user = regions.kept(old)
        except regions.RegionError as error:
            if self.force or self.before.get(path) == manifest.content_hash(old):
                return new
            self._report_overwrite(path, str(error), "put its marks back, or")
            return None
        filled, lost = regions.filled(new, of_user)
        if lost and not self.force:
            reason = f"region `{lost[0]}` has lines of yours, and is not part of it any more"
            self._report_overwrite(path, reason, "move them away, or")
            return None
        return filled

    def _check_generated(self, path: str, content: bytes) -> None:
        """Report a file that is not as swarmc wrote it."""
        generated = self.before.get(path)
        if generated != manifest.content_hash(content):
            reason = "it is not from swarmc" if generated is None else "it has been edited"
            self._report_overwrite(path, reason, "move it away, or")

    def _report_overwrite(self, path: str, reason: str, way: str) -> None:
        place = str(self.out / path)
        help_ = f"{way} overwrite it with `--force`"
        self.report.report("would-overwrite", path=place, reason=reason, help=help_)

    def add_stale(self, targets: Collection[str]) -> None:
        """Decide about what was generated before for these targets and is not any more."""
        new = {clash_key(path): path for path in (*self.hashes, *self.kept, *self.contents)}
        for path, old in self.before.items():
            if path.partition("/")[0] not in targets:
                self.hashes[path] = old
            elif path not in new.values():
                self._add_stale(path, old, new.get(clash_key(path)))
        for path, map_ in self.maps_before.items():
            if path.partition("/")[0] not in targets:
                self.maps[path] = map_

    def _add_stale(self, path: str, old: str, successor: str | None) -> None:
        place = self.out / path
        with suppress(OSError):
            if place.is_symlink() or not self._leads_inside(place):
                return
            if successor is not None and place.samefile(self.out / successor):
                return  # one file under two names, where case does not count
            content = _content(place)
            if content is not None:
                edited = manifest.content_hash(content) != old or _has_lines_of_user(content)
                (self.left if edited else self.stale).append(path)

    def _leads_inside(self, place: Path) -> bool:
        """Whether no symbolic link on the way leads out of the output folder."""
        if os.path.islink(place):  # noqa: PTH114 - no error for a name that the disk does not take
            return _leads_inside(place, self.out)
        folder = place.parent
        if folder not in self.inside:
            self.inside[folder] = _leads_inside(folder, self.out)
        return self.inside[folder]


def _carry_out(plan: _Plan) -> None:
    list_file = plan.out / manifest.NAME
    listed = manifest.to_bytes(plan.hashes, plan.maps)
    is_new = (plan.hashes, plan.maps) != (plan.before, plan.maps_before)
    with Staging() as staging:
        for path, content in plan.contents.items():
            staging.add(plan.out / path, content, path in plan.executable)
        if is_new or (plan.hashes and not list_file.exists()):
            staging.add(list_file, listed)
        done, maps = dict(plan.before), dict(plan.maps_before)
        try:
            for place in staging.move_in_place():
                path = place.relative_to(plan.out).as_posix()
                if path in plan.hashes:
                    done[path], maps[path] = plan.hashes[path], plan.maps[path]
            for path in plan.stale:
                _remove(plan.out / path, plan.out)
        except BaseException:
            if done != plan.before:
                _save_what_is_done(list_file, manifest.to_bytes(done, maps))
            raise


def _save_what_is_done(list_file: Path, done: bytes) -> None:
    """Keep the list true when only some files could be replaced, as far as that is possible."""
    with suppress(OSError), Staging() as staging:
        staging.add(list_file, done)
        for _ in staging.move_in_place():
            pass


def _remove(place: Path, out: Path) -> None:
    place.unlink(missing_ok=True)
    for folder in place.parents:
        if folder == out:
            return
        try:
            folder.rmdir()
        except OSError:
            return  # there is something else in it


def _leads_inside(place: Path, out: Path) -> bool:
    # Not Path.resolve: it raises an error for links that lead in a circle.
    real = Path(os.path.realpath(place))
    return real.is_relative_to(os.path.realpath(out))


def _content(place: Path) -> bytes | None:
    """The content of a file, None when there is none; OSError when it is something else."""
    try:
        mode = place.stat().st_mode
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(0, "it is a folder", str(place))
    if not stat.S_ISREG(mode):
        # Reading a pipe or a device could wait forever.
        raise OSError(0, "it is not an ordinary file", str(place))
    return place.read_bytes()


def _has_lines_of_user(content: bytes) -> bool:
    with suppress(regions.RegionError):
        return bool(regions.kept(content))
    return False


def _report_os_error(path: Path, error: OSError, report: Diagnostics) -> None:
    reason = error.strerror or str(error) or type(error).__name__
    report.report("cannot-write", path=str(path), reason=reason[0].lower() + reason[1:])
