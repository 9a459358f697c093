"""Create projects: `swarmc new`."""
