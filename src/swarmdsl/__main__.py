"""Run `swarmc` as `python -m swarmdsl`."""

from swarmdsl.cli import main

main()
