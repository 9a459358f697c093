"""View of the package for the templates, with a module and a node for each machine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl.codegen import Diagnostics, Picture, Span, chosen_machines, dataclass, pictures
from swarmdsl.codegen.python import (
    Call,
    Source,
    comments,
    docstring,
    file_name,
    layout,
    one_line,
    source_place,
)
from swarmdsl.codegen.ros import (
    InterfacePackage,
    check_described,
    group_by_package,
    interfaces_to_write,
    is_fully_described,
    manifest,
    third_party_packages,
)
from swarmdsl.codegen.shared import (
    check_watchdogs,
    doc_with_unit,
    envelopes_of,
    missing_values,
    uses_self,
)
from swarmdsl.ir import (
    DURATION,
    Array,
    Event,
    Literal,
    Message,
    Named,
    Param,
    Primitive,
    StateMachine,
    System,
)

from ..gazebo.render import report_left_out
from . import names, package
from .expressions import USERDATA, default_value, python_expression
from .imports import Imports, RosTypes, ros_types
from .launch import world_file
from .module import TARGET, Container, Function, Module
from .names import NAMES
from .options import Options
from .readme import Rows, uses
from .robots import Components, Fleet, Robot, fleets, robots
from .statements import STEP
from .structure import build

TIME = Primitive("time")
# Python types of ROS parameters by type in the model; all others are `int`.
_KINDS = {
    "bool": "bool",
    **dict.fromkeys(("float32", "float64", "duration", "time"), "float"),
    **dict.fromkeys(("string", "wstring"), "str"),
}


@dataclass(frozen=True)
class Value:
    """The statement that initializes a key of userdata."""

    statement: str
    comments: tuple[str, ...]


@dataclass(frozen=True)
class MachineView:
    """The module of a machine and its node."""

    name: str
    module: str
    doc: str
    place: str
    uses: tuple[tuple[str, Rows], ...]
    header: str
    imports: tuple[str, ...]
    containers: tuple[Container, ...]
    functions: tuple[Function, ...]
    values: tuple[Value, ...]
    sent: tuple[str, ...]
    start: str
    required_callbacks: str
    origin: Span | None


@dataclass(frozen=True)
class EventView:
    """An event as a constant of the module `events`."""

    statement: str
    comments: tuple[str, ...]


@dataclass(frozen=True)
class PackageView:
    """The whole package."""

    name: str
    doc: str
    header: str
    machines: tuple[MachineView, ...]
    events: tuple[EventView, ...]
    event_imports: tuple[str, ...]
    callbacks: tuple[tuple[str, str], ...]
    interfaces: tuple[InterfacePackage, ...]
    manifest: str
    pictures: tuple[Picture, ...]
    missing_values: str
    modules: tuple[str, ...]
    needs: tuple[str, ...]
    described: tuple[str, ...]
    timeouts: dict[str, int]
    robots: tuple[Robot, ...]
    fleets: tuple[Fleet, ...]
    simulation: bool

    @property
    def components(self) -> Components | None:
        """The package that starts the components of robots; None if they need no nodes."""
        found = (robot.components for robot in self.robots)
        return next((each for each in found if each is not None), None)

    @property
    def simulations(self) -> list[str]:
        """The launch files that simulate a swarm."""
        worlds = [fleet for fleet in self.fleets if self.simulation and world_file(fleet)]
        return [f"{fleet.name}_simulation" for fleet in worlds]

    @property
    def folders(self) -> list[str]:
        """The folders that are installed."""
        return ["launch", "param", *(["world"] if self.simulations else [])]

    @property
    def kept(self) -> list[tuple[str, str]]:
        """The user's files, and their purposes."""
        found = []
        if self.callbacks:
            found.append((f"src/{self.name}/callbacks.py", "callbacks that the model names"))
        for fleet in self.fleets:
            about = f"params of single robots of swarm `{fleet.swarm.name}`"
            found.append((f"param/{fleet.name}/*.yaml", about))
            if self.simulation and (world := world_file(fleet)):
                found.append((f"world/{world}", "the world that Gazebo simulates"))
        return found


