"""Run the swarmc bundled with the editor extension, which serves editors and runs tests."""

import sys

if sys.argv[1:2] not in (["lsp"], ["test"]):
    sys.exit(
        "this swarmc is bundled with the VS Code extension and serves editors and runs tests;\n"
        "install the Python package swarmdsl and choose its interpreter with the command "
        "`Swarm: Select Interpreter`"
    )

from swarmdsl.cli import main

main()
