"""Replay of traces of robots and simulations on the model.

In: trace lines. Out: the place at which a robot deviated from its model. Read `replay.py`
first, then `machine_replay.py`.
"""
