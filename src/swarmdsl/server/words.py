"""What the kinds of declarations are called in the protocol, which knows those of programs."""

from __future__ import annotations

from lsprotocol.types import CompletionItemKind, SymbolKind

from swarmdsl import syntax
from swarmdsl.syntax import Node

SYMBOL_KINDS: dict[type[Node], SymbolKind] = {
    syntax.StructType: SymbolKind.Struct,
    syntax.EnumType: SymbolKind.Enum,
    syntax.EnumValue: SymbolKind.EnumMember,
    syntax.AliasType: SymbolKind.TypeParameter,
    syntax.Constant: SymbolKind.Constant,
    syntax.MessageType: SymbolKind.Struct,
    syntax.ServiceType: SymbolKind.Interface,
    syntax.ActionType: SymbolKind.Interface,
    syntax.Field: SymbolKind.Field,
    syntax.Event: SymbolKind.Event,
    syntax.Function: SymbolKind.Function,
    syntax.Operation: SymbolKind.Method,
    syntax.Component: SymbolKind.Class,
    syntax.Member: SymbolKind.Class,
    syntax.Part: SymbolKind.Field,
    syntax.Port: SymbolKind.Property,
    syntax.Param: SymbolKind.Property,
    syntax.Variable: SymbolKind.Variable,
    syntax.StateMachine: SymbolKind.Module,
    syntax.State: SymbolKind.Object,
    syntax.Parallel: SymbolKind.Object,
    syntax.Region: SymbolKind.Namespace,
    syntax.Swarm: SymbolKind.Package,
    syntax.Role: SymbolKind.Field,
    syntax.Fitness: SymbolKind.Function,
}
COMPLETION_KINDS: dict[type[Node], CompletionItemKind] = {
    syntax.StructType: CompletionItemKind.Struct,
    syntax.EnumType: CompletionItemKind.Enum,
    syntax.EnumValue: CompletionItemKind.EnumMember,
    syntax.AliasType: CompletionItemKind.TypeParameter,
    syntax.Constant: CompletionItemKind.Constant,
    syntax.MessageType: CompletionItemKind.Struct,
    syntax.Event: CompletionItemKind.Event,
    syntax.Function: CompletionItemKind.Function,
    syntax.Operation: CompletionItemKind.Method,
    syntax.Component: CompletionItemKind.Class,
    syntax.Member: CompletionItemKind.Class,
    syntax.Part: CompletionItemKind.Field,
    syntax.Port: CompletionItemKind.Property,
    syntax.Param: CompletionItemKind.Property,
    syntax.StateMachine: CompletionItemKind.Module,
    syntax.State: CompletionItemKind.Reference,
    syntax.Parallel: CompletionItemKind.Reference,
    syntax.Role: CompletionItemKind.Field,
}
