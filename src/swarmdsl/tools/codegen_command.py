"""Generate ROS packages from SCXML and ADF files: `swarmc codegen`.

The command line is that of the CPSwarm code generator. The files are imported into an intermediate
model that the user never sees, and targets generate the packages.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics, Level
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.emit import Output, Request, emit
from swarmdsl.driver.pipeline import Result
from swarmdsl.importing import import_scxml
from swarmdsl.importing.files import package_of, read_sources
from swarmdsl.importing.names import type_names
from swarmdsl.importing.origins import Origins
from swarmdsl.importing.repair import read
from swarmdsl.importing.text import check_model, model_text
from swarmdsl.ir import Environment, Member, Multiplicity, Role, Swarm, System
from swarmdsl.lowering import lower
from swarmdsl.output import WriteOptions, write

PACKAGE = "fsm_behaviour"
"""Default package name, as in the CPSwarm code generator."""

_NO_LEVELS: Mapping[str, Level] = {}


def codegen(
    scxml: Path,
    described: Path | None,
    out: Path,
    package: str,
    levels: Mapping[str, Level] = _NO_LEVELS,
    *,
    language: str,
    simulation: bool,
    how: WriteOptions,
) -> Result:
    """Generate the packages of a state machine below `out`.

    `described` is its ADF file. States name the functions that need skeletons in `language` (D5.4,
    section 5.3). In a simulation, functions exist already, so no skeletons are generated.

    An existing package is updated as `how` specifies.
    """
    report = Diagnostics(levels)
    name = package_of(scxml)
    guesses: set[tuple[str, str]] = set()
    paths = [scxml] if described is None else [scxml, described]
    documents, adfs = read_sources(paths[:1], report), read_sources(paths[1:], report)
    files = len(paths)
    if report.has_errors:
        return Result(report, files)
    system = import_scxml(documents, adfs, name, report, None, guesses)
    text = model_text(_with_robot(system, simulation), scxml, report)
    project = check_model(text, Path(f"{name}.swarm"), report) if text is not None else None
    if project is None:
        return Result(report, files)
    options = {"package": package, **({"simulation": "true"} if simulation else {})}
    requests = [Request("smach", options)]
    skeletons = [] if simulation else _required_skeletons(documents[0], system, guesses, report)
    if skeletons:
        skeleton_options = {
            "language": language,
            "only": ",".join(skeletons),
            "interfaces": "false",
        }
        requests.append(Request("skeleton", skeleton_options))
    made = emit(lower(project), requests, report)
    origins = Origins(documents, adfs)
    packages = _by_package(
        {target: [origins.relocate(file) for file in files] for target, files in made.items()},
        report,
    )
    if report.has_errors:
        return Result(report, files)
    how = replace(how, model=name)
    return Result(report, files, written=write(packages, out, report, how))


def _required_skeletons(
    source: Source, system: System, guesses: set[tuple[str, str]], report: Diagnostics
) -> list[str]:
    """Functions that states name in `<data id="adf">` and that the ADF file describes."""
    # Errors of the file were reported by the import.
    document = read(source, Diagnostics())
    if document is None:
        return []
    known = {each.name: each for each in system.functions if (each.name, "category") not in guesses}
    wanted: dict[str, None] = {}
    for node in document.root.walk():
        if node.name != "data" or node.get("id") != "adf":
            continue
        name = next((each.text.strip() for each in node.children if each.name == "name"), "")
        reason = "no ADF file describes it"
        if name in known:
            type_ = known[name].communication.type
            # An interface in the package of the skeleton must be described.
            if type_.package != snake_case(name) or system.interface(type_) is not None:
                wanted.setdefault(name)
                continue
            reason = f"its interface `{type_}` is not described"
        what = f"the skeleton of `{name}`"
        report.report("left-out", document.at(node), what=what, reason=reason)
    return list(wanted)


def _with_robot(system: System, simulation: bool) -> System:
    """Add a robot with the machine as its behavior and, for a simulation, a world."""
    if not system.machines:
        return system
    names = type_names()
    names.taken |= {each.name for each in system.machines}
    names.taken |= {each.name for each in system.components}
    names.taken |= {each.name for each in system.events}
    robot = Member(names.new("Robot"), system.machines[0].name, (), (), (), ())
    if not simulation:
        return replace(system, members=(robot,))
    world = Environment(names.new("World"), "empty.world", None)
    role = Role("robot", robot.name, Multiplicity(1, 1))
    swarm = Swarm(names.new("Robots"), (role,), world.name)
    return replace(system, members=(robot,), environments=(world,), swarms=(swarm,))


def _by_package(made: Output, report: Diagnostics) -> Output:
    """Group files by package, because several targets may write to one."""
    packages: dict[str, dict[str, OutputFile]] = {}
    for files in made.values():
        for file in files:
            package, _, path = file.path.partition("/")
            known = packages.setdefault(package, {}).setdefault(path, replace(file, path=path))
            if known.text != file.text:
                report.report("output-collision", file.origin, path=file.path)
    return {package: list(files.values()) for package, files in packages.items()}
