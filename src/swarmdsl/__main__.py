"""Lets `python -m swarmdsl` do what `swarmc` does."""

from swarmdsl.cli import main

main()
