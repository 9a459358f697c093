"""New projects: `swarmc new`."""
