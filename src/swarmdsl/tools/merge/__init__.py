"""Merge `.swarm` files by declarations and statements: `swarmc merge`."""
