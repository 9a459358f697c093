"""Makes `swarm_parser.py` from the textX grammar, and explains what does not follow it.

`grammar` reads the grammar, `analysis` finds what can begin where, `emission` writes the
parser and `program` the instructions that `machine` follows.
"""
