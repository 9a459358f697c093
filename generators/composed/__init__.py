"""Models of a composed swarm for other model checkers: what their languages have in common.

Targets `promela` and the like print what `swarmc verify` looks at. They take the states and steps
of the robots from its automata, which the engine has run.
"""
