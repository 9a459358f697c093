"""Diagrams of a model: its swarms, the insides of its members, and its state machines.

A model becomes a graph (`composition`, `internal`, `statechart`), which is written in one of
the formats. For SVG it is laid out first.
"""
