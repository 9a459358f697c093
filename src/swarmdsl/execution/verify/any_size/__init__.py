"""Proofs for every number of robots of a role: coverability, by a search backwards.

In: models and safety properties. Out: verdicts. Read `prove.py` first, then `coverability.py`.
"""
