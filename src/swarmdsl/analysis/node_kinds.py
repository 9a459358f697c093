"""Kinds of syntax nodes as diagnostics and the editor name them."""

from __future__ import annotations

from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    Area,
    Choice,
    Component,
    Constant,
    Contract,
    EnumType,
    EnumValue,
    Environment,
    Event,
    Field,
    FinalState,
    Fitness,
    FitnessInput,
    Function,
    History,
    Member,
    MessageType,
    Node,
    Obstacle,
    Operation,
    Parallel,
    Param,
    Parameter,
    Part,
    Port,
    Property,
    Region,
    Role,
    ServiceType,
    State,
    StateMachine,
    StructType,
    Swarm,
    Targets,
    Variable,
    Zone,
)

KINDS: dict[type[Node], str] = {
    StructType: "a struct",
    EnumType: "an enum",
    AliasType: "a type",
    Constant: "a constant",
    MessageType: "a message",
    ServiceType: "a service",
    ActionType: "an action",
    Event: "an event",
    Function: "a function",
    Component: "a component",
    Member: "a member",
    StateMachine: "a state machine",
    Swarm: "a swarm",
    Environment: "an environment",
    Fitness: "a fitness",
    Property: "a property",
    Contract: "a contract",
    Area: "an area",
    Zone: "a zone",
    Obstacle: "an obstacle",
    Targets: "a target",
    FitnessInput: "an input",
    Operation: "an operation",
    Parameter: "a parameter",
    EnumValue: "a value",
    History: "a history",
    Role: "a role",
    Part: "a part",
    Port: "a port",
    Param: "a param",
    Field: "a field",
    Variable: "a variable",
    State: "a state",
    Parallel: "a parallel state",
    Region: "a region",
    Choice: "a choice",
    FinalState: "a final state",
}


def kind_of(node: Node | type[Node]) -> str:
    """Kind of a node with its article: `a state machine`."""
    return KINDS[node if isinstance(node, type) else type(node)]


def kind_name(node: Node | type[Node]) -> str:
    """Kind of a node without an article: `state machine`."""
    return kind_of(node).split(" ", 1)[1]
