"""Runs of named robots for what a search has found, played on the engine, with times.

In: steps between states of groups. Out: runs as trace lines, or why a run is spurious. Read
`play.py` first, then `times.py`.
"""
