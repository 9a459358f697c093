"""Text and insertion point of each kind of element that `swarmc add` creates.

Each function gets the command-line options by name and raises UsageError for invalid values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl.base.errors import UsageError
from swarmdsl.base.naming import snake_case
from swarmdsl.importing.update.merging import doc_comment
from swarmdsl.syntax.ast import Component, Member, Swarm
from swarmdsl.tools.refactor import element_text
from swarmdsl.tools.refactor.add import (
    FindInsertion,
    declaration,
    machine_if_absent,
    part_of,
    transition,
)
from swarmdsl.tools.refactor.add import state as state_at

Options = Mapping[str, Any]


def component(options: Options) -> list[FindInsertion]:
    """Return a new component, optionally with a state machine and as a part of a member."""
    name = options["name"]
    lines = [
        *_ports(options),
        *element_text.params(options["params"]),
        *(f"operation {each}" for each in options["operations"]),
        *_behaviour(options),
    ]
    text = element_text.block(options["doc"], f"{options['kind']} {name}{_base(options)}", lines)
    insertions = [*_machine(options, Component), declaration(name, text, options["file"])]
    if options["to"]:
        owner, _, part = options["to"].partition(".")
        part = part or snake_case(name)
        insertions.append(part_of(owner, part, Member, f"{part} : {name}"))
    return insertions


def member(options: Options) -> list[FindInsertion]:
    """Return a new member, optionally with a state machine and as a role of a swarm."""
    name = options["name"]
    head = [*_behaviour(options), *element_text.params(options["params"]), *_ports(options)]
    parts, connectors = (
        element_text.parts(options["parts"]),
        element_text.connectors(options["connectors"]),
    )
    groups = [group for group in (head, list(parts), list(connectors)) if group]
    lines = [line for group in groups for line in ("", *group)][1:]
    text = element_text.block(options["doc"], f"member {name}{_base(options)}", lines)
    insertions = [*_machine(options, Member), declaration(name, text, options["file"])]
    if options["to"]:
        swarm_name, _, count = options["to"].partition("=")
        (line,) = element_text.roles([f"{name}={count}" if count else name])
        insertions.append(part_of(swarm_name, snake_case(name), Swarm, line))
    return insertions


def function(options: Options) -> list[FindInsertion]:
    """Return a new function."""
    name = options["name"]
    lines = [
        element_text.call(options["action"], options["service"]),
        *element_text.topics("in", options["incoming"]),
        *element_text.topics("out", options["outgoing"]),
        *element_text.params(options["params"]),
    ]
    text = element_text.block(options["doc"], f"function {name} : {options['category']}", lines)
    return [declaration(name, text, options["file"])]


def event(options: Options) -> list[FindInsertion]:
    """Return a new event."""
    name = options["name"]
    kind = "swarm event" if options["swarm"] else "event"
    if options["operator"]:
        kind = "swarm operator event"
    topic = f' on "{options["topic"]}"' if options["topic"] else ""
    text = f"{_doc(options)}{kind} {name} : {options['type_']}{topic}"
    return [declaration(name, text, options["file"])]


def swarm(options: Options) -> list[FindInsertion]:
    """Return a new swarm."""
    name = options["name"]
    lines = [*element_text.roles(options["members"])]
    lines += [f"{word} {options[word]}" for word in ("environment", "fitness") if options[word]]
    text = element_text.block(options["doc"], f"swarm {name}", lines)
    return [declaration(name, text, options["file"])]


def state(options: Options) -> list[FindInsertion]:
    """Return a new state and the transitions to it."""
    path = options["name"]
    owner, _, name = path.rpartition(".")
    if not owner:
        raise UsageError(f"qualify the state with its state machine: `MACHINE.{name}`")
    incoming = [element_text.incoming_transition(each, name) for each in options["ways_in"]]
    transitions = [transition(f"{owner}.{source}", text) for source, text in incoming]
    lines = [f"do {options['activity']}"] if options["activity"] else []
    lines += [f"on {each}" for each in options["transitions"]]
    lines += [f"after {each}" for each in options["delays"]]
    if options["final"]:
        if lines or options["runs"]:
            raise UsageError("a final state has no activity and no transitions")
        return [state_at(path, f"{_doc(options)}final {name}"), *transitions]
    head = f"state {name}" + (f" = {options['runs']}" if options["runs"] else "")
    return [state_at(path, element_text.block(options["doc"], head, lines)), *transitions]


CREATORS: Mapping[str, Callable[[Options], list[FindInsertion]]] = {
    each.__name__: each for each in (component, member, function, event, swarm, state)
}
"""Creator of each kind of element."""


def _doc(options: Options) -> str:
    return f"{doc_comment(options['doc'])}\n" if options["doc"] else ""


def _ports(options: Options) -> list[str]:
    ports = element_text.Ports(options["incoming"], options["outgoing"], options["both"])
    return list(ports.lines())


def _base(options: Options) -> str:
    return f" extends {options['extends']}" if options["extends"] else ""


def _behaviour(options: Options) -> list[str]:
    return [f"behavior {options['behavior']}"] if options["behavior"] else []


def _machine(options: Options, user: type[Component] | type[Member]) -> Sequence[FindInsertion]:
    """State machine of a new element, unless it exists."""
    name = options["behavior"]
    if not name:
        return ()
    return (
        machine_if_absent(
            name,
            element_text.machine(name, f"The behaviour of `{options['name']}`."),
            user,
            options["file"],
        ),
    )
