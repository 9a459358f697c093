"""The language server: what an editor asks of a model, answered from the workspace.

The Language Server Protocol (LSP 3.17) is that of pygls; the `..._answers` modules say in its
types what all others know. Nothing here parses, links or checks on its own.
"""
