"""SMACH on ROS 2: the package of target `ros2`, with nodes that run SMACH."""
