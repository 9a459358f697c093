"""ROS 2: the package of target `ros2`, whose nodes run the state machines with SMACH."""
