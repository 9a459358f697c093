"""Strategy for valid systems with names that a careless printer confuses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hypothesis import strategies as st

from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.ir import (
    Action,
    Communication,
    CommunicationSettings,
    Component,
    Connector,
    Constant,
    CountRange,
    Environment,
    Event,
    Expression,
    Field,
    Fitness,
    FitnessInput,
    Function,
    FunctionPort,
    Interface,
    Literal,
    Member,
    Message,
    Multiplicity,
    Named,
    Optimization,
    Param,
    ParamRange,
    ParamRef,
    Part,
    Port,
    PortRef,
    RobotValues,
    Role,
    Service,
    StateMachine,
    Swarm,
    System,
    VariableRef,
)
from swarmdsl.syntax.types import FLOAT, INT, PRIMITIVES, STRING, Array, Primitive, Type

from .expressions import expressions, literals, texts
from .machines import PLAIN, World, docs_of, machines

NAMES = [
    *("Uav", "count", "string", "steps", "goal", "s", "min", "_x", "world", "A1", "of", "by", "x"),
    *("ms", "e", "notify", "trueish", "size", "zyre", "UAVSearch", "seed", "result", "step", "us"),
    *("Header", "int32", "gives_", "Bool", "maximize", "request", "response", "len", "deep", "h"),
    *("internal", "resultOf", "feedback", "underlying", "a_B"),
]
FIELDS = ["state", "type", "event", "on", "const", "or", "not", "true", "s", "min", "by", "x"]
ENDS = ["i", "ii", "out_", "p", "q", "r", "t", "u", "v", "w"]

docs = st.sampled_from(
    [
        "",
        "",
        "",
        "What it is.",
        "Two\n\n  lines",
        "/ // x",
        'a "b" {',
        "a*/ /* \u2028b\\",
        "\\u0041",
    ]
)
topics = st.sampled_from(["a/b", "/x", "~p", "state", "cmd/go_1"])


@st.composite
def systems(draw: st.DrawFn) -> System:
    package = draw(st.sampled_from(["p", "a.b.state", "model_1", "my-model", "event"]))
    named = package not in ("my-model", "event")
    # What is called like a type of the language needs a package that can be written.
    names = [each for each in draw(st.permutations(NAMES)) if named or each not in PRIMITIVES]
    interfaces = _interfaces(draw, names, package.replace(".", "_"))
    messages = [each for each in interfaces if isinstance(each, Message)]
    types: list[Type] = [each.type for each in messages]
    types += [Named("foreign_msgs", "Thing"), Array(INT), Array(STRING, 3)]
    events = _events(draw, names, [*types[: len(messages)], Named("foreign_msgs", "Thing")])
    functions = _functions(draw, names, interfaces, types)
    components, interfaces, functions = _components(
        draw, names, types, interfaces, functions, package.replace(".", "_")
    )
    world = World({each.type: each for each in interfaces}, events, functions, docs, types)
    behaviours = [
        machines(draw, names.pop(), world) for _ in range(draw(st.sampled_from([1, 2, 0])))
    ]
    members = _members(draw, names, types, components, behaviours, functions)
    fitness = [_fitness(draw, names.pop()) for _ in range(draw(st.integers(0, 1)))]
    environments = [_environment(draw, names.pop()) for _ in range(draw(st.integers(0, 1)))]
    swarms = [
        _swarm(draw, names.pop(), members, environments, fitness)
        for _ in range(draw(st.integers(0, 1)) if members else 0)
    ]
    # One without a fitness has nothing to compare by.
    optimizations = [
        _optimization(draw, swarm, members)
        for swarm in swarms
        if swarm.fitness is not None and draw(st.booleans())
    ]
    return System(
        package,
        tuple(interfaces),
        tuple(events),
        tuple(functions),
        tuple(components),
        tuple(members),
        tuple(behaviours),
        tuple(environments),
        tuple(swarms),
        tuple(fitness),
        tuple(optimizations),
        (),
        draw(docs) if named else "",
    )


def _environment(draw: st.DrawFn, name: str) -> Environment:
    world = draw(st.none() | texts)
    sizes = st.lists(st.floats(1e-9, 1e30), min_size=2, max_size=3).map(tuple)
    size = draw(st.none() | sizes)
    given = [word for word, value in (("world", world), ("size", size)) if value is not None]
    return Environment(name, world, size, draw(docs), docs_of(draw, docs, *given))


def _value_type(draw: st.DrawFn, types: Sequence[Type]) -> Type:
    plain = [*PLAIN, Primitive("uint8"), Primitive("float32"), Primitive("string", 10)]
    arrays = [Array(Primitive("uint8"), 16), Array(FLOAT, 4, True)]
    return draw(st.sampled_from([*plain, *arrays, *types]))


def _fields(draw: st.DrawFn, types: Sequence[Type], *, names: Sequence[str] = FIELDS) -> tuple:
    chosen = draw(st.lists(st.sampled_from(names), max_size=3, unique=True))
    return tuple(Field(name, _value_type(draw, types), draw(docs)) for name in chosen)


def _interfaces(draw: st.DrawFn, names: list[str], package: str) -> list[Interface]:
    made: list[Interface] = []
    types: list[Type] = []
    for number in range(draw(st.integers(1, 4))):
        external = draw(st.booleans())
        name = names.pop()
        type_ = Named(f"far{number}_msgs" if external else package, name)
        match draw(st.sampled_from(["message", "message", "service", "action"])):
            case "message":
                constants = [
                    Constant(
                        constant,
                        kind := draw(st.sampled_from(PLAIN)),
                        draw(literals(kind)),
                        draw(docs),
                    )
                    for constant in draw(st.sampled_from([(), ("LOW",), ("A", "count")]))
                ]
                made.append(
                    Message(type_, _fields(draw, types), external, tuple(constants), draw(docs))
                )
                types.append(type_)
            case "service":
                parts = [_fields(draw, types) for _ in range(2)]
                made.append(Service(type_, *parts, external, draw(docs)))
            case "action":
                parts = [_fields(draw, types) for _ in range(3)]
                made.append(Action(type_, *parts, external, draw(docs)))
    return made


def _events(draw: st.DrawFn, names: list[str], messages: Sequence[Type]) -> list[Event]:
    found: list[Event] = []
    for number in range(draw(st.integers(1, 3))):
        name = names.pop()
        topic = draw(st.sampled_from([snake_case(name), f"t{number}/x", f"~t{number}"]))
        if topic in {each.topic for each in found}:
            topic = f"other_{number}"
        type_ = draw(st.sampled_from(messages))
        assert isinstance(type_, Named)
        found.append(Event(name, type_, topic, draw(st.booleans()), draw(docs)))
    return found


def _functions(
    draw: st.DrawFn, names: list[str], interfaces: list[Interface], types: list[Type]
) -> list[Function]:
    callable_ = [each for each in interfaces if isinstance(each, (Service, Action))]
    found = []
    for known in callable_:
        if not draw(st.booleans()):
            continue
        paradigm = "action" if isinstance(known, Action) else "service"
        messages = [each for each in types if isinstance(each, Named)]
        ports = [
            FunctionPort(
                draw(st.sampled_from(["in", "out"])),
                draw(topics),
                draw(st.sampled_from(messages)),
                draw(docs),
            )
            for _ in range(draw(st.integers(0, 2)))
        ]
        call = Communication(paradigm, draw(topics), known.type, draw(docs))
        params = _params(draw, ["pa", "s", "by"])
        category = draw(st.sampled_from(["abstraction", "swarm"]))
        name = names.pop()
        found.append(Function(name, category, call, tuple(ports), params, draw(docs)))
    return found


def _params(draw: st.DrawFn, names: Sequence[str]) -> tuple[Param, ...]:
    chosen = draw(st.lists(st.sampled_from(names), max_size=2, unique=True)) if names else []
    return tuple(
        Param(name, type_, draw(st.none() | literals(type_)), draw(docs))
        for name in chosen
        for type_ in [draw(st.sampled_from(PLAIN))]
    )


def _ports(draw: st.DrawFn, names: Sequence[str], types: Sequence[Type]) -> tuple[Port, ...]:
    chosen = draw(st.lists(st.sampled_from(names), max_size=2, unique=True)) if names else []
    return tuple(
        Port(
            name,
            draw(st.sampled_from(["in", "out", "inout"])),
            draw(st.sampled_from([types[0], *types])),
            draw(st.just(snake_case(name)) | topics),
            draw(docs),
        )
        for name in chosen
    )


def _components(
    draw: st.DrawFn,
    names: list[str],
    types: list[Type],
    interfaces: list[Interface],
    functions: list[Function],
    package: str,
) -> tuple[list[Component], list[Interface], list[Function]]:
    """Return components, with the interfaces and functions of their operations."""
    left, right = list(interfaces), list(functions)
    all_interfaces: list[Interface] = []
    all_functions: list[Function] = []
    found: list[Component] = []
    for number in range(draw(st.integers(0, 3))):
        name = names.pop()
        kind = draw(st.sampled_from(["sensor", "actuator", "controller", "virtual"]))
        base = draw(st.sampled_from(found)) if found and draw(st.booleans()) else None
        own = Component(
            name,
            base.kind if base else kind,
            _ports(draw, [f"port{number}", f"in{number}"], types),
            _params(draw, [f"rate{number}", f"s{number}"]),
            doc=draw(docs),
        )
        operations: list[str] = []
        all_interfaces += [left.pop(0) for _ in range(draw(st.integers(0, len(left))))]
        all_functions += [right.pop(0) for _ in range(draw(st.integers(0, len(right))))]
        if base is not None:
            inherited = asked_of(snake_case(name), base.operations, all_functions)
            # Two names can have one namespace: `x` and `_x`.
            all_functions += [each for each in inherited if each not in all_functions]
            operations += [each.name for each in inherited]
        for operation in draw(st.sampled_from([(), ("zoom",), (f"look{number}", "s_t")])):
            operation = f"{operation}{number}"
            type_ = Named(package, f"{name}{camel_case(operation)}")
            doc = draw(docs)
            asked = _fields(draw, types, names=ENDS[:5])
            all_interfaces.append(
                Service(type_, asked, _fields(draw, types, names=ENDS[5:]), False, doc)
            )
            call = Communication("service", f"{snake_case(name)}/{operation}", type_)
            offered = f"{snake_case(name)}_{operation}"
            all_functions.append(Function(offered, "abstraction", call, (), (), doc))
            operations.append(offered)
        own = replace(own, operations=tuple(operations))
        if base is not None:
            defaults = tuple(
                replace(each, default=draw(literals(each.type))) if draw(st.booleans()) else each
                for each in base.params
            )
            own = replace(
                own,
                ports=base.ports + own.ports,
                params=defaults + own.params,
                base=base.name,
            )
        found.append(own)
    return found, all_interfaces + left, all_functions + right


def asked_of(
    namespace: str, operations: Sequence[str], functions: Sequence[Function]
) -> list[Function]:
    """Return the same operations, with servers in another namespace."""
    found = [each for name in operations for each in functions if each.name == name]
    names = [each.communication.name.rpartition("/")[2] for each in found]
    return [
        replace(
            each,
            name=f"{namespace}_{name}",
            communication=replace(each.communication, name=f"{namespace}/{name}"),
        )
        for each, name in zip(found, names, strict=True)
    ]


def _members(
    draw: st.DrawFn,
    names: list[str],
    types: list[Type],
    components: list[Component],
    behaviours: list[StateMachine],
    functions: list[Function],
) -> list[Member]:
    """Return members; the functions of their parts are added to `functions`."""
    found: list[Member] = []
    for number in range(draw(st.integers(0, 3))):
        base = draw(st.sampled_from(found)) if found and draw(st.booleans()) else None
        params = (base.params if base else ()) + _params(draw, [f"m{number}", f"altitude{number}"])
        machine = draw(st.sampled_from(behaviours)) if behaviours and draw(st.booleans()) else None
        said = docs_of(draw, docs, "behavior") if machine else ()
        if machine is None and base is not None:
            machine = next((each for each in behaviours if each.name == base.behavior), None)
            said = base.docs
        if machine is not None:
            known = {each.name for each in params}
            params += tuple(
                replace(each, doc=draw(docs))
                for each in machine.params
                if each.default is None and each.name not in known
            )
        leaves = [ParamRef(each.name, each.type) for each in params]
        parts = []
        for place in range(draw(st.integers(0, 2)) if components else 0):
            component = draw(st.sampled_from(components))
            chosen = [
                each for each in component.params if each.default is None or draw(st.booleans())
            ]
            values = [(each.name, expressions(draw, each.type, leaves)) for each in chosen]
            offered = asked_of(f"part{number}{place}", component.operations, functions)
            functions += offered
            parts.append(
                Part(
                    f"part{number}{place}",
                    component.name,
                    tuple((name, value) for name, value in values if value is not None),
                    tuple(each.name for each in offered),
                    draw(docs),
                    docs_of(draw, docs, *(name for name, value in values if value is not None)),
                )
            )
        ports = (base.ports if base else ()) + _ports(draw, [f"end{number}", f"s{number}"], types)
        parts = [*(base.parts if base else ()), *parts]
        settings = [
            (name, draw(literals(INT if name == "port" else STRING)))
            for name in draw(st.lists(st.sampled_from(["ifname", "port"]), unique=True))
        ]
        communication = CommunicationSettings(
            draw(st.sampled_from(["zyre", "s"])),
            tuple(settings),
            draw(docs),
            docs_of(draw, docs, *(name for name, _ in settings)),
        )
        if draw(st.booleans()):
            communication = base.communication if base else None
        found.append(
            Member(
                names.pop(),
                machine.name if machine else None,
                ports,
                params,
                tuple(parts),
                _connectors(draw, base.connectors if base else (), ports, parts, components),
                communication,
                base.name if base else None,
                draw(docs),
                said,
            )
        )
    return found


def _connectors(
    draw: st.DrawFn,
    inherited: tuple[Connector, ...],
    ports: Sequence[Port],
    parts: Sequence[Part],
    components: Sequence[Component],
) -> tuple[Connector, ...]:
    known = {each.name: each for each in components}
    inner = [(part.name, port) for part in parts for port in known[part.component].ports]
    outer = [(None, port) for port in ports]
    sources = [each for each in inner if each[1].direction != "in"]
    sources += [each for each in outer if each[1].direction != "out"]
    targets = [each for each in inner if each[1].direction != "out"]
    targets += [each for each in outer if each[1].direction != "in"]
    pairs = [(a, b) for a in sources for b in targets if a[1].type == b[1].type and a is not b]
    ends = [(PortRef(a[0], a[1].name), PortRef(b[0], b[1].name)) for a, b in pairs]
    known_ends = [(each.source, each.target) for each in inherited]
    ends = [each for each in ends if each not in known_ends]
    chosen = draw(st.lists(st.sampled_from(ends), max_size=2, unique=True)) if ends else []
    return (*inherited, *(Connector(source, target, draw(docs)) for source, target in chosen))


def _fitness(draw: st.DrawFn, name: str) -> Fitness:
    types = st.sampled_from([INT, FLOAT])
    inputs = [FitnessInput(each, draw(types), None, draw(docs)) for each in ("s", "by")]
    params = _params(draw, ["w", "min"])
    leaves = [VariableRef(each.name, each.type) for each in inputs]
    value = expressions(
        draw, FLOAT, [*leaves, *(ParamRef(each.name, each.type) for each in params)]
    )
    assert value is not None
    goal = draw(st.sampled_from(["maximize", "minimize"]))
    said = docs_of(draw, docs, "value")
    return Fitness(name, tuple(inputs), params, goal, value, draw(docs), said)


def _swarm(
    draw: st.DrawFn,
    name: str,
    members: list[Member],
    environments: list[Environment],
    fitness: list[Fitness],
) -> Swarm:
    multiplicities = [Multiplicity(1, 1), Multiplicity(3, 3), Multiplicity(0, None)]
    multiplicities += [Multiplicity(2, None), Multiplicity(0, 4), Multiplicity(1, 5)]
    roles = [
        _role(draw, role, draw(st.sampled_from(members)), draw(st.sampled_from(multiplicities)))
        for role in draw(
            st.lists(
                st.sampled_from(["count", "steps", "seed", "s", "world", "uav"]),
                min_size=1,
                max_size=3,
                unique=True,
            )
        )
    ]
    place = draw(st.sampled_from([None, *(each.name for each in environments)]))
    goal = draw(st.sampled_from([None, *(each.name for each in fitness)]))
    given = [word for word, name in (("environment", place), ("fitness", goal)) if name is not None]
    return Swarm(name, tuple(roles), place, goal, draw(docs), docs_of(draw, docs, *given))


def _role(draw: st.DrawFn, name: str, member: Member, multiplicity: Multiplicity) -> Role:
    """Return a role that sets each param without a default, and others of some robots."""
    params = [each for each in member.params if isinstance(each.type, Primitive)]
    given = [each for each in params if each.default is None or draw(st.booleans())]
    most = multiplicity.upper or 9
    indexes = draw(st.lists(st.integers(0, most - 1), max_size=2, unique=True))
    robots = []
    for index in sorted(indexes):
        own = draw(st.lists(st.sampled_from(params), max_size=2, unique=True)) if params else []
        said = docs_of(draw, docs, *(each.name for each in own))
        robots.append(RobotValues(index, _set(draw, own), draw(docs), said))
    said = docs_of(draw, docs, *(each.name for each in given))
    values = _set(draw, given)
    return Role(name, member.name, multiplicity, values, tuple(robots), draw(docs), said)


def _set(draw: st.DrawFn, params: Sequence[Param]) -> tuple[tuple[str, Expression], ...]:
    return tuple((each.name, draw(literals(each.type))) for each in params)


def _optimization(draw: st.DrawFn, swarm: Swarm, members: list[Member]) -> Optimization:
    known = {each.name: each for each in members}
    ranges = [
        ParamRange(
            role.name,
            param.name,
            Literal(-1.5 if param.type == FLOAT else -1, param.type),
            Literal(9.0 if param.type == FLOAT else 9, param.type),
            draw(st.none() | st.just(Literal(1, INT))),
            draw(docs),
        )
        for role in swarm.roles
        for param in known[role.member].params
        if param.type in (INT, FLOAT) and draw(st.booleans())
    ]
    counts = [
        CountRange(role.name, Literal(1, INT), Literal(draw(st.integers(1, 9)), INT), draw(docs))
        for role in swarm.roles
        if draw(st.booleans())
    ]
    settings = draw(
        st.lists(st.sampled_from(["steps", "evaluations", "seed"]), max_size=3, unique=True)
    )
    return Optimization(
        swarm.name,
        tuple(ranges),
        tuple(counts),
        tuple((name, Literal(draw(st.integers(1, 999)), INT)) for name in settings),
        draw(docs),
        docs_of(draw, docs, *settings),
    )
