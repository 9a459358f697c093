"""ROS interface types: interface files and the standard interfaces of ROS."""
