"""Automata of robots: all states and steps of one, found by running its machines.

In: bodies and their inputs. Out: automata with labels, also with a clock for each running activity
and delay, and their quotients by bisimulation; limits of searches. Read `automaton.py` first,
then `labels.py`.
"""
