"""Machines of a model as tables of the engine, and the robots that run them.

In: `ir.System`. Out: a `Subject` (a swarm or a machine), its robots and actors, expressions as
functions, and data of machines. Read `table.py` first, then `subject.py`.
"""
