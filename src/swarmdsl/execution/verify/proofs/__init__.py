"""Proofs of properties of a swarm of a given size, and verdicts.

In: models and properties. Out: verdicts with runs as counterexamples and witnesses. Read
`prove.py` first.
"""
