"""ROS 2 in the loop: a flat world in which nodes of ROS 2 are the robots' minds."""
