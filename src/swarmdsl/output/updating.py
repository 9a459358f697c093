"""Plan the update of generated files: replace, keep or merge the existing file.

A file is pristine if its content was generated, now or before, and its user regions are empty. A
pristine file follows the model. Any other has been edited: a file to fill in is kept, others are
merged with the new content.
"""

from __future__ import annotations

from swarmdsl.base.records import replace
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import mark_of, outdated
from swarmdsl.output import line_ends, user_regions, warnings
from swarmdsl.output.changes import PARKED, Action
from swarmdsl.output.manifest import content_hash
from swarmdsl.output.names import Names
from swarmdsl.output.plan import Found, Plan
from swarmdsl.output.renames import renamed
from swarmdsl.output.warnings import NEW, NOTE


def update(plan: Plan, path: str, file: OutputFile) -> None:
    """Plan the change of a file; obstacles are reported or raised as OSError."""
    if not plan.is_inside(path):
        return
    try:
        new = file.text.encode()
        found = _found(plan, path)
    except UnicodeEncodeError:
        reason = "it has characters that are not Unicode"
        place, help_ = str(plan.disk.out / path), "fix the generator: it must write valid Unicode"
        plan.report.report("cannot-write", path=place, reason=reason, help=help_)
    except NotADirectoryError:
        reason = "it is a file where a folder is needed"
        obstacle = str(plan.disk.obstacle(path))
        help_ = "move it away, or build into another folder with `-o`"
        plan.report.report("cannot-write", path=obstacle, reason=reason, help=help_)
    else:
        plan.hashes[path] = plan.texts.add(file.text)
        plan.maps[path] = plan.positions.file_map(file)
        if file.facts:
            plan.texts.add_facts(file.facts)
        if file.owner and file.keep:
            plan.owners[path] = f"{file.owner} {mark_of(file.facts)}"
        if found is None:
            plan.change(Action.CREATE, path, None, new, file)
            return
        new = line_ends.like(found.content, new)
        if file.keep:
            _keep(plan, path, file, new, found)
        else:
            _update(plan, path, file, new, found)


def _keep(plan: Plan, path: str, file: OutputFile, new: bytes, found: Found) -> None:
    """Keep a file to fill in, once the user has edited it."""
    if plan.is_pristine(path, found.content, found.base):
        _replace_pristine(plan, path, file, found, new)
        return
    found = renamed(plan, path, file, new, found)
    base = plan.texts.get(found.base)
    marks = outdated(found.content, new, base)
    if marks is not None and (marks[0] or found.base not in (None, plan.hashes[path])):
        # Its code still builds on the old content.
        plan.hashes[path] = found.base or plan.hashes[path]
        facts = plan.texts.facts(marks[0]) if marks[0] else None
        note = warnings.changed_below(path, file, found.content, marks, base, facts)
        place = plan.disk.out / path
        plan.add_beside(f"{path}{NOTE}", note)
        warnings.report_outdated(place, file, found.content, marks, facts, plan.remarks)
    if found.source is None:
        plan.kept.append(path)
    else:
        plan.bring(path, found, found.content)


def _update(plan: Plan, path: str, file: OutputFile, new: bytes, found: Found) -> None:
    """Update a file that swarmc owns, with the edits of the user."""
    pristine = plan.is_generated(found.content, found.base)
    if pristine:
        found = replace(found, base=content_hash(found.content))
    found = renamed(plan, path, file, new, found)
    of_user = user_regions.kept(found.content)
    filled, lost = user_regions.filled(new, of_user)
    if found.content == filled or (pristine and not lost):
        _replace_pristine(plan, path, file, found, filled)
        return
    is_foreign = found.base is None and found.source is None
    is_damaged = not is_foreign and (bool(lost) or user_regions.fault(found.content) is not None)
    if plan.options.force and not is_damaged:
        plan.change(Action.OVERWRITE, path, found.content, filled, file, found.source)
    elif is_foreign:
        _report_foreign(plan, path)
    else:
        _merge(plan, path, file, filled, found, of_user)


def _report_marks(plan: Plan, path: str, content: bytes, new: bytes) -> bool:
    """Report invalid region marks; return True if there are any."""
    place, known = plan.disk.out / path, user_regions.ids(new)
    strange = [(id_, line) for id_, line in user_regions.ids(content).items() if id_ not in known]
    for id_, line in strange:
        fault, hint = f"no region `{id_}` is generated", suggest(id_, known, "regions")
        warnings.report_damaged(place, content, line, fault, hint, plan.remarks)
    wrong = user_regions.fault(content)
    if wrong is not None:
        warnings.report_damaged(place, content, wrong.line, wrong.fault, None, plan.remarks)
    return bool(strange) or wrong is not None


