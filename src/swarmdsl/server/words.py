"""What the kinds of declarations are called in the protocol, which knows those of programs."""

from __future__ import annotations

from lsprotocol import types as lsp

from swarmdsl import syntax
from swarmdsl.syntax import Node

SYMBOL_KINDS: dict[type[Node], lsp.SymbolKind] = {
    syntax.StructType: lsp.SymbolKind.Struct,
    syntax.EnumType: lsp.SymbolKind.Enum,
    syntax.EnumValue: lsp.SymbolKind.EnumMember,
    syntax.AliasType: lsp.SymbolKind.TypeParameter,
    syntax.Constant: lsp.SymbolKind.Constant,
    syntax.MessageType: lsp.SymbolKind.Struct,
    syntax.ServiceType: lsp.SymbolKind.Interface,
    syntax.ActionType: lsp.SymbolKind.Interface,
    syntax.Field: lsp.SymbolKind.Field,
    syntax.Event: lsp.SymbolKind.Event,
    syntax.Function: lsp.SymbolKind.Function,
    syntax.Operation: lsp.SymbolKind.Method,
    syntax.Component: lsp.SymbolKind.Class,
    syntax.Member: lsp.SymbolKind.Class,
    syntax.Part: lsp.SymbolKind.Field,
    syntax.Port: lsp.SymbolKind.Property,
    syntax.Param: lsp.SymbolKind.Property,
    syntax.Variable: lsp.SymbolKind.Variable,
    syntax.StateMachine: lsp.SymbolKind.Module,
    syntax.Region: lsp.SymbolKind.Namespace,
    syntax.Swarm: lsp.SymbolKind.Package,
    syntax.Role: lsp.SymbolKind.Field,
    syntax.Fitness: lsp.SymbolKind.Function,
}
COMPLETION_KINDS: dict[type[Node], lsp.CompletionItemKind] = {
    syntax.StructType: lsp.CompletionItemKind.Struct,
    syntax.EnumType: lsp.CompletionItemKind.Enum,
    syntax.EnumValue: lsp.CompletionItemKind.EnumMember,
    syntax.AliasType: lsp.CompletionItemKind.TypeParameter,
    syntax.Constant: lsp.CompletionItemKind.Constant,
    syntax.MessageType: lsp.CompletionItemKind.Struct,
    syntax.ServiceType: lsp.CompletionItemKind.Interface,
    syntax.ActionType: lsp.CompletionItemKind.Interface,
    syntax.Field: lsp.CompletionItemKind.Field,
    syntax.Parameter: lsp.CompletionItemKind.Field,
    syntax.Event: lsp.CompletionItemKind.Event,
    syntax.Function: lsp.CompletionItemKind.Function,
    syntax.Operation: lsp.CompletionItemKind.Method,
    syntax.Component: lsp.CompletionItemKind.Class,
    syntax.Member: lsp.CompletionItemKind.Class,
    syntax.Part: lsp.CompletionItemKind.Field,
    syntax.Port: lsp.CompletionItemKind.Property,
    syntax.Param: lsp.CompletionItemKind.Property,
    syntax.StateMachine: lsp.CompletionItemKind.Module,
    syntax.State: lsp.CompletionItemKind.Reference,
    syntax.Parallel: lsp.CompletionItemKind.Reference,
    syntax.Role: lsp.CompletionItemKind.Field,
}
