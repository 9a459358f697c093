"""Requests that the server answers, with their registration options.

Modules of handlers are imported on first use, so that diagnostics come first.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.ide.server.session import Session
from swarmdsl.ide.server.tokens import MODIFIERS, TYPES

FIX_ALL = "source.fixAll.swarmdsl"
"""Kind of the code action that applies all certain fixes of a file."""

FEATURES: Mapping[str, Mapping[str, Any]] = {
    "read": {
        lsp.TEXT_DOCUMENT_HOVER: None,
        lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: None,
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL: lsp.SemanticTokensLegend(
            token_types=TYPES, token_modifiers=MODIFIERS
        ),
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA: None,
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE: None,
        lsp.TEXT_DOCUMENT_FOLDING_RANGE: None,
        lsp.TEXT_DOCUMENT_SELECTION_RANGE: None,
        lsp.TEXT_DOCUMENT_INLAY_HINT: None,
        lsp.TEXT_DOCUMENT_DOCUMENT_LINK: None,
        lsp.TEXT_DOCUMENT_CODE_LENS: None,
        lsp.CODE_LENS_RESOLVE: None,
    },
    "navigate": {
        lsp.TEXT_DOCUMENT_DEFINITION: None,
        lsp.TEXT_DOCUMENT_REFERENCES: None,
        lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: None,
        lsp.WORKSPACE_SYMBOL: None,
        lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY: None,
        lsp.CALL_HIERARCHY_INCOMING_CALLS: None,
        lsp.CALL_HIERARCHY_OUTGOING_CALLS: None,
    },
    "complete": {
        # After the others, formatted text has a blank, which would close the list.
        lsp.TEXT_DOCUMENT_COMPLETION: lsp.CompletionOptions(
            trigger_characters=[" ", ".", "[", "(", "/", '"']
        ),
    },
    "edit": {
        lsp.TEXT_DOCUMENT_SIGNATURE_HELP: lsp.SignatureHelpOptions(
            trigger_characters=["(", ","], retrigger_characters=["="]
        ),
        lsp.TEXT_DOCUMENT_FORMATTING: None,
        lsp.TEXT_DOCUMENT_RANGE_FORMATTING: None,
        lsp.TEXT_DOCUMENT_PREPARE_RENAME: None,
        lsp.TEXT_DOCUMENT_RENAME: None,
        lsp.TEXT_DOCUMENT_CODE_ACTION: lsp.CodeActionOptions(
            code_action_kinds=[
                lsp.CodeActionKind.QuickFix,
                FIX_ALL,
                lsp.CodeActionKind.RefactorExtract,
                lsp.CodeActionKind.RefactorInline,
                "refactor.move",
            ],
            resolve_provider=True,
        ),
        lsp.WORKSPACE_WILL_RENAME_FILES: lsp.FileOperationRegistrationOptions(
            filters=[
                lsp.FileOperationFilter(
                    pattern=lsp.FileOperationPattern(glob="**/*.swarm"), scheme="file"
                ),
                lsp.FileOperationFilter(
                    pattern=lsp.FileOperationPattern(
                        glob="**", matches=lsp.FileOperationPatternKind.Folder
                    ),
                    scheme="file",
                ),
            ]
        ),
        lsp.CODE_ACTION_RESOLVE: None,
    },
    "preview": {"swarmdsl/pictures": None, "swarmdsl/diagramElements": None},
}
"""By module name in `handlers`; its `REQUESTS` maps requests to functions."""


def handlers_of(module: str) -> Mapping[str, Any]:
    """Return the request handlers of a module."""
    found: Mapping[str, Any] = import_module(f"swarmdsl.ide.server.handlers.{module}").REQUESTS
    return found


def answer(module: str, name: str, session: Session, params: Any) -> Any:
    """Answer a request; errors of the handler propagate."""
    return handlers_of(module)[name](session, params)
