"""Kinds of the protocol for each kind of declaration."""

from __future__ import annotations

from lsprotocol import types as lsp

from swarmdsl.syntax import ast
from swarmdsl.syntax.ast import Node

SYMBOL_KINDS: dict[type[Node], lsp.SymbolKind] = {
    ast.StructType: lsp.SymbolKind.Struct,
    ast.EnumType: lsp.SymbolKind.Enum,
    ast.EnumValue: lsp.SymbolKind.EnumMember,
    ast.AliasType: lsp.SymbolKind.TypeParameter,
    ast.Constant: lsp.SymbolKind.Constant,
    ast.MessageType: lsp.SymbolKind.Struct,
    ast.ServiceType: lsp.SymbolKind.Interface,
    ast.ActionType: lsp.SymbolKind.Interface,
    ast.Field: lsp.SymbolKind.Field,
    ast.Event: lsp.SymbolKind.Event,
    ast.Function: lsp.SymbolKind.Function,
    ast.Operation: lsp.SymbolKind.Method,
    ast.Component: lsp.SymbolKind.Class,
    ast.Member: lsp.SymbolKind.Class,
    ast.Part: lsp.SymbolKind.Field,
    ast.Port: lsp.SymbolKind.Property,
    ast.Param: lsp.SymbolKind.Property,
    ast.Variable: lsp.SymbolKind.Variable,
    # Editors draw modules, namespaces, packages and objects alike.
    ast.StateMachine: lsp.SymbolKind.Module,
    ast.State: lsp.SymbolKind.EnumMember,
    ast.Parallel: lsp.SymbolKind.EnumMember,
    ast.FinalState: lsp.SymbolKind.EnumMember,
    ast.History: lsp.SymbolKind.EnumMember,
    ast.Choice: lsp.SymbolKind.Operator,
    ast.Region: lsp.SymbolKind.Array,
    ast.Swarm: lsp.SymbolKind.Package,
    ast.Role: lsp.SymbolKind.Field,
    ast.Area: lsp.SymbolKind.Field,
    ast.Zone: lsp.SymbolKind.Field,
    ast.Obstacle: lsp.SymbolKind.Field,
    ast.Targets: lsp.SymbolKind.Field,
    ast.Fitness: lsp.SymbolKind.Function,
    ast.Property: lsp.SymbolKind.Boolean,
}
COMPLETION_KINDS: dict[type[Node], lsp.CompletionItemKind] = {
    ast.StructType: lsp.CompletionItemKind.Struct,
    ast.EnumType: lsp.CompletionItemKind.Enum,
    ast.EnumValue: lsp.CompletionItemKind.EnumMember,
    ast.AliasType: lsp.CompletionItemKind.TypeParameter,
    ast.Constant: lsp.CompletionItemKind.Constant,
    ast.MessageType: lsp.CompletionItemKind.Struct,
    ast.ServiceType: lsp.CompletionItemKind.Interface,
    ast.ActionType: lsp.CompletionItemKind.Interface,
    ast.Field: lsp.CompletionItemKind.Field,
    ast.Parameter: lsp.CompletionItemKind.Field,
    ast.Event: lsp.CompletionItemKind.Event,
    ast.Function: lsp.CompletionItemKind.Function,
    ast.Operation: lsp.CompletionItemKind.Method,
    ast.Component: lsp.CompletionItemKind.Class,
    ast.Member: lsp.CompletionItemKind.Class,
    ast.Part: lsp.CompletionItemKind.Field,
    ast.Port: lsp.CompletionItemKind.Property,
    ast.Param: lsp.CompletionItemKind.Property,
    ast.StateMachine: lsp.CompletionItemKind.Module,
    ast.State: lsp.CompletionItemKind.Reference,
    ast.Parallel: lsp.CompletionItemKind.Reference,
    ast.FinalState: lsp.CompletionItemKind.Reference,
    ast.History: lsp.CompletionItemKind.Reference,
    ast.Choice: lsp.CompletionItemKind.Operator,
    ast.Role: lsp.CompletionItemKind.Field,
    ast.Area: lsp.CompletionItemKind.Field,
    ast.Targets: lsp.CompletionItemKind.Field,
}
