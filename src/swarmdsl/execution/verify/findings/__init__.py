"""Findings without any property: what gets stuck, never happens, fails, or has no end.

In: models and their graphs. Out: findings, each with a run or with a place in the model. Read
`findings.py` first.
"""