def package_view(system: System, options: Options, report: Diagnostics) -> PackageView | None:
    """Return the view of a system, or None if no machine needs a node."""
    machines = chosen_machines(system)
    if not machines:
        return None
    name = NAMES.package(system, options.package, report)
    modules = NAMES.of_modules(machines, report)
    around = envelopes_of(system)
    written = [*interfaces_to_write(system, options.interfaces), *around.values()]
    interfaces = group_by_package(written, 1)
    check_described(system, options.interfaces, NAMES.target, report)
    check_watchdogs(
        system,
        frozenset(),
        NAMES.target,
        report,
        "nodes of ROS 1 have no watchdog",
        "build it for ROS 2, or let another program watch the node",
    )
    NAMES.check_interfaces(system, interfaces, name, report)
    used = package.used_types(system, machines)
    events = _events(system, machines, report)
    constants = names.event_constants(events, (type_.name for type_, _ in used), report)
    if report.has_errors:
        return None
    types = ros_types(name, constants.values(), used)
    callbacks: dict[str, str] = {}
    views = [
        _machine_view(system, machine, modules[machine.name], types, constants, callbacks, report)
        for machine in machines
    ]
    doc = system.doc or f"Behaviour of {system.name}."
    event_imports = Imports(types)
    event_views = _event_views(events, around, constants, event_imports)
    launched = {machine.name for machine in machines}
    made = robots(system, launched, options.components, report)
    bringup = {each.components.package for each in made if each.components is not None}
    depends = [
        ("buildtool_depend", "catkin"),
        ("buildtool_depend", "python3-setuptools"),
        *(("exec_depend", needed) for needed in package.dependencies(used)),
        *([("exec_depend", "roslaunch"), ("test_depend", "rostest")] if made else []),
        *([("exec_depend", "gazebo_ros")] if made and options.simulation else []),
        *(("exec_depend", each) for each in bringup if options.components),
    ]
    started = tuple(fleets(system, made, report))
    for fleet in started if options.simulation else ():
        if fleet.environment is not None and (file := world_file(fleet)):
            names.check_world(fleet.environment, file, report)
            report_left_out(fleet.environment, TARGET, report)
    if report.has_errors:
        return None
    needs = third_party_packages((type_ for type_, _ in used), interfaces, system)
    return PackageView(
        name=name,
        doc=doc,
        header=_header(system, (machine.origin for machine in machines)),
        machines=tuple(views),
        events=event_views,
        event_imports=tuple(event_imports.lines()),
        callbacks=tuple(callbacks.items()),
        interfaces=interfaces,
        manifest=manifest(name, doc, depends, options, format_=2),
        pictures=pictures(system, machines),
        missing_values=missing_values(system),
        modules=(
            "chart",
            "containers",
            "identity",
            "node",
            "states",
            "topics",
            *package.activity_modules(used),
        ),
        needs=tuple(needs),
        described=tuple(each for each in needs if is_fully_described(system, each)),
        timeouts=options.timeouts,
        robots=tuple(made),
        fleets=started,
        simulation=options.simulation,
    )


def _header(system: System, origins: Iterable[Span | None]) -> str:
    """Return the header of a file that each build overwrites."""
    files = dict.fromkeys(file_name(origin) for origin in origins if origin is not None)
    return f"Generated by swarmc from {', '.join(files) or system.name}; do not edit."


def _machine_view(
    system: System,
    machine: StateMachine,
    name: str,
    types: RosTypes,
    events: dict[str, str],
    callbacks: dict[str, str],
    report: Diagnostics,
) -> MachineView:
    names.check_machine(machine, report)
    imports = Imports(types)
    imports.module("smach")
    module = Module(system, machine, imports, report, events)
    build(module)
    for callback, parameters, origin in module.callbacks:
        NAMES.check_callback(callback, parameters, callbacks, origin, report)
    values = _values(module)
    required = dict.fromkeys(f"{name}({parameters})" for name, parameters, _ in module.callbacks)
    require = module.own("states", "require") if required else ""
    call = Call(require, (Source("callbacks"), [*required]))
    return MachineView(
        name=machine.name,
        module=name,
        doc=docstring(machine.doc or f"State machine {machine.name}."),
        place=source_place(machine.origin),
        uses=uses(system, machine),
        header=_header(system, [machine.origin]),
        imports=tuple(imports.lines()),
        containers=tuple(module.containers),
        functions=tuple(module.functions),
        values=values,
        sent=tuple(module.event(event) for event in module.sent),
        start=layout(_start(name, machine), 1, STEP),
        required_callbacks=layout(call, 1, STEP) if required else "",
        origin=machine.origin,
    )


