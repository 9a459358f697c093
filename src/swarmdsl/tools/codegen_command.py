"""`swarmc codegen`: from SCXML and ADF to ROS packages, as the code generator of CPSwarm is called.

A model is made of the two on the way, which nobody sees; targets make the packages of it.
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
"""What the package is called where nobody says otherwise, as it is there."""

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
    """Make the packages of a state machine below `out`; `described` is an ADF file.

    States name functions of that whose skeletons they want (D5.4, section 5.3), in `language`.
    In a simulation, functions are not written anew, so that there are none.

    A package that is there already is brought up to date, as `how` says.
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
    wanted = [] if simulation else _wanted(documents[0], system, guesses, report)
    if wanted:
        of_skeletons = {"language": language, "only": ",".join(wanted), "interfaces": "false"}
        requests.append(Request("skeleton", of_skeletons))
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


def _wanted(
    source: Source, system: System, guesses: set[tuple[str, str]], report: Diagnostics
) -> list[str]:
    """The functions that states name in `<data id="adf">`, as far as an ADF file has them."""
    # What is wrong with the file has been told when it was imported.
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
            # The package of the skeleton is where its interface must be described.
            if type_.package != snake_case(name) or system.interface(type_) is not None:
                wanted.setdefault(name)
                continue
            reason = f"nothing says what is in its `{type_}`"
        what = f"the skeleton of `{name}`"
        report.report("left-out", document.at(node), what=what, reason=reason)
    return list(wanted)


def _with_robot(system: System, simulation: bool) -> System:
    """The system with a robot that behaves so, and a world for it where it is simulated."""
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
    """The files by the package that they are in, where several targets may write."""
    packages: dict[str, dict[str, OutputFile]] = {}
    for files in made.values():
        for file in files:
            package, _, path = file.path.partition("/")
            known = packages.setdefault(package, {}).setdefault(path, replace(file, path=path))
            if known.text != file.text:
                report.report("output-collision", file.origin, path=file.path)
    return {package: list(files.values()) for package, files in packages.items()}
