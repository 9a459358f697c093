"""Nodes of ROS 2 whose machines run in a library of others, which follows the engine.

For libraries whose states end with outcomes, as those of SMACH and YASMIN do.
"""
