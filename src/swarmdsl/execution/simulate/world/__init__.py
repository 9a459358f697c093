"""Simulated world: all machines in virtual time, functions, events and faults.

In: actors, a scenario, a space. Out: lines of a trace, one per macrostep. Read `world.py` first,
then `runner.py`.
"""
