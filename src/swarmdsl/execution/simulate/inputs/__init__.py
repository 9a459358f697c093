"""Files that come in: scenarios, values in them, and events from outside.

In: TOML and JSON Lines, a subject. Out: checked scenarios, events, and the space that fits. Read
`scenario_file.py` first.
"""
