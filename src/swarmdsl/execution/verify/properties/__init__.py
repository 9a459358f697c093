"""Properties in a swarm: monitors as tables, and observers that a search takes along.

In: properties, networks. Out: observers, and what is wrong with properties that none can watch.
Read `observer.py` first.
"""
