"""Targets that tests of all targets leave to others."""

COMPOSED = frozenset({"promela", "murphi", "jani"})
"""Targets that run the machines into all their states, which takes long for large models.

tests/composed and tests/agreement are about them.
"""
