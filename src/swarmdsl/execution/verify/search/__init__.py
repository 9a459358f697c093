"""Searches of the states of a swarm, within limits: breadth first, and for loops.

In: networks and observers. Out: graphs of states, lassos that are fair, and the steps of a run.
Read `explore.py` first.
"""
