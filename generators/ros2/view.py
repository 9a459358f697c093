"""View of the package for the templates, with a module and a node for each machine."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import Diagnostics, Picture, Span, chosen_machines, dataclass, pictures
from swarmdsl.codegen.python import Call, Source, comment_lines, comments, file_name, layout
from swarmdsl.codegen.ros import (
    InterfacePackage,
    check_described,
    group_by_package,
    interfaces_to_write,
    manifest,
)
from swarmdsl.codegen.shared import (
    check_watchdogs,
    envelopes_of,
    follows_members,
    missing_values,
    model_digest,
    uses_self,
)
from swarmdsl.ir import StateMachine, System

from . import names, package
from .actions import check_feedback, messages_of_actions
from .expressions import default_value, python_expression, stored
from .imports import WIDTH, Imports
from .launch import Launch, launches
from .machine import Row, Table
from .module import BOTH, STEP, Function, Module
from .monitor_source import Entry
from .monitors import WatchedSwarm, watched_swarms
from .names import NAMES
from .networks import Network, networks
from .options import Options
from .params import parameters
from .ported import ported
from .readme import Rows, tables
from .served import INTERFACES, ServedNode, served_nodes, served_packages
from .told_conditions import conditions, heard_or_sent
from .topics import topics


@dataclass(frozen=True)
class MachineView:
    """The module of a machine."""

    name: str
    module: str
    doc: tuple[str, ...]
    imports: tuple[str, ...]
    parameters: tuple[Entry, ...]
    topics: tuple[Entry, ...]
    functions: tuple[Entry, ...]
    conditions: tuple[Entry, ...]
    values: tuple[Entry, ...]
    steps: tuple[Function, ...]
    rows: tuple[Row, ...]
    initial: str
    callbacks: tuple[str, ...]
    follows_members: bool
    tables: tuple[tuple[str, str, Rows], ...]
    header: str
    origin: Span | None


@dataclass(frozen=True)
class Variant:
    """Differences in the package of a target that extends target `ros2`.

    `host` is the module with the `Host` of the node. The executable of a machine is in the module
    of the machine with the `suffix`. With `is_composed` one process can have the nodes of many
    robots. `depends` are further dependencies with their tags, `folders`
    further installed folders with a pattern of their files.
    """

    host: str = "host"
    suffix: str = ""
    is_composed: bool = False
    depends: tuple[tuple[str, str], ...] = ()
    folders: tuple[tuple[str, str], ...] = ()


PLAIN = Variant()


@dataclass(frozen=True)
class PackageView:
    """The whole package; `system` is the name of its model, and `digest` the meaning of that."""

    name: str
    system: str
    digest: str
    doc: str
    header: str
    machines: tuple[MachineView, ...]
    callbacks: tuple[tuple[str, str], ...]
    launches: tuple[Launch, ...]
    served: tuple[ServedNode, ...]
    monitors: tuple[WatchedSwarm, ...]
    networks: tuple[Network, ...]
    interfaces: tuple[InterfacePackage, ...]
    manifest: str
    pictures: tuple[Picture, ...]
    missing_values: str
    variant: Variant

    @property
    def shares_roles(self) -> bool:
        """True if a robot of several swarms may have the same name."""
        names = [role.name for launch in self.launches for role in launch.roles]
        return len(names) > len(set(names))

    @property
    def has_watchdogs(self) -> bool:
        """True if the death of a node has consequences."""
        roles = (role for launch in self.launches for role in launch.roles)
        return any(node.watchdog is not None for role in roles for node in role.nodes)


def package_view(
    system: System, options: Options, report: Diagnostics, variant: Variant = PLAIN
) -> PackageView | None:
    """Return the view of a system, or None if no machine needs a node."""
    machines = chosen_machines(system)
    if not machines:
        return None
    name = NAMES.package(system, options.package, report)
    modules = NAMES.of_modules(machines, report)
    described = f"{options.interfaces},{INTERFACES}"
    written = [*interfaces_to_write(system, described), *envelopes_of(system).values()]
    interfaces = group_by_package(map(ported, written), 2)
    check_described(system, described, NAMES.target, report)
    NAMES.check_interfaces(system, interfaces, name, report)
    of_actions = messages_of_actions(system)
    callbacks: dict[str, str] = {}
    for machine in machines:
        names.check_machine(machine, report)
    if report.has_errors:
        return None
    views = tuple(
        _machine_view(
            system,
            machine,
            modules[machine.name],
            Imports(of_actions),
            callbacks,
            variant,
            options.monitors,
            report,
        )
        for machine in machines
    )
    doc = system.doc or f"Behaviour of {system.name}."
    launched = launches(system, modules, report)
    check_watchdogs(
        system,
        {
            role.member
            for launch in launched
            for role in launch.roles
            if any(node.watchdog is not None for node in role.nodes)
        },
        NAMES.target,
        report,
        "a watchdog is started beside the behaviour of a robot in a swarm",
        "give the member a behaviour and a role in a swarm, or remove the contract",
    )
    needs = {*package.dependencies(system, machines), *served_packages(system)}
    depends = [("depend", needed) for needed in sorted(needs)]
    if launched:
        tools = ("ament_index_python", "launch", "launch_ros")
        depends += [("exec_depend", needed) for needed in tools]
    depends += variant.depends
    linters = ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest")
    depends += [("test_depend", needed) for needed in linters]
    return PackageView(
        name=name,
        system=system.name,
        digest=model_digest(system),
        doc=doc,
        header=header(system, machines),
        machines=views,
        callbacks=tuple(callbacks.items()),
        launches=tuple(launched),
        served=served_nodes(system, report),
        monitors=watched_swarms(system, launched, modules, report) if options.monitors else (),
        networks=tuple(networks(system, launched, options, report)),
        interfaces=interfaces,
        manifest=manifest(name, doc, depends, options, format_=3, build_type="ament_python"),
        pictures=pictures(system, machines),
        missing_values=missing_values(system),
        variant=variant,
    )


def header(system: System, machines: Iterable[StateMachine]) -> str:
    """Return the header of a file that each build overwrites, which fits into a line."""
    origins = (machine.origin for machine in machines)
    files = dict.fromkeys(file_name(origin) for origin in origins if origin is not None)
    head = "Generated by swarmc from {}; do not edit.".format
    named = head(", ".join(files) or system.name)
    return named if len(f"# {named}") <= WIDTH else head(system.name)


def _machine_view(
    system: System,
    machine: StateMachine,
    module: str,
    imports: Imports,
    callbacks: dict[str, str],
    variant: Variant,
    monitors: bool,
    report: Diagnostics,
) -> MachineView:
    for own in ("Behavior", "tree"):
        imports.own("host", own)
    imports.own("engine", "Machine")
    if not variant.suffix:
        imports.own("node", "run")
    made = Module(machine, system, imports)
    table = Table(machine, made)
    for callback, signature, origin in made.callbacks:
        NAMES.check_callback(callback, signature, callbacks, origin, report)
    declared = parameters(machine, imports, report)
    if declared:
        imports.own("parameters", "Parameter")
    heard = topics(machine, system, imports, report)
    check_feedback(machine, imports.messages_of_actions, report)
    if heard:
        imports.own("topics", "Topic")
        if any(event.delivery is not None for event, _ in heard):
            imports.own("topics", "Delivery")
    functions = _functions(machine, system, imports, report)
    told = _conditions(machine, system, made) if monitors else ()
    values = _values(machine, imports)
    return MachineView(
        name=machine.name,
        module=module,
        doc=tuple(comment_lines(machine.doc)),
        imports=tuple(imports.lines()),
        parameters=tuple(_item(call, param.origin, "") for param, call in declared),
        topics=tuple(_item(call, event.origin, event.doc) for event, call in heard),
        functions=functions,
        conditions=told,
        values=values,
        steps=tuple(made.functions),
        rows=tuple(table.rows),
        initial=machine.initial,
        callbacks=tuple(dict.fromkeys(name for name, _, _ in made.callbacks)),
        follows_members=follows_members(machine),
        tables=tables(machine, system),
        header=header(system, [machine]),
        origin=machine.origin,
    )


def _item(call: Call, origin: Span | None, doc: str) -> Entry:
    return Entry(comments(origin, doc), layout(call, 1, STEP, ",", WIDTH))


def _functions(
    machine: StateMachine, system: System, imports: Imports, report: Diagnostics
) -> tuple[Entry, ...]:
    """Return the entries of the functions that a machine calls."""
    found = []
    for name in package.called_functions(machine):
        function = system.function(name)
        call = function.communication
        names.check_topic(call.name, function.origin, report)
        kind = "action" if call.paradigm == "action" else "srv"
        class_ = imports.own("functions", call.paradigm.capitalize())
        made = Call(class_, (Source(imports.interface(call.type, kind)), call.name))
        text = layout(made, 1, f"{STEP}{name!r}: ", ",", WIDTH)
        found.append(Entry(comments(function.origin, function.doc), text))
    return tuple(found)


def _conditions(machine: StateMachine, system: System, made: Module) -> tuple[Entry, ...]:
    """Return the entries of the conditions that the trace of a machine tells."""
    found = []
    for text, fact in conditions(machine, system).items():
        assert fact.guard is not None
        lines = [f"{STEP}return {python_expression(fact.guard, made.imports)}"]
        origin = fact.guard.origin
        told: Source | Call = made.function("holds", machine.name, BOTH, lines, origin)
        if fact.act != "has":
            class_ = made.imports.own("tracing", "OfMessage")
            told = Call(class_, (heard_or_sent(fact), fact.name, told))
        found.append(Entry((), layout(told, 1, f"{STEP}{text!r}: ", ",", WIDTH)))
    return tuple(found)


def _values(machine: StateMachine, imports: Imports) -> tuple[Entry, ...]:
    """Return the initial values of params, from ROS, and of variables."""
    found = []
    if uses_self(machine):
        found.append(
            Entry(("The robot: its id, role, index and count.",), "self.self = parameters['self']")
        )
    for param in machine.params:
        text = f"self.{param.name} = parameters[{param.name!r}]"
        found.append(Entry(comments(param.origin, param.doc), text))
    for variable in machine.variables:
        value = (
            stored(variable.initial, variable.type, imports, "self")
            if variable.initial is not None
            else default_value(variable.type, imports)
        )
        text = f"self.{variable.name} = {value}"
        found.append(Entry(comments(variable.origin, variable.doc), text))
    return tuple(found)
