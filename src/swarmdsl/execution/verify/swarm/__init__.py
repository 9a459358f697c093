"""The swarm: groups of robots that nothing tells apart, counted in each state.

In: automata, numbers of members. Out: a `Model` with its groups and doubts, a `Network` whose state
is one integer, also one in which time passes, and the atomic propositions of properties in it. Read
`model.py` first, then `network.py`.
"""
