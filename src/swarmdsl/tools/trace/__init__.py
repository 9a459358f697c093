"""Add model locations to output that names generated files: `swarmc trace`."""
