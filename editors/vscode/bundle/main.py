"""Run the swarmc bundled with the editor extension, which serves editors, debugs and runs tests."""

import sys

if sys.argv[1:2] not in (["debug"], ["lsp"], ["test"]):
    sys.exit(
        "this swarmc is bundled with the VS Code extension: it serves editors, debugs and tests;\n"
        "install the Python package swarmdsl and choose its interpreter with the command "
        "`Swarm: Select Interpreter`"
    )

from swarmdsl.cli import main

main()
