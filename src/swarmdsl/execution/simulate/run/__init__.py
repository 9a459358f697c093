"""One run of the command: its subject and inputs, and everything that it writes or shows.

In: the arguments of the command. Out: a prepared run, its outputs, and a live view. Read
`prepare.py` first.
"""