def _start(module: str, machine: StateMachine) -> Call:
    """Return the call that runs the machine of a module."""
    required = tuple(f"~{param.name}" for param in machine.params if param.default is None)
    arguments = (module, Source(module), *([required] if required else []))
    return Call("node.run", arguments)


def _values(module: Module) -> tuple[Value, ...]:
    """Return the initial values of params, from ROS, and of variables."""
    found = []
    if uses_self(module.machine):
        text = f"{STEP}{USERDATA}.self = {module.own('identity', 'identity')}()"
        found.append(Value(text, ("The robot: its id, role, index and count.",)))
    for param in module.machine.params:
        value = _param_value(param, module)
        statement = layout(value, 1, f"{STEP}{USERDATA}.{param.name} = ")
        doc = doc_with_unit(param.doc, param.type)
        found.append(Value(statement, comments(param.origin, doc)))
    for variable in module.machine.variables:
        text = (
            python_expression(variable.initial, module.imports)
            if variable.initial is not None
            else default_value(variable.type, module.imports)
        )
        statement = f"{STEP}{USERDATA}.{variable.name} = {text}"
        found.append(
            Value(statement, comments(variable.origin, doc_with_unit(variable.doc, variable.type)))
        )
    return tuple(found)


def _param_value(param: Param, module: Module) -> object:
    """Return the expression of a param's value at the start of a node."""
    is_array = isinstance(param.type, Array)
    element = param.type.element if isinstance(param.type, Array) else param.type
    default = param.default
    kind = Source(_KINDS.get(element.name, "int") if isinstance(element, Primitive) else "dict")
    arguments: tuple[object, ...] = (f"~{param.name}", [kind] if is_array else kind)
    if default is not None and param.type == DURATION:
        seconds = f"({python_expression(default, module.imports)}).to_sec()"
        literal = default.milliseconds / 1000 if isinstance(default, Literal) else None
        arguments += (Source(seconds) if literal is None else literal,)
    elif default is not None:
        arguments += (Source(python_expression(default, module.imports)),)
    given = Call(module.own("states", "param"), arguments)
    if isinstance(element, Named):
        made = module.own("states", "message")
        first = [Source(module.imports.interface(element, "msg"))]
    elif element in (DURATION, TIME):
        module.imports.module("rospy")
        made, first = f"rospy.{str(element).capitalize()}", []
    else:
        return given
    if not is_array:
        return Call(made, (*first, given))
    each = one_line(Call(made, (*first, Source("each"))))
    return Source(f"[{each} for each in {one_line(given)}]")


def _events(system: System, machines: list[StateMachine], report: Diagnostics) -> list[Event]:
    """Return the events that the machines use."""
    events = [system.event(name) for name in package.used_events(machines)]
    for event in events:
        if not isinstance(event.type, Named):
            report.report(
                "unsupported-construct",
                event.origin,
                target=TARGET,
                construct=f"an event with data of type `{event.type}`, which is not a message",
            )
        _check_delivery(event, report)
    return events


def _check_delivery(event: Event, report: Diagnostics) -> None:
    """Report the settings that topics of ROS 1 do not have."""
    for setting in ("lifespan", "deadline"):
        if event.delivery is not None and getattr(event.delivery, setting) is not None:
            report.report(
                "unsupported-construct",
                event.delivery.origin,
                target=TARGET,
                construct=f"the {setting} of event `{event.name}`",
                help="leave it out, or build for ROS 2: `--option smach.ros=2`",
            )


def _event_views(
    events: Iterable[Event],
    around: Mapping[str, Message],
    constants: dict[str, str],
    imports: Imports,
) -> tuple[EventView, ...]:
    found = []
    for event in events:
        assert isinstance(event.type, Named)
        message = Source(imports.interface(event.type, "msg"))
        keywords: list[tuple[str, object]] = []
        if event.name in around:
            interface = imports.interface(around[event.name].type, "msg")
            keywords.append(("envelope", Source(interface)))
        if event.delivery is not None and event.delivery.latest:
            keywords.append(("latch", True))
        if event.delivery is not None and event.delivery.keep is not None:
            keywords.append(("queue_size", event.delivery.keep))
        call = Call(
            imports.name(f"{imports.types.package}.topics", "Event"),
            (event.name, message, event.incoming_topic, event.topic),
            tuple(keywords),
        )
        statement = layout(call, 0, f"{constants[event.name]} = ")
        found.append(EventView(statement, comments(event.origin, event.doc)))
    return tuple(found)
