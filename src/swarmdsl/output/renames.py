"""Move the files of renamed model elements, and replace the names in them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress

from swarmdsl.base.records import replace
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import mark_in, mark_of, marked
from swarmdsl.output import warnings
from swarmdsl.output.changes import PARKED, Action
from swarmdsl.output.names import Names
from swarmdsl.output.plan import Found, Plan


def find_moved_files(plan: Plan, made: Mapping[str, OutputFile]) -> None:
    """Find the edited files of renamed elements."""
    for old, new in plan.options.renames:
        names = Names(old, new)
        found = 0
        for path, base in (*plan.before.files.items(), *plan.before.parked.items()):
            moved = names(path)
            if moved == path or moved not in made or path in made or moved in plan.moved:
                continue
            found += 1
            source = path if path in plan.before.files else f"{PARKED}/{path}"
            with suppress(OSError):
                content = plan.disk.content(source) if plan.leads_inside(source) else None
                if content is not None and not plan.is_pristine(path, content, base):
                    plan.moved[moved] = (source, names)
                    if source != path:
                        plan.parked.pop(path, None)
        if not found:
            warnings.report_bad_rename(names, made, plan.report)


def move_unlisted_files(
    plan: Plan, targets: Collection[str], made: Mapping[str, OutputFile]
) -> None:
    """Move the user's own files in a renamed folder to its new name."""
    known = (*plan.before.files, *plan.before.parked)
    tops = {"/".join(path.split("/")[:2]) for path in known}
    there: set[str] = set()
    for old, new in plan.options.renames:
        names = Names(old, new)
        for top in sorted(top for top in tops if names(top) != top):
            taken = any(path.startswith(f"{top}/") for path in made)
            if taken or top.partition("/")[0] not in targets:
                continue
            for path in plan.disk.files(top):
                moved = names(path)
                free = moved not in made and moved not in there and not plan.is_there(moved)
                if path not in plan.before.files and free and plan.leads_inside(path):
                    there.add(moved)
                    content = plan.disk.content(path)
                    if content is not None:
                        plan.bring(moved, Found(content, None, path, names), content)


def report_possible_renames(plan: Plan, made: Mapping[str, OutputFile]) -> None:
    """Report new elements that look like removed ones under another name."""
    aside: dict[tuple[str, str], list[str]] = {}
    for path in plan.parked:
        if path in plan.owners and path not in made:
            old, _, mark = plan.owners[path].rpartition(" ")
            aside.setdefault((old, mark), []).append(path)
    created = {change.path for change in plan.changes if change.action is Action.CREATE}
    fresh = {path: file for path, file in made.items() if file.owner and path in created}
    for (old, mark), paths in aside.items():
        owners = {file.owner for file in fresh.values()} - {old}
        facts = plan.texts.facts(mark) or []
        like = [new for new in owners if _is_like(Names(old, new), paths, facts, fresh)]
        if len(like) == 1:
            place = next(file.origin for file in fresh.values() if file.owner == like[0])
            warnings.report_renamed(old, like[0], place, plan.options.command, plan.remarks)


def renamed(plan: Plan, path: str, file: OutputFile, new: bytes, found: Found) -> Found:
    """Replace the old name in a file as far as that is unambiguous."""
    if found.names is None:
        return found
    text = found.content.decode(errors="surrogateescape")
    text, left = found.names.rewritten(text, new.decode())
    content = text.encode(errors="surrogateescape")
    mark = mark_in(content)
    facts = plan.texts.facts(mark) if mark is not None and file.facts else None
    if facts is not None and found.names.same(facts, file.facts):
        content = marked(content, mark_of(file.facts))
    warnings.report_old_name(plan.disk.out / path, content, left, found.names, plan.remarks)
    return replace(found, content=content)


def _is_like(
    names: Names, paths: Iterable[str], facts: Sequence[str], fresh: Mapping[str, OutputFile]
) -> bool:
    """Return True if the files match those of another element, except for its name."""
    files = [fresh.get(names(path)) for path in paths]
    return all(file is not None and names.same(facts, file.facts) for file in files)
