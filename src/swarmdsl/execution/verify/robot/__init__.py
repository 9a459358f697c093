"""One robot: what comes from outside, and its machines on the engine, driven input by input.

In: the abstraction of data, a scenario and options. Out: a `Body` that takes an input, and the
inputs that it can get: ends of functions, events, messages, losses of others. Read `body.py` first,
then `environment.py`.
"""
