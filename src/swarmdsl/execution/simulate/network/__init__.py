"""Network between robots: what reaches which robot, and when.

In: sent events. Out: packets with the times of their arrival, losses, and the members that each
robot takes for present. Read `network.py` first.
"""
