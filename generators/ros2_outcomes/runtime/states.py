"""Stand-in for module `states`, which each library has."""

STOPPED = ''
"""Outcome of states that end because the machine is stopped."""