def _merge(
    plan: Plan,
    path: str,
    file: OutputFile,
    filled: bytes,
    found: Found,
    of_user: user_regions.Texts,
) -> None:
    # Imported here because it is slow and most builds merge nothing.
    from swarmdsl.output.merge import merge

    base_hash, neighbour = found.base, f"{path}{NEW}"
    offered = plan.before.files.get(neighbour)
    if offered is not None and plan.disk.content(neighbour) is None:
        # It was deleted: the user has finished the merge.
        base_hash = offered
    base = plan.texts.get(base_hash)
    if base is None and base_hash == plan.hashes[path]:
        base = file.text.encode()
    if base is not None:
        base = line_ends.like(found.content, base)
        base = _base_as_edited(base, found, filled, of_user)
    place = plan.disk.out / path
    has_invalid_marks = _report_marks(plan, path, found.content, filled)
    merged = merge(base, found.content, filled) if base is not None else None
    if base is None or merged is None or merged.text is None:
        # Without a known base, the whole file counts as edited: its base is empty.
        plan.hashes[path] = base_hash or plan.texts.add("")
        plan.add_beside(neighbour, filled)
        warnings.report_conflict(place, found.content, merged, plan.remarks)
        if found.source is None:
            plan.conflicts.append(path)
        else:
            plan.bring(path, found, found.content)
        return
    if not has_invalid_marks:
        warnings.report_edited(place, found.content, base, merged.taken, plan.remarks)
    if found.source is not None:
        plan.bring(path, found, merged.text)
    elif merged.text == found.content:
        plan.edited.append(path)
    else:
        plan.change(Action.MERGE, path, found.content, merged.text, file)


def _base_as_edited(base: bytes, found: Found, filled: bytes, of_user: user_regions.Texts) -> bytes:
    """Return the base with the remaining user regions and under the new name."""
    if found.names is not None:
        text, _ = found.names.rewritten(base.decode(), filled.decode(errors="surrogateescape"))
        base = text.encode(errors="surrogateescape")
    staying = user_regions.ids(filled)
    base, _ = user_regions.filled(
        base, {id_: text for id_, text in of_user.items() if id_ in staying}
    )
    return base


def _replace_pristine(plan: Plan, path: str, file: OutputFile, found: Found, new: bytes) -> None:
    """Replace a file that has no edits besides those in `new`."""
    if found.source is not None:
        plan.bring(path, found, new)
        return
    has_mode = not file.executable or plan.disk.is_executable(path)
    if line_ends.plain(found.content) == line_ends.plain(new) and has_mode:
        plan.unchanged.append(path)
    else:
        plan.change(Action.CHANGE, path, found.content, new, file)


def _found(plan: Plan, path: str) -> Found | None:
    content = plan.disk.content(path)
    base = plan.before.files.get(path)
    if path in plan.moved:
        source, names = plan.moved[path]
        if content is None or plan.is_pristine(path, content, base):
            return _found_elsewhere(plan, source, names)
        reason = f"`{plan.disk.out / path}` already has edits of yours"
        help_ = f"move them away, or merge those of `{plan.disk.out / source}` there by hand"
        plan.report.report("bad-rename", old=names.old, new=names.new, fault=reason, help=help_)
        return None
    if content is not None:
        return Found(content, base)
    aside = f"{PARKED}/{path}"
    content = plan.disk.content(aside) if plan.parks and plan.leads_inside(aside) else None
    if content is None:
        return None
    return Found(content, plan.parked.pop(path, None), aside)


def _found_elsewhere(plan: Plan, source: str, names: Names) -> Found | None:
    content = plan.disk.content(source)
    if content is None:
        return None
    path = source.removeprefix(f"{PARKED}/")
    base = plan.before.parked.get(path) if path != source else plan.before.files.get(path)
    return Found(content, base, source, names)


def _report_foreign(plan: Plan, path: str) -> None:
    reason = "swarmc did not generate it"
    help_ = "move it away, or overwrite it with `--force`"
    place = str(plan.disk.out / path)
    plan.report.report("would-overwrite", path=place, reason=reason, help=help_)
