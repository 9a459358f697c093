"""Scenarios as data, with time, chance and places as machines meet them.

In: nothing of a model. Out: `Scenario`, durations, the virtual clock, random numbers of a seed, and
the interface `Space` of places. Imports no other step. Read `scenario.py` first.
"""
