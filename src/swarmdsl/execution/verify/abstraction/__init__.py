"""Abstraction of data: places that decide on behaviour, and values that stand for all others.

In: `ir.System`, state machines, conditions of properties. Out: sliced machines, representatives of
data from outside, the letters of messages, and doubts about what they leave out. Imports no other
step. Read `slice.py` first, then `representatives.py`.
"""
