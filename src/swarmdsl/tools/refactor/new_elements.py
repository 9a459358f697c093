"""What each kind of thing becomes that `swarmc add` is asked for: its text, and where it goes.

What is given are the values of the command line, by the names of its options there. What cannot be
meant is a UsageError.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl.base.naming import snake_case
from swarmdsl.base.usage_error import UsageError
from swarmdsl.importing.update.merging import commented
from swarmdsl.syntax.ast import Member, Swarm
from swarmdsl.tools.refactor import element_text
from swarmdsl.tools.refactor.add import Place, declaration, part_of, transition, unless_there
from swarmdsl.tools.refactor.add import state as state_at

Given = Mapping[str, Any]


def component(given: Given) -> list[Place]:
    """A component, perhaps with a state machine, and as a part of a member."""
    name = given["name"]
    lines = [
        *_ports(given),
        *element_text.params(given["params"]),
        *(f"operation {each}" for each in given["operations"]),
        *_behaviour(given),
    ]
    text = element_text.block(given["doc"], f"{given['kind']} {name}{_base(given)}", lines)
    made = [*_machine(given), declaration(name, text, given["file"])]
    if given["to"]:
        owner, _, part = given["to"].partition(".")
        part = part or snake_case(name)
        made.append(part_of(owner, part, Member, f"{part} : {name}"))
    return made


def member(given: Given) -> list[Place]:
    """A member, perhaps with a state machine, and as a role of a swarm."""
    name = given["name"]
    head = [*_behaviour(given), *element_text.params(given["params"]), *_ports(given)]
    parts, connectors = (
        element_text.parts(given["parts"]),
        element_text.connectors(given["connectors"]),
    )
    groups = [group for group in (head, list(parts), list(connectors)) if group]
    lines = [line for group in groups for line in ("", *group)][1:]
    text = element_text.block(given["doc"], f"member {name}{_base(given)}", lines)
    made = [*_machine(given), declaration(name, text, given["file"])]
    if given["to"]:
        swarm_name, _, count = given["to"].partition("=")
        (line,) = element_text.roles([f"{name}={count}" if count else name])
        made.append(part_of(swarm_name, snake_case(name), Swarm, line))
    return made


def function(given: Given) -> list[Place]:
    """A function."""
    name = given["name"]
    lines = [
        element_text.call(given["action"], given["service"]),
        *element_text.topics("in", given["incoming"]),
        *element_text.topics("out", given["outgoing"]),
        *element_text.params(given["params"]),
    ]
    text = element_text.block(given["doc"], f"function {name} : {given['category']}", lines)
    return [declaration(name, text, given["file"])]


def event(given: Given) -> list[Place]:
    """An event."""
    name = given["name"]
    kind = "swarm event" if given["swarm"] else "event"
    topic = f' on "{given["topic"]}"' if given["topic"] else ""
    text = f"{_doc(given)}{kind} {name} : {given['type_']}{topic}"
    return [declaration(name, text, given["file"])]


def swarm(given: Given) -> list[Place]:
    """A swarm."""
    name = given["name"]
    lines = [*element_text.roles(given["members"])]
    lines += [f"{word} {given[word]}" for word in ("environment", "fitness") if given[word]]
    text = element_text.block(given["doc"], f"swarm {name}", lines)
    return [declaration(name, text, given["file"])]


def state(given: Given) -> list[Place]:
    """A state, and the transitions that lead to it."""
    path = given["name"]
    owner, _, name = path.rpartition(".")
    if not owner:
        raise UsageError(f"say where `{name}` is to be: MACHINE.{name}")
    ways = [element_text.way_in(each, name) for each in given["ways_in"]]
    led = [transition(f"{owner}.{source}", text) for source, text in ways]
    lines = [f"do {given['activity']}"] if given["activity"] else []
    lines += [f"on {each}" for each in given["transitions"]]
    lines += [f"after {each}" for each in given["delays"]]
    if given["final"]:
        if lines or given["runs"]:
            raise UsageError("a final state does nothing and leads nowhere")
        return [state_at(path, f"{_doc(given)}final {name}"), *led]
    head = f"state {name}" + (f" = {given['runs']}" if given["runs"] else "")
    return [state_at(path, element_text.block(given["doc"], head, lines)), *led]


THINGS: Mapping[str, Callable[[Given], list[Place]]] = {
    each.__name__: each for each in (component, member, function, event, swarm, state)
}
"""What makes each of the kinds."""


def _doc(given: Given) -> str:
    return f"{commented(given['doc'])}\n" if given["doc"] else ""


def _ports(given: Given) -> list[str]:
    ports = element_text.Ports(given["incoming"], given["outgoing"], given["both"])
    return list(ports.lines())


def _base(given: Given) -> str:
    return f" extends {given['extends']}" if given["extends"] else ""


def _behaviour(given: Given) -> list[str]:
    return [f"behavior {given['behavior']}"] if given["behavior"] else []


def _machine(given: Given) -> Sequence[Place]:
    """The state machine that something is to run, if there is none yet."""
    name = given["behavior"]
    if not name:
        return ()
    return (unless_there(name, element_text.machine(name, f"The behaviour of `{given['name']}`.")),)
