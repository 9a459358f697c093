"""Robots of a swarm that run, seen and steered by a person: `swarmc fleet`."""
