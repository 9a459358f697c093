"""Runs the swarmc that the editor extension brings, which serves editors and does no more."""

import sys

if sys.argv[1:2] != ["lsp"]:
    sys.exit(
        "this swarmc comes with the extension of VS Code and only serves editors;\n"
        "install the Python package swarmdsl, and choose its interpreter with the command "
        "`Swarm: Select Interpreter`"
    )

from swarmdsl.cli import main

main()
