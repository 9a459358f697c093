"""Nodes for ROS 2 whose machines run in a third-party library that follows the engine.

For libraries whose states end with outcomes, such as SMACH and YASMIN.
"""
