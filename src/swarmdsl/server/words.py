"""What the kinds of declarations are called in the protocol, which knows those of programs."""

from __future__ import annotations

from swarmdsl import syntax
from swarmdsl.syntax import Node

# Source: LSP 3.17, `SymbolKind`.
SYMBOL_KINDS: dict[type[Node], int] = {
    syntax.StructType: 23,
    syntax.EnumType: 10,
    syntax.EnumValue: 22,
    syntax.AliasType: 26,
    syntax.Constant: 14,
    syntax.MessageType: 23,
    syntax.ServiceType: 11,
    syntax.ActionType: 11,
    syntax.Field: 8,
    syntax.Event: 24,
    syntax.Function: 12,
    syntax.Operation: 6,
    syntax.Component: 5,
    syntax.Member: 5,
    syntax.Part: 8,
    syntax.Port: 7,
    syntax.Param: 7,
    syntax.Variable: 13,
    syntax.StateMachine: 2,
    syntax.Region: 3,
    syntax.Swarm: 4,
    syntax.Role: 8,
    syntax.Fitness: 12,
}
SYMBOL_OBJECT = 19

# Source: LSP 3.17, `CompletionItemKind`.
COMPLETION_KINDS: dict[type[Node], int] = {
    syntax.StructType: 22,
    syntax.EnumType: 13,
    syntax.EnumValue: 20,
    syntax.AliasType: 25,
    syntax.Constant: 21,
    syntax.MessageType: 22,
    syntax.ServiceType: 8,
    syntax.ActionType: 8,
    syntax.Field: 5,
    syntax.Parameter: 5,
    syntax.Event: 23,
    syntax.Function: 3,
    syntax.Operation: 2,
    syntax.Component: 7,
    syntax.Member: 7,
    syntax.Part: 5,
    syntax.Port: 10,
    syntax.Param: 10,
    syntax.StateMachine: 9,
    syntax.State: 18,
    syntax.Parallel: 18,
    syntax.Role: 5,
}
COMPLETION_KEYWORD, COMPLETION_VARIABLE, COMPLETION_SNIPPET, COMPLETION_STRUCT = 14, 6, 15, 22
