"""Language server: answers requests of editors from the workspace.

Built on pygls (LSP 3.17). The `handlers` convert the results of the other modules into types of the
protocol. Nothing here parses, links or checks on its own.
"""
