"""Run the swarmc bundled with the editor extension, which only serves editors."""

import sys

if sys.argv[1:2] != ["lsp"]:
    sys.exit(
        "this swarmc is bundled with the VS Code extension and only serves editors;\n"
        "install the Python package swarmdsl and choose its interpreter with the command "
        "`Swarm: Select Interpreter`"
    )

from swarmdsl.cli import main

main()
