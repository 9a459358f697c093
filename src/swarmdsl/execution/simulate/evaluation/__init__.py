"""Evaluation of a run: properties, measures, fitness, coverage, and the summary.

In: lines of a trace, statistics. Out: verdicts, values, text, JSON. Read `properties.py` first,
then `measures.py`.
"""
