"""The language server: what an editor asks of a model, answered from the workspace.

Each module answers one kind of question with plain data; `protocol` alone speaks the Language
Server Protocol (LSP 3.17). Nothing here parses, links or checks on its own.
"""
