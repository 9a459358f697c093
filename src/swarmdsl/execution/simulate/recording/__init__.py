"""Lines of a recording: steps with variables, places, radio links, targets and measures.

In: a running world. Out: JSON Lines for the player, the live page and `--replay`. Read
`run_lines.py` first.
"""
